#include <scree/mechanics/volume_projection.h>

#include <cmath>
#include <limits>

namespace scree
{
template <int dim>
VolumeModes<dim>::VolumeModes(const dealii::Point<dim> *points, const double *weights,
                              const unsigned int n_points, const unsigned int degree)
{
  // Of the variance of a coordinate, relative to that in a whole cell.
  constexpr double   smallest_spread = 0.01 / 12.;
  const unsigned int n_functions     = degree == 0 ? 1 : n_max;
  double             volume          = 0.;
  for (unsigned int q = 0; q < n_points; ++q)
    volume += weights[q];
  for (unsigned int j = 0; j < n_functions && volume > 0.; ++j)
    {
      std::array<double, n_max> mode = {};
      mode[j]                        = 1.;
      // Twice, against round-off.
      for (unsigned int pass = 0; pass < 2; ++pass)
        for (unsigned int m = 0; m < n; ++m)
          {
            double product = 0.;
            for (unsigned int q = 0; q < n_points; ++q)
              {
                double value = mode[0];
                for (unsigned int d = 0; d < dim; ++d)
                  value += mode[d + 1] * (points[q][d] - 0.5);
                product += weights[q] * value * (*this)(points[q])[m];
              }
            for (unsigned int i = 0; i < n_max; ++i)
              mode[i] -= product * coefficients[m][i];
          }
      double norm = 0.;
      for (unsigned int q = 0; q < n_points; ++q)
        {
          double value = mode[0];
          for (unsigned int d = 0; d < dim; ++d)
            value += mode[d + 1] * (points[q][d] - 0.5);
          norm += weights[q] * value * value;
        }
      if (norm < smallest_spread * volume)
        continue;
      for (unsigned int i = 0; i < n_max; ++i)
        coefficients[n][i] = mode[i] / std::sqrt(norm);
      ++n;
    }
}

template <int dim>
std::array<double, VolumeModes<dim>::n_max>
VolumeModes<dim>::operator()(const dealii::Point<dim> &unit_point) const
{
  std::array<double, n_max> values = {};
  for (unsigned int m = 0; m < n; ++m)
    {
      values[m] = coefficients[m][0];
      for (unsigned int d = 0; d < dim; ++d)
        values[m] += coefficients[m][d + 1] * (unit_point[d] - 0.5);
    }
  return values;
}

template <int dim>
VolumeChange<dim>::VolumeChange(const WorkOf work, const dealii::Tensor<2, dim> &F_D,
                                const IncrementStart &start)
    : geometric(work == WorkOf::current)
    , increment(F_D)
{
  const dealii::Tensor<2, dim> identity(dealii::unit_symmetric_tensor<dim>());
  if (geometric)
    {
      const double J_D = determinant(F_D);
      value = scale = J_D * start.volume_ratio;
      if (J_D > 0.)
        H = transpose(invert(F_D));
      B = F_D;
      return;
    }
  H = B = identity;
  if (work == WorkOf::reference)
    {
      dealii::Tensor<2, dim> F_n;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          F_n[i][j] = start.deformation_gradient[i][j];
      H = transpose(F_n);
      B = invert(F_n);
    }
  value = scalar_product(H, F_D) - dim;
}

template <int dim>
dealii::Tensor<2, dim>
VolumeChange<dim>::project(const double projected_value, const double exponent)
{
  r = exponent;
  if (!geometric)
    return increment + r * (projected_value - value) * B;
  if (!(projected_value > 0. && value > 0.))
    {
      m = slope = std::numeric_limits<double>::quiet_NaN();
      return m * increment;
    }
  slope = 1. / projected_value;
  m     = std::pow(projected_value / value, r);
  return m * increment;
}

template <int dim>
typename VolumeChange<dim>::Stress
VolumeChange<dim>::stress(const dealii::Tensor<2, dim> &law_piola) const
{
  Stress result;
  result.scaled = m * law_piola;
  result.trace  = scalar_product(result.scaled, B);
  result.piola  = result.scaled - r * result.trace * H;
  return result;
}

template <int dim>
typename VolumeChange<dim>::Tangent
VolumeChange<dim>::tangent(const Stress &stress, const dealii::Tensor<4, dim> &law_tangent) const
{
  Tangent                result;
  dealii::Tensor<2, dim> along; // r m^2 A : B
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = 0; j < dim; ++j)
      along[i][j] = r * m * m * scalar_product(law_tangent[i][j], B);
  if (geometric)
    along += r * stress.scaled;
  result.scaled_by_volume = along;
  result.trace_by_volume  = scalar_product(along, B);
  result.piola_by_volume  = along - r * result.trace_by_volume * H;
  for (unsigned int k = 0; k < dim; ++k)
    for (unsigned int l = 0; l < dim; ++l)
      {
        // for dF_D,kl = 1
        dealii::Tensor<2, dim> change;
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            change[i][j] = m * m * law_tangent[i][j][k][l] - H[k][l] * along[i][j];
        const double trace = scalar_product(change, B) + (geometric ? stress.scaled[k][l] : 0.);
        result.trace[k][l] = trace;
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            {
              result.scaled[i][j][k][l] = change[i][j];
              result.piola[i][j][k][l]  = change[i][j] - r * trace * H[i][j]
                                         + (geometric ? r * stress.trace * H[i][l] * H[k][j] : 0.);
            }
      }
  return result;
}

template struct VolumeModes<2>;
template struct VolumeModes<3>;
template class VolumeChange<2>;
template class VolumeChange<3>;
} // namespace scree
