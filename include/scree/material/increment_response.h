#pragma once

#include <scree/material/increment_law.h>

#include <limits>

namespace scree
{
/** What a law computes at one point before it is pulled back to `Omega_n`. */
struct KirchhoffStress
{
  dealii::Tensor<2, 3> kirchhoff; // tau; J_D sigma of rotated laws, sigma of the linear theory
  dealii::Tensor<2, 3> internal;  // that of IncrementResponse
  double               alpha       = 0;
  double               energy      = 0;
  double               dissipation = 0;
};

/** A deformation gradient with three rows: in plane strain the out-of-plane stretch is 1. */
template <int dim>
dealii::Tensor<2, 3>
embed(const dealii::Tensor<2, dim> &gradient)
{
  dealii::Tensor<2, 3> F;
  F[2][2] = 1;
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = 0; j < dim; ++j)
      F[i][j] = gradient[i][j];
  return F;
}

/** The answer to `det F_D <= 0`. */
template <int dim>
void
set_not_a_number(IncrementResponse<dim> &response, dealii::Tensor<4, dim> *tangent)
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  response             = IncrementResponse<dim>();
  response.energy      = nan;
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = 0; j < dim; ++j)
      {
        response.piola[i][j]  = nan;
        response.cauchy[i][j] = nan;
        if (tangent)
          for (unsigned int k = 0; k < dim; ++k)
            for (unsigned int l = 0; l < dim; ++l)
              (*tangent)[i][j][k][l] = nan;
      }
}

/**
 * One point of IncrementLaw::respond(). A type `Point` is a KirchhoffStress, constructed by
 * `law.at(F_D, J_D, start)` (`J_D = 1` without geometric terms), with
 *
 *     Point::work              the configuration on which its stress works
 *     derivative(k, f)         d tau for a velocity gradient e_k (x) f
 *
 * The gradient of a test function there is `grad v pull`, and that of a change of the increment
 * `dF_D,kL = 1` is `e_k (x) f` with the row `f` of `pull` that belongs to L:
 *
 *     WorkOf::current      pull = F_D^{-1}
 *     WorkOf::start        pull = I
 *     WorkOf::reference    pull = F_n
 *
 * so that `P = tau pull^T/J_n` and `dP/dF_D,kL = (d tau - (tau f) (x) e_k) pull^T/J_n`, where the
 * second term comes from the derivative of `F_D^{-T}` and exists for WorkOf::current only.
 */
template <int dim, class Law>
void
respond_at_point(const Law &law, const dealii::Tensor<2, dim> &increment,
                 const IncrementStart &start, IncrementResponse<dim> &response,
                 dealii::Tensor<4, dim> *tangent)
{
  using namespace dealii;
  using Point                     = typename Law::Point;
  constexpr bool     is_geometric = Point::work == WorkOf::current;
  const Tensor<2, 3> F            = embed<dim>(increment);
  const double       volume_step  = is_geometric ? determinant(F) : 1;
  if (!(volume_step > 0))
    return set_not_a_number(response, tangent);
  Tensor<2, 3> pull;
  if constexpr (is_geometric)
    pull = invert(F);
  else if constexpr (Point::work == WorkOf::reference)
    pull = start.deformation_gradient;
  else
    pull = embed<dim>(Tensor<2, dim>(unit_symmetric_tensor<dim>()));
  const Point  point = law.at(F, volume_step, start);
  const double scale = 1 / start.volume_ratio;

  const Tensor<2, 3> piola = scale * point.kirchhoff * transpose(pull);
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = 0; j < dim; ++j)
      response.piola[i][j] = piola[i][j];
  response.cauchy
    = symmetrize(is_geometric ? point.kirchhoff * (scale / volume_step) : point.kirchhoff);
  response.internal    = symmetrize(point.internal);
  response.alpha       = point.alpha;
  response.energy      = point.energy;
  response.dissipation = point.dissipation;
  if (!tangent)
    return;

  for (unsigned int l = 0; l < dim; ++l)
    {
      const Tensor<1, 3> f        = pull[l];
      const Tensor<1, 3> traction = point.kirchhoff * f;
      for (unsigned int k = 0; k < dim; ++k)
        {
          Tensor<2, 3> change = point.derivative(k, f);
          if (is_geometric)
            for (unsigned int i = 0; i < dim; ++i)
              change[i][k] -= traction[i];
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              {
                double sum = 0;
                for (unsigned int m = 0; m < dim; ++m)
                  sum += change[i][m] * pull[j][m];
                (*tangent)[i][j][k][l] = scale * sum;
              }
        }
    }
}

/** IncrementLaw::respond() of the law `law`, inlined at every point. */
template <int dim, class Law>
void
respond_at_points(const Law &law, const dealii::ArrayView<const dealii::Tensor<2, dim>> &increments,
                  const dealii::ArrayView<const IncrementStart>   &starts,
                  const dealii::ArrayView<IncrementResponse<dim>> &responses,
                  const dealii::ArrayView<dealii::Tensor<4, dim>> &tangents)
{
  AssertDimension(increments.size(), starts.size());
  AssertDimension(increments.size(), responses.size());
  Assert(tangents.size() == 0 || tangents.size() == increments.size(),
         dealii::ExcDimensionMismatch(tangents.size(), increments.size()));
  for (std::size_t q = 0; q < increments.size(); ++q)
    respond_at_point<dim>(law, increments[q], starts[q], responses[q],
                          tangents.size() == 0 ? nullptr : &tangents[q]);
}

/** An IncrementLaw made of a law as respond_at_point() describes it. */
template <int dim, class Law>
class IncrementLawOf : public IncrementLaw<dim>
{
public:
  IncrementLawOf(const Law &law, const IsotropicModuli &moduli, const Hardening &hardening)
      : IncrementLaw<dim>(moduli, hardening)
      , law(law)
  {
  }

  InternalTensor internal() const override
  {
    return Law::internal;
  }

  WorkOf work() const override
  {
    return Law::Point::work;
  }

  void respond(const dealii::ArrayView<const dealii::Tensor<2, dim>> &increments,
               const dealii::ArrayView<const IncrementStart>         &starts,
               const dealii::ArrayView<IncrementResponse<dim>>       &responses,
               const dealii::ArrayView<dealii::Tensor<4, dim>>       &tangents) const override
  {
    respond_at_points<dim>(law, increments, starts, responses, tangents);
  }

private:
  Law law;
};
} // namespace scree
