#include <scree/points/splitting.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace scree
{
using namespace dealii;

namespace
{
void
add_counts(MovingLeastSquaresReport &sum, const MovingLeastSquaresReport &report)
{
  sum.n_targets += report.n_targets;
  sum.widened += report.widened;
  sum.lowered += report.lowered;
  sum.constant += report.constant;
  sum.without_points += report.without_points;
  sum.largest_amplification = std::max(sum.largest_amplification, report.largest_amplification);
}

/** Appends the 2^dim children of a point, with its state. */
template <int dim>
void
append_children(MaterialPoints<dim> &points, const std::size_t parent)
{
  constexpr unsigned int n_children = 1 << dim;
  const Tensor<2, dim>   F          = points.deformation_gradient[parent];
  const double           edge
    = std::min(points.initial_spacing[parent], std::pow(points.initial_volume[parent], 1. / dim));
  MaterialPoints<dim> child(points.n_internal());
  child.add_copy(points, parent);
  child.mass[0] /= n_children;
  child.initial_volume[0] /= n_children;
  child.initial_spacing[0] /= 2.;
  for (unsigned int c = 0; c < n_children; ++c)
    {
      Tensor<1, dim> offset;
      for (unsigned int d = 0; d < dim; ++d)
        offset[d] = (c >> d & 1 ? 0.25 : -0.25) * edge;
      child.position[0]           = points.position[parent] + F * offset;
      child.reference_position[0] = points.reference_position[parent] + offset;
      points.add_copy(child, 0);
    }
}

/** Gives the children from `first` on the state of the old cloud at their positions. */
template <int dim>
void
transfer_state(MaterialPoints<dim> &points, const MaterialPoints<dim> &old, const std::size_t first,
               const PointWeights &weights)
{
  constexpr unsigned int n_children = 1 << dim;
  const unsigned int     n          = points.n_internal();
  const auto             internal   = weights.values(old.internal, n);
  std::copy(internal.begin(), internal.end(), points.internal.begin() + first * n);
  const auto gradients = interpolated_gradients(weights, old.deformation_gradient);
  std::copy(gradients.begin(), gradients.end(), points.deformation_gradient.begin() + first);
  for (std::size_t c = 0; c < weights.n_targets(); ++c)
    {
      points.stress[first + c]              = weights.value(old.stress, c);
      points.out_of_plane_stress[first + c] = weights.value(old.out_of_plane_stress, c);
    }
  for (std::size_t c = 0; c < weights.n_targets(); c += n_children)
    {
      Tensor<1, dim> mean;
      for (unsigned int i = c; i < c + n_children; ++i)
        mean += weights.value(old.velocity, i) / n_children;
      for (std::size_t i = c; i < c + n_children; ++i)
        points.velocity[first + i] += weights.value(old.velocity, i) - mean;
    }
}
} // namespace

template <int dim>
MovingLeastSquares<dim>
moving_least_squares(const MaterialPoints<dim> &points, const MovingLeastSquaresOptions &options)
{
  std::vector<double> spacing(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    spacing[i] = points.spacing(i);
  return MovingLeastSquares<dim>(points.position, points.body, spacing, options);
}

template <int dim>
SplittingReport
split_points(MaterialPoints<dim> &points, const std::vector<double> &cell_size,
             const unsigned int n_per_direction, const MovingLeastSquaresOptions &options,
             const std::function<MaterialPoints<dim>(const MaterialPoints<dim> &)> &with_neighbours,
             const MPI_Comm                                                         comm)
{
  AssertDimension(cell_size.size(), points.size());
  constexpr unsigned int n_children = 1 << dim;
  SplittingReport        report;
  std::vector<double>    size = cell_size;
  while (true)
    {
      const std::size_t n_old = points.size();
      std::vector<bool> kept(n_old);
      for (std::size_t i = 0; i < n_old; ++i)
        kept[i] = points.spacing(i) * n_per_direction <= size[i] * (1. + 1e-10);
      const bool is_left = std::find(kept.begin(), kept.end(), false) != kept.end();
      if (dealii::Utilities::MPI::max(static_cast<unsigned int>(is_left), comm) == 0)
        return report;

      const MaterialPoints<dim> old = with_neighbours(points);
      std::vector<double>       kept_size;
      Targets<dim>              targets;
      for (std::size_t i = 0; i < n_old; ++i)
        if (kept[i])
          kept_size.push_back(size[i]);
        else
          {
            append_children(points, i);
            targets.cell_size.insert(targets.cell_size.end(), n_children, size[i]);
            ++report.n_split;
          }
      targets.position.assign(points.position.begin() + n_old, points.position.end());
      targets.body.assign(points.body.begin() + n_old, points.body.end());
      const PointWeights weights = moving_least_squares(old, options).weights(targets);
      add_counts(report.transfer, weights.report);
      transfer_state(points, old, n_old, weights);

      kept.resize(points.size(), true);
      points.keep(kept);
      size = std::move(kept_size);
      size.insert(size.end(), targets.cell_size.begin(), targets.cell_size.end());
    }
}

template MovingLeastSquares<2> moving_least_squares(const MaterialPoints<2> &,
                                                    const MovingLeastSquaresOptions &);
template MovingLeastSquares<3> moving_least_squares(const MaterialPoints<3> &,
                                                    const MovingLeastSquaresOptions &);
template SplittingReport
split_points(MaterialPoints<2> &, const std::vector<double> &, const unsigned int,
             const MovingLeastSquaresOptions &,
             const std::function<MaterialPoints<2>(const MaterialPoints<2> &)> &, const MPI_Comm);
template SplittingReport
split_points(MaterialPoints<3> &, const std::vector<double> &, const unsigned int,
             const MovingLeastSquaresOptions &,
             const std::function<MaterialPoints<3>(const MaterialPoints<3> &)> &, const MPI_Comm);
} // namespace scree
