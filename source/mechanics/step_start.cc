#include <scree/base/exceptions.h>
#include <scree/base/log.h>
#include <scree/material/increment_response.h>
#include <scree/material/logarithmic_strain.h>
#include <scree/mechanics/step_start.h>
#include <scree/points/migration.h>
#include <scree/points/splitting.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace scree
{
namespace
{
template <int dim>
bool
has_plastic_strain(const Body<dim> &body)
{
  return !body.is_rigid()
         && (body.law->internal() == InternalTensor::plastic_metric
             || body.law->internal() == InternalTensor::plastic_strain);
}

/** dev sym(F - I). */
template <int dim>
dealii::SymmetricTensor<2, 3>
deviatoric_strain(const dealii::Tensor<2, dim> &F)
{
  return deviator(symmetrize(embed<dim>(F)));
}

/** dev ln m. */
dealii::SymmetricTensor<2, 3>
deviatoric_logarithm(const dealii::Tensor<2, 3> &m)
{
  return deviator(
    dealii::SymmetricTensor<2, 3>(symmetrize(2. * LogarithmicStrain(eigensystem(m)).value())));
}

/** Deviator of the elastic strain: of ln b_e, b_e = F C_p^{-1} F^T, or of eps - eps_p. */
template <int dim>
dealii::SymmetricTensor<2, 3>
elastic_strain(const IncrementLaw<dim> &law, const PointHistory<dim> &history)
{
  if (law.internal() == InternalTensor::plastic_strain)
    return deviatoric_strain<dim>(history.deformation_gradient) - history.internal;
  return deviatoric_logarithm(law.start(history).tensor);
}

/** The internal tensor that leads to that elastic strain. */
template <int dim>
dealii::SymmetricTensor<2, 3>
internal_of(const IncrementLaw<dim> &law, const dealii::SymmetricTensor<2, 3> &elastic,
            const dealii::Tensor<2, dim> &F)
{
  if (law.internal() == InternalTensor::plastic_strain)
    return deviatoric_strain<dim>(F) - elastic;
  const dealii::Tensor<2, 3> inverse = invert(embed<dim>(F));
  return deviatoric_logarithm(inverse * exponential(dealii::Tensor<2, 3>(elastic))
                              * transpose(inverse));
}

/** A deviator as the points carry it: in two dimensions without the third row, and back. */
template <int dim>
dealii::SymmetricTensor<2, dim>
reduced(const dealii::SymmetricTensor<2, 3> &deviatoric)
{
  dealii::SymmetricTensor<2, dim> result;
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = i; j < dim; ++j)
      result[i][j] = deviatoric[i][j];
  return result;
}

template <int dim>
dealii::SymmetricTensor<2, 3>
completed(const dealii::SymmetricTensor<2, dim> &tensor)
{
  dealii::SymmetricTensor<2, 3> result;
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = i; j < dim; ++j)
      result[i][j] = tensor[i][j];
  if (dim == 2)
    result[2][2] = -trace(tensor);
  return result;
}

/**
 * Where the material flowed, plastic strains follow the deformation gradient at the point: what
 * moving least squares carry is the elastic strain, with a share of one less the secant ratio.
 * Plastic strains smoothed without F, which jumps from cell to cell, would make the material flow
 * once more.
 */
template <int dim>
void
set_plastic_strains(const Body<dim> &body, const dealii::SymmetricTensor<2, dim> &elastic,
                    PointHistory<dim> &history)
{
  if (!has_plastic_strain(body) || history.alpha <= 0.)
    return;
  const double share = body.law->secant_ratio(history.alpha);
  history.internal
    = share * history.internal
      + (1. - share)
          * internal_of<dim>(*body.law, completed<dim>(elastic), history.deformation_gradient);
}
} // namespace

template <int dim>
void
store_internal(const PointHistory<dim> &history, double *internal)
{
  for (unsigned int i = 0; i < 6; ++i)
    internal[i] = history.internal.access_raw_entry(i);
  internal[6] = history.alpha;
}

template <int dim>
void
load_internal(const double *internal, PointHistory<dim> &history)
{
  for (unsigned int i = 0; i < 6; ++i)
    history.internal.access_raw_entry(i) = internal[i];
  history.alpha = internal[6];
}

