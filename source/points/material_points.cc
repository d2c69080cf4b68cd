#include <scree/points/material_points.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace scree
{
using namespace dealii;

namespace
{
/** Adds to a sum and to what its rounding lost: the error does not grow with the number of terms
 * (Neumaier, Z. Angew. Math. Mech. 54, 1974). */
void
add_compensated(const double value, double &sum, double &lost)
{
  const double next = sum + value;
  lost += std::abs(sum) >= std::abs(value) ? (sum - next) + value : (value - next) + sum;
  sum = next;
}

// Every quantity of a point is a row of numbers in a message.
double *
numbers(double &value)
{
  return &value;
}
double *
numbers(Tensor<1, 2> &value)
{
  return value.begin_raw();
}
double *
numbers(Tensor<1, 3> &value)
{
  return value.begin_raw();
}
template <int dim>
double *
numbers(Tensor<2, dim> &value)
{
  return value[0].begin_raw();
}
template <int dim>
double *
numbers(SymmetricTensor<2, dim> &value)
{
  return value.begin_raw();
}

template <typename T>
constexpr unsigned int n_numbers = sizeof(T) / sizeof(double);
} // namespace

template <int dim>
MaterialPoints<dim>::MaterialPoints(const unsigned int n_internal)
    : n_internal_variables(n_internal)
{
}

template <int dim>
std::size_t
MaterialPoints<dim>::size() const
{
  return position.size();
}

template <int dim>
unsigned int
MaterialPoints<dim>::n_internal() const
{
  return n_internal_variables;
}

template <int dim>
double
MaterialPoints<dim>::volume(const std::size_t point) const
{
  return determinant(deformation_gradient[point]) * initial_volume[point];
}

template <int dim>
double
MaterialPoints<dim>::spacing(const std::size_t point) const
{
  const Tensor<2, dim> &F = deformation_gradient[point];
  if constexpr (dim == 2)
    // Singular values without the cancellation that eigenvalues of F F^T suffer at small shears.
    return 0.5 * initial_spacing[point]
           * (std::hypot(F[0][0] + F[1][1], F[1][0] - F[0][1])
              + std::hypot(F[0][0] - F[1][1], F[1][0] + F[0][1]));
  else
    return initial_spacing[point]
           * std::sqrt(eigenvalues(SymmetricTensor<2, dim>(F * transpose(F)))[0]);
}

template <int dim>
void
MaterialPoints<dim>::add(const Point<dim> &x, const unsigned int body_number, const double volume,
                         const double spacing, const double point_mass)
{
  position.push_back(x);
  reference_position.push_back(x);
  initial_volume.push_back(volume);
  initial_spacing.push_back(spacing);
  mass.push_back(point_mass);
  deformation_gradient.push_back(unit_symmetric_tensor<dim>());
  stress.emplace_back();
  out_of_plane_stress.emplace_back();
  velocity.emplace_back();
  acceleration.emplace_back();
  forcing.emplace_back();
  internal.resize(internal.size() + n_internal_variables, 0.);
  body.push_back(body_number);
}

template <int dim>
void
MaterialPoints<dim>::add_copy(const MaterialPoints &other, const std::size_t i)
{
  Assert(other.n_internal_variables == n_internal_variables,
         ExcMessage("The points carry different internal variables."));
  std::vector<double> message;
  other.pack(i, message);
  unpack(message.data());
}

template <int dim>
void
MaterialPoints<dim>::keep(const std::vector<bool> &kept)
{
  AssertDimension(kept.size(), size());
  for_each_array(*this, [&](auto &array, const unsigned int n) {
    std::size_t end = 0;
    for (std::size_t i = 0; i < kept.size(); ++i)
      if (kept[i])
        {
          std::copy_n(array.begin() + i * n, n, array.begin() + end * n);
          ++end;
        }
    array.resize(end * n);
  });
}

template <int dim>
std::size_t
MaterialPoints<dim>::move(const std::vector<Tensor<1, dim>> &increment,
                          const std::vector<Tensor<2, dim>> &gradient)
{
  AssertDimension(increment.size(), size());
  AssertDimension(gradient.size(), size());
  std::size_t n_inverted = 0;
  for (std::size_t i = 0; i < size(); ++i)
    {
      deformation_gradient[i] += gradient[i] * deformation_gradient[i];
      position[i] += increment[i];
      n_inverted += !(determinant(deformation_gradient[i]) > 0.);
    }
  return n_inverted;
}

template <int dim>
std::vector<PointTotals<dim>>
MaterialPoints<dim>::totals(const unsigned int n_bodies) const
{
  std::vector<PointTotals<dim>> result(n_bodies), lost(n_bodies);
  for (std::size_t i = 0; i < size(); ++i)
    {
      AssertIndexRange(body[i], n_bodies);
      PointTotals<dim> &sum = result[body[i]];
      ++sum.count;
      add_compensated(mass[i], sum.mass, lost[body[i]].mass);
      add_compensated(initial_volume[i], sum.initial_volume, lost[body[i]].initial_volume);
      sum.volume += volume(i);
      sum.momentum += mass[i] * velocity[i];
    }
  for (unsigned int b = 0; b < n_bodies; ++b)
    {
      result[b].mass += lost[b].mass;
      result[b].initial_volume += lost[b].initial_volume;
    }
  return result;
}

template <int dim>
std::vector<PointTotals<dim>>
MaterialPoints<dim>::totals(const unsigned int n_bodies, const MPI_Comm comm) const
{
  auto result = totals(n_bodies);

  constexpr unsigned int     n = 3 + dim;
  std::vector<std::uint64_t> counts(n_bodies);
  std::vector<double>        sums(n * n_bodies);
  for (unsigned int b = 0; b < n_bodies; ++b)
    {
      const PointTotals<dim> &t = result[b];
      counts[b]                 = t.count;
      sums[n * b]               = t.mass;
      sums[n * b + 1]           = t.initial_volume;
      sums[n * b + 2]           = t.volume;
      for (unsigned int d = 0; d < dim; ++d)
        sums[n * b + 3 + d] = t.momentum[d];
    }
  Utilities::MPI::sum(counts, comm, counts);
  Utilities::MPI::sum(sums, comm, sums);
  for (unsigned int b = 0; b < n_bodies; ++b)
    {
      PointTotals<dim> &t = result[b];
      t.count             = counts[b];
      t.mass              = sums[n * b];
      t.initial_volume    = sums[n * b + 1];
      t.volume            = sums[n * b + 2];
      for (unsigned int d = 0; d < dim; ++d)
        t.momentum[d] = sums[n * b + 3 + d];
    }
  return result;
}

template <int dim>
unsigned int
MaterialPoints<dim>::n_values() const
{
  unsigned int result = 0;
  for_each_array(*this, [&](const auto &array, const unsigned int n) {
    using Value = typename std::decay_t<decltype(array)>::value_type;
    if constexpr (std::is_same_v<Value, unsigned int>)
      result += n;
    else
      result += n * n_numbers<Value>;
  });
  return result;
}

template <int dim>
void
MaterialPoints<dim>::pack(const std::size_t point, std::vector<double> &message) const
{
  for_each_array(*this, [&](const auto &array, const unsigned int n) {
    for (std::size_t i = point * n; i < (point + 1) * n; ++i)
      if constexpr (std::is_same_v<std::decay_t<decltype(array[i])>, unsigned int>)
        message.push_back(array[i]);
      else
        {
          auto          value = array[i];
          const double *first = numbers(value);
          message.insert(message.end(), first, first + n_numbers<decltype(value)>);
        }
  });
}

template <int dim>
void
MaterialPoints<dim>::unpack(const double *values)
{
  for_each_array(*this, [&](auto &array, const unsigned int n) {
    for (unsigned int i = 0; i < n; ++i)
      {
        typename std::decay_t<decltype(array)>::value_type value{};
        if constexpr (std::is_same_v<decltype(value), unsigned int>)
          value = static_cast<unsigned int>(*values++);
        else
          {
            std::copy_n(values, n_numbers<decltype(value)>, numbers(value));
            values += n_numbers<decltype(value)>;
          }
        array.push_back(value);
      }
  });
}

template class MaterialPoints<2>;
template class MaterialPoints<3>;
} // namespace scree
