#include <scree/base/exceptions.h>
#include <scree/base/log.h>
#include <scree/material/increment_response.h>
#include <scree/material/logarithmic_strain.h>
#include <scree/mechanics/point_neighbours.h>
#include <scree/mechanics/step_start.h>
#include <scree/points/splitting.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace scree
{
namespace
{
template <int dim>
bool
has_plastic_strain(const IncrementLaw<dim> &law)
{
  return law.internal() == InternalTensor::plastic_metric
         || law.internal() == InternalTensor::plastic_strain;
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

/**
 * Deviator of the elastic strain: of ln b_e, b_e = F C_p^{-1} F^T, or of eps - eps_p; zero of other
 * laws.
 */
template <int dim>
dealii::SymmetricTensor<2, 3>
elastic_strain(const IncrementLaw<dim> &law, const PointHistory<dim> &history)
{
  if (!has_plastic_strain(law))
    return {};
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

/**
 * Where the material flowed, its elastic strain is kept and plastic strains follow the deformation
 * gradient F that the law sees, with a share of one less the secant ratio: F has errors, and jumps
 * from cell to cell, that are small beside the plastic strain but not beside the elastic one. With
 * plastic strains kept the material would flow once more in every step.
 */
template <int dim>
void
set_plastic_strains(const IncrementLaw<dim> &law, const dealii::SymmetricTensor<2, 3> &elastic,
                    const dealii::Tensor<2, dim> &F, PointHistory<dim> &history)
{
  const double share = law.secant_ratio(history.alpha);
  history.internal   = share * history.internal + (1. - share) * internal_of<dim>(law, elastic, F);
}

dealii::SymmetricTensor<2, 3>
load_tensor(const double *numbers)
{
  dealii::SymmetricTensor<2, 3> result;
  for (unsigned int i = 0; i < 6; ++i)
    result.access_raw_entry(i) = numbers[i];
  return result;
}

template <int dim>
void
load_internal(const double *internal, PointHistory<dim> &history)
{
  history.internal = load_tensor(internal);
  history.alpha    = internal[6];
}
} // namespace

template <int dim>
void
store_internal(const IncrementLaw<dim> &law, const PointHistory<dim> &history, double *internal)
{
  const dealii::SymmetricTensor<2, 3> elastic = elastic_strain<dim>(law, history);
  for (unsigned int i = 0; i < 6; ++i)
    {
      internal[i]     = history.internal.access_raw_entry(i);
      internal[7 + i] = elastic.access_raw_entry(i);
    }
  internal[6] = history.alpha;
}

void
keep_hardening(double *internal)
{
  const double alpha = internal[6];
  std::fill_n(internal, StepStart<2>::n_internal, 0.);
  internal[6] = alpha;
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
StepStart<dim>::StepStart(const DisplacementSpace<dim> &space, const CutQuadrature<dim> &quadrature,
                          const std::vector<Body<dim>> &bodies, const MaterialPoints<dim> &points,
                          const MovingGeometryParameters &parameters)
    : space(space)
    , bodies(bodies)
    , own_points(points)
    , parameters(parameters)
    , locations(locate_points(space, bodies, points))
    , displacements(space)
    , cloud(points.n_internal())
{
  fitted             = fit_displacement(space, bodies, points, locations);
  Vector distributed = fitted;
  space.hanging_constraints().distribute(distributed);
  Vector ghosted(space.owned(), space.relevant(), space.grid.communicator());
  ghosted = distributed;
  displacements.gather(ghosted);
  if (points.n_internal() > 0 || gradients_are_of_cloud())
    {
      cloud = with_neighbours(space, parameters.support, own_points);
      moving_least_squares.emplace(scree::moving_least_squares(
        cloud, {parameters.least_squares_degree(space.basis.degree), parameters.support, true}));
    }
  find_volume_changes(quadrature);
}

template <int dim>
void
StepStart<dim>::find_volume_changes(const CutQuadrature<dim> &quadrature)
{
  const dealii::Tensor<2, dim>  identity(dealii::unit_symmetric_tensor<dim>());
  const auto                   &whole = quadrature.whole_cell;
  std::vector<PointInCell<dim>> places;
  std::vector<double>           weights;
  change_of_cell.assign(space.n_owned_cells(), -1);
  for (unsigned int a = 0; a < space.n_owned_cells(); ++a)
    {
      const ActiveCell &cell = space.cells()[a];
      const auto       &body = bodies[cell.body];
      if (body.is_rigid() || !has_plastic_strain(*body.law))
        continue;
      const unsigned int begin = cell.is_cut ? quadrature.bulk.begin[a] : 0;
      const unsigned int n
        = cell.is_cut ? quadrature.bulk.begin[a + 1] - begin : whole.points.size();
      const dealii::Point<dim> *points
        = (cell.is_cut ? quadrature.bulk.points : whole.points).data() + begin;
      const double *volumes
        = (cell.is_cut ? quadrature.bulk.weights : whole.weights).data() + begin;
      places.clear();
      for (unsigned int q = 0; q < n; ++q)
        places.push_back({a, points[q]});
      std::optional<PointWeights> of_cloud;
      if (gradients_are_of_cloud())
        of_cloud = this->weights(places);
      const auto                     gradients = deformation_gradients(places, of_cloud);
      std::vector<VolumeChange<dim>> changes;
      weights.assign(volumes, volumes + n);
      for (unsigned int q = 0; q < n; ++q)
        {
          const IncrementStart start = body.law->start({gradients[q], {}, 0.});
          changes.emplace_back(body.law->work(), identity, start);
          weights[q] /= start.volume_ratio;
        }
      change_of_cell[a] = volume_changes.size();
      volume_changes.push_back({{points, weights.data(), n, space.volume_degree()}, {}});
      auto &[modes, values] = volume_changes.back();
      for (unsigned int q = 0; q < n; ++q)
        for (unsigned int m = 0; m < modes.n; ++m)
          values[m] += weights[q] * modes(points[q])[m] * changes[q].value;
    }
}

template <int dim>
dealii::Tensor<2, dim>
StepStart<dim>::projected_gradient(const PointInCell<dim>       &point,
                                   const dealii::Tensor<2, dim> &F) const
{
  if (point.active_cell >= space.n_owned_cells())
    return F; // a point beyond its body, next to a cell of another process
  const auto &law             = *bodies[space.cells()[point.active_cell].body].law;
  const auto &[modes, values] = volume_changes[change_of_cell[point.active_cell]];
  if (modes.n == 0)
    return F;
  const auto psi   = modes(point.unit_point);
  double     value = 0.;
  for (unsigned int m = 0; m < psi.size(); ++m)
    value += psi[m] * values[m];
  VolumeChange<dim> change(law.work(), dealii::Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>()),
                           law.start({F, {}, 0.}));
  return change.project(value, law.projected_share() / dim) * F;
}

template <int dim>
void
StepStart<dim>::set_internal(const PointInCell<dim> &point, const double *internal,
                             PointHistory<dim> &history) const
{
  const auto &law = *bodies[space.cells()[point.active_cell].body].law;
  load_internal(internal, history);
  if (has_plastic_strain(law) && history.alpha > 0.)
    set_plastic_strains<dim>(law, load_tensor(internal + 7),
                             projected_gradient(point, history.deformation_gradient), history);
}

template <int dim>
PointWeights
StepStart<dim>::weights(const std::vector<PointInCell<dim>> &targets) const
{
  Targets<dim> places;
  for (const auto &target : targets)
    {
      places.position.push_back(space.position(target.active_cell, target.unit_point));
      places.body.push_back(space.cells()[target.active_cell].body);
      places.cell_size.push_back(space.cell_size(target.active_cell));
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
  const auto [u_n, gradient] = displacements.evaluate(point);
  return {u_n,
          dealii::invert(dealii::Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>()) - gradient)};
}

template <int dim>
dealii::Point<dim>
StepStart<dim>::reference_position(const PointInCell<dim> &point) const
{
  return space.position(point.active_cell, point.unit_point) - displacements.value(point);
}

template <int dim>
void
StepStart<dim>::require_admissible(const PointInCell<dim>       &point,
                                   const dealii::Tensor<2, dim> &F) const
{
  if (determinant(F) > 0.)
    return;
  const dealii::Point<dim> x = space.position(point.active_cell, point.unit_point);
  throw UserError("Bodies/" + bodies[space.cells()[point.active_cell].body].name,
                  "its displacement at the start of the step turns the material at "
                    + short_place(x) + " inside out: det F = " + short_number(determinant(F)),
                  "use more steps or finer cells; where a prescribed displacement ends at a sharp "
                  "edge, let it end smoothly or load the body by tractions; where material flows "
                  "apart, as in cutting, set Moving geometry/Deformation gradient = moving least "
                  "squares and Level set motion = semi-Lagrangian");
}

template <int dim>
std::vector<dealii::Tensor<2, dim>>
StepStart<dim>::deformation_gradients(const std::vector<PointInCell<dim>> &points,
                                      const std::optional<PointWeights>   &of_cloud) const
{
  if (gradients_are_of_cloud())
    return interpolated_gradients(*of_cloud, cloud.deformation_gradient);
  std::vector<dealii::Tensor<2, dim>> result;
  result.reserve(points.size());
  for (const auto &point : points)
    result.push_back(deformation(point).gradient);
  return result;
}

template <int dim>
std::vector<PointHistory<dim>>
StepStart<dim>::histories(const std::vector<PointInCell<dim>> &points) const
{
  std::vector<PointHistory<dim>> result(points.size());
  std::optional<PointWeights>    of_cloud;
  if (gradients_are_of_cloud() || cloud.n_internal() > 0)
    of_cloud = weights(points);
  const auto gradients = deformation_gradients(points, of_cloud);
  for (std::size_t i = 0; i < points.size(); ++i)
    {
      result[i].deformation_gradient = gradients[i];
      require_admissible(points[i], gradients[i]);
    }
  if (cloud.n_internal() > 0)
    {
      const auto internal = of_cloud->values(cloud.internal, n_internal);
      for (std::size_t i = 0; i < points.size(); ++i)
        set_internal(points[i], &internal[i * n_internal], result[i]);
    }
  return result;
}

template <int dim>
PointHistory<dim>
StepStart<dim>::history_of_material_point(const std::size_t point) const
{
  PointHistory<dim> result;
  result.deformation_gradient = gradients_are_of_cloud() ? own_points.deformation_gradient[point]
                                                         : deformation(locations[point]).gradient;
  if (own_points.n_internal() > 0)
    set_internal(locations[point], &own_points.internal[point * n_internal], result);
  return result;
}

template <int dim>
PointHistory<dim>
StepStart<dim>::carried_history(const std::size_t point) const
{
  PointHistory<dim> result;
  result.deformation_gradient = own_points.deformation_gradient[point];
  if (own_points.n_internal() > 0)
    load_internal(&own_points.internal[point * n_internal], result);
  return result;
}

#define SCREE_INSTANTIATE(dim)   \
  template class StepStart<dim>; \
  template void store_internal(const IncrementLaw<dim> &, const PointHistory<dim> &, double *);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