template <int dim>
bool
StepStart<dim>::needs_internal(const std::vector<Body<dim>> &bodies)
{
  return std::any_of(bodies.begin(), bodies.end(), [](const Body<dim> &body) {
    return !body.is_rigid() && body.law->internal() != InternalTensor::none;
  });
}

template <int dim>
StepStart<dim>::StepStart(const Fields<dim> &fields, const std::vector<Body<dim>> &bodies,
                          const MaterialPoints<dim>      &points,
                          const MovingGeometryParameters &parameters)
    : fields(fields)
    , bodies(bodies)
    , own_points(points)
    , parameters(parameters)
    , locations(locate_points(fields, points))
    , cloud(points.n_internal())
{
  fitted             = fit_displacement(fields, points, locations);
  Vector distributed = fitted;
  fields.hanging_constraints().distribute(distributed);
  Vector ghosted(fields.owned(), fields.relevant(), fields.grid.communicator());
  ghosted       = distributed;
  displacements = values_by_cell(fields, ghosted);
  if (points.n_internal() > 0
      || parameters.deformation == DeformationTransfer::moving_least_squares)
    {
      collect_neighbours();
      moving_least_squares.emplace(
        scree::moving_least_squares(cloud, {fields.basis.degree, parameters.support}));
    }
}

template <int dim>
void
StepStart<dim>::collect_neighbours()
{
  // The stresses of points are not needed here: the cloud has elastic strains in their place.
  cloud = own_points;
  for (std::size_t p = 0; p < own_points.size(); ++p)
    if (has_plastic_strain(bodies[own_points.body[p]]))
      cloud.stress[p] = reduced<dim>(
        elastic_strain<dim>(*bodies[own_points.body[p]].law, history_of_material_point(p)));
  const MaterialPoints<dim> sent = cloud;
  const MPI_Comm            comm = fields.grid.communicator();
  if (dealii::Utilities::MPI::n_mpi_processes(comm) == 1)
    return;
  // A radius that has grown six times by 1.25 is 3.8 times the first one.
  double largest_size = 0.;
  for (const ActiveCell &cell : fields.cells())
    largest_size = std::max(largest_size, fields.grid.cells()[cell.grid_cell].size);
  for (std::size_t p = 0; p < own_points.size(); ++p)
    largest_size = std::max(largest_size, own_points.spacing(p));
  const double reach  = 4. * parameters.support * dealii::Utilities::MPI::max(largest_size, comm);
  const auto   others = neighbours_from_others<dim>(
    sent,
    [&](const dealii::Point<dim> &x) {
      // The processes of a lattice of probes as fine as the cells are.
      const int              n = static_cast<int>(std::ceil(reach / fields.grid.finest_size()));
      std::set<unsigned int> ranks;
      const int              stride = std::max(1, n / 4);
      for (int i = -n; i <= n; i += stride)
        for (int j = -n; j <= n; j += stride)
          for (int k = dim == 3 ? -n : 0; k <= (dim == 3 ? n : 0); k += stride)
            {
              dealii::Point<dim> probe = x;
              probe[0] += i * fields.grid.finest_size();
              probe[1] += j * fields.grid.finest_size();
              probe[dim - 1] += dim == 3 ? k * fields.grid.finest_size() : 0.;
              ranks.insert(fields.grid.locate(probe).rank);
            }
      return std::vector<unsigned int>(ranks.begin(), ranks.end());
    },
    comm);
  for (std::size_t i = 0; i < others.size(); ++i)
    cloud.add_copy(others, i);
}

template <int dim>
PointWeights
StepStart<dim>::weights(const std::vector<PointInCell<dim>> &targets) const
{
  Targets<dim> places;
  for (const auto &target : targets)
    {
      const ActiveCell    &cell     = fields.cells()[target.active_cell];
      const GridCell<dim> &geometry = fields.grid.cells()[cell.grid_cell];
      places.position.push_back(geometry.lower
                                + geometry.size * dealii::Tensor<1, dim>(target.unit_point));
      places.body.push_back(cell.body);
      places.cell_size.push_back(geometry.size);
    }
  PointWeights result = moving_least_squares->weights(places);
  report.n_targets += result.report.n_targets;
  report.widened += result.report.widened;
  report.lowered += result.report.lowered;
  report.constant += result.report.constant;
  report.without_points += result.report.without_points;
  report.largest_amplification
    = std::max(report.largest_amplification, result.report.largest_amplification);
  return result;
}

