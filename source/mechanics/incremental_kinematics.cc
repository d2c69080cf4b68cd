#include <scree/base/exceptions.h>
#include <scree/mechanics/incremental_kinematics.h>
#include <scree/mechanics/incremental_nitsche.h>
#include <scree/mechanics/strong_supports.h>

#include <algorithm>

namespace scree
{
namespace
{
/** Sets the owned nodes of deformable bodies in u to `factor` times the extended increments. */
template <int dim>
void
set_increments(const DisplacementSpace<dim> &space, const Predictor<dim> &predictor,
               const double factor, dealii::TrilinosWrappers::MPI::Vector &u)
{
  for (unsigned int a = 0; a < space.n_owned_cells(); ++a)
    {
      const auto &of_body = predictor.of_bodies[space.cells()[a].body];
      for (unsigned int i = 0; i < space.basis.n_nodes; ++i)
        {
          const DofIndex node = space.nodes(a)[i];
          if (!space.owned().is_element(node) || space.hanging_constraints().is_constrained(node))
            continue;
          const auto increment = factor * of_body(space.position(a, space.basis.node(i)));
          for (unsigned int d = 0; d < dim; ++d)
            u(node + d) = increment[d];
        }
    }
}
} // namespace

template <int dim>
IncrementalKinematics<dim>::IncrementalKinematics(const DisplacementSpace<dim>         &space,
                                                  const CutQuadrature<dim>             &quadrature,
                                                  const std::vector<Body<dim>>         &bodies,
                                                  const SmallCutTreatment<dim>         &small_cuts,
                                                  std::unique_ptr<const StepStart<dim>> start,
                                                  std::unique_ptr<const BulkQuadrature<dim>> points,
                                                  const double start_time)
    : Kinematics<dim>(start_time)
    , space(space)
    , start(std::move(start))
    , points(std::move(points))
    , incremental_bulk(space, quadrature, bodies, small_cuts, *this->points,
                       this->start->displacement_field())
{
}

template <int dim>
const Bulk<dim> &
IncrementalKinematics<dim>::bulk() const
{
  return incremental_bulk;
}

template <int dim>
std::unique_ptr<BoundaryTerm<dim>>
IncrementalKinematics<dim>::prescribed_displacements(
  const BoundarySetting<dim> &setting, const std::vector<unsigned int> &own_regions) const
{
  return std::make_unique<IncrementalNitsche<dim>>(setting, own_regions, incremental_bulk, *points);
}

template <int dim>
bool
IncrementalKinematics<dim>::follows_surface(const BoundaryCondition<dim> &condition) const
{
  return condition.kind().law.follows_surface;
}

template <int dim>
const Shape<dim> *
IncrementalKinematics<dim>::exact_shape(const Body<dim> &) const
{
  return nullptr;
}

template <int dim>
double
IncrementalKinematics<dim>::prescribed(const BoundaryCondition<dim> &condition,
                                       const PrescribedUnknown<dim> &unknown,
                                       const double                  time) const
{
  const auto  &X      = unknown.reference_position;
  const double result = condition.value(unknown.value, X, time)
                        - condition.value(unknown.value, X, this->start_time());
  const bool is_vertex = condition.is_at_vertex();
  require(result == 0. || (!is_vertex && condition.box_face / 2 != unknown.component),
          condition.path,
          std::string("on a moving geometry ")
            + (is_vertex ? "a point support" : "the motion normal to a face of the box")
            + " must be constant: the grid does not move",
          "let the body end inside the box and prescribe the motion of its surface");
  return result;
}

template <int dim>
bool
IncrementalKinematics<dim>::rotations_are_finite() const
{
  return true;
}

template <int dim>
const typename IncrementalKinematics<dim>::Vector &
IncrementalKinematics<dim>::start_displacement() const
{
  return start->displacement();
}

template <int dim>
PointEvaluator<dim>
IncrementalKinematics<dim>::start_displacement_field() const
{
  return start->displacement_field();
}

template <int dim>
dealii::Point<dim>
IncrementalKinematics<dim>::reference_position(const PointInCell<dim> &point) const
{
  return start->reference_position(point);
}

template <int dim>
SurfaceHistory<dim>
IncrementalKinematics<dim>::surface_history(const PointInCell<dim>       &point,
                                            const dealii::Tensor<1, dim> &normal) const
{
  const auto then = start->deformation(point);
  return {then.displacement, (normal * then.gradient).norm() / determinant(then.gradient)};
}

template <int dim>
bool
IncrementalKinematics<dim>::moves_bodies() const
{
  return true;
}

template <int dim>
double
IncrementalKinematics<dim>::position_scale() const
{
  const auto [lower, upper] = space.grid.box().get_boundary_points();
  return std::max(lower.norm(), upper.norm());
}

template <int dim>
bool
IncrementalKinematics<dim>::balances_moments(const Body<dim> &body) const
{
  return body.law->work() == WorkOf::current;
}

template <int dim>
double
IncrementalKinematics<dim>::arm_error(const double largest_displacement) const
{
  return largest_displacement;
}

template <int dim>
MassPoints<dim>
IncrementalKinematics<dim>::mass_points() const
{
  const MaterialPoints<dim> &carriers = start->points();
  return {start->material_points(), carriers.position, carriers.mass};
}

template <int dim>
typename IncrementalKinematics<dim>::Vector
IncrementalKinematics<dim>::extrapolated(const State<dim> &state, const double time) const
{
  const Predictor<dim> &predictor = state.predictor;
  Vector                result    = state.displacement;
  const double          factor    = (time - state.time) / predictor.step_size;
  set_increments(space, predictor, factor, result);
  for (unsigned int b = 0; b < state.bodies.size(); ++b)
    if (state.bodies[b].is_rigid())
      for (unsigned int m = 0; m < n_rigid_components<dim>; ++m)
        if (space.owned().is_element(space.rigid_unknown(b) + m))
          result(space.rigid_unknown(b) + m)
            = state.bodies[b].pose.unknowns()[m] + factor * predictor.of_rigid[b][m];
  result.compress(dealii::VectorOperation::insert);
  return result;
}

template <int dim>
MaterialPoints<dim>
IncrementalKinematics<dim>::moved(const MaterialPoints<dim> &before,
                                  const PointEvaluator<dim> &u) const
{
  return points->moved(before, incremental_bulk, u);
}

template <int dim>
MovingLeastSquaresReport
IncrementalKinematics<dim>::transfer_report() const
{
  return start->transfer_report();
}

template class IncrementalKinematics<2>;
template class IncrementalKinematics<3>;
} // namespace scree