template <int dim>
typename StepStart<dim>::Deformation
StepStart<dim>::deformation(const PointInCell<dim> &point) const
{
  const ActiveCell &cell  = fields.cells()[point.active_cell];
  const double      scale = 1. / fields.grid.cells()[cell.grid_cell].size;
  ShapeValues<dim>  shape;
  fields.basis.evaluate(point.unit_point, shape);
  Deformation            result;
  dealii::Tensor<2, dim> inverse(dealii::unit_symmetric_tensor<dim>());
  const double *nodal = &displacements[std::size_t(point.active_cell) * fields.basis.n_nodes * dim];
  for (unsigned int a = 0; a < fields.basis.n_nodes; ++a)
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double value = nodal[a * dim + d];
        result.displacement[d] += value * shape.value[a];
        inverse[d] -= value * scale * shape.gradient[a];
      }
  result.gradient = dealii::invert(inverse);
  return result;
}

template <int dim>
dealii::Point<dim>
StepStart<dim>::reference_position(const PointInCell<dim> &point) const
{
  const auto &geometry = fields.grid.cells()[fields.cells()[point.active_cell].grid_cell];
  return dealii::Point<dim>(geometry.lower
                            + geometry.size * dealii::Tensor<1, dim>(point.unit_point)
                            - deformation(point).displacement);
}

template <int dim>
void
StepStart<dim>::require_admissible(const PointInCell<dim>       &point,
                                   const dealii::Tensor<2, dim> &F) const
{
  if (determinant(F) > 0.)
    return;
  const ActiveCell        &cell     = fields.cells()[point.active_cell];
  const auto              &geometry = fields.grid.cells()[cell.grid_cell];
  const dealii::Point<dim> x
    = geometry.lower + geometry.size * dealii::Tensor<1, dim>(point.unit_point);
  throw UserError("Bodies/" + bodies[cell.body].name,
                  "its displacement at the start of the step turns the material at "
                    + short_place(x) + " inside out: det F = " + short_number(determinant(F)),
                  "use more steps or finer cells; where a prescribed displacement ends at a sharp "
                  "edge, let it end smoothly or load the body by tractions");
}

template <int dim>
std::vector<PointHistory<dim>>
StepStart<dim>::histories(const std::vector<PointInCell<dim>> &points) const
{
  std::vector<PointHistory<dim>> result(points.size());
  const bool of_points = parameters.deformation == DeformationTransfer::moving_least_squares;
  if (!of_points)
    for (std::size_t i = 0; i < points.size(); ++i)
      result[i].deformation_gradient = deformation(points[i]).gradient;
  if (cloud.n_internal() > 0 || of_points)
    {
      const PointWeights transfer = weights(points);
      if (of_points)
        {
          const auto gradients = transfer.values(cloud.deformation_gradient);
          for (std::size_t i = 0; i < points.size(); ++i)
            result[i].deformation_gradient = gradients[i];
        }
      if (cloud.n_internal() > 0)
        {
          const auto internal = transfer.values(cloud.internal, n_internal);
          for (std::size_t i = 0; i < points.size(); ++i)
            {
              load_internal(&internal[i * n_internal], result[i]);
              set_plastic_strains(bodies[fields.cells()[points[i].active_cell].body],
                                  transfer.value(cloud.stress, i), result[i]);
            }
        }
    }
  for (std::size_t i = 0; i < points.size(); ++i)
    require_admissible(points[i], result[i].deformation_gradient);
  return result;
}

template <int dim>
PointHistory<dim>
StepStart<dim>::history_of_material_point(const std::size_t point) const
{
  PointHistory<dim> result;
  result.deformation_gradient = parameters.deformation == DeformationTransfer::moving_least_squares
                                  ? own_points.deformation_gradient[point]
                                  : deformation(locations[point]).gradient;
  if (own_points.n_internal() > 0)
    load_internal(&own_points.internal[point * n_internal], result);
  return result;
}

#define SCREE_INSTANTIATE(dim)                                       \
  template class StepStart<dim>;                                     \
  template void store_internal(const PointHistory<dim> &, double *); \
  template void load_internal(const double *, PointHistory<dim> &);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
