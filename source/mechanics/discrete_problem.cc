#include <scree/contact/grid_node_contact.h>
#include <scree/contact/level_set_surface.h>
#include <scree/contact/make_enforcement.h>
#include <scree/mechanics/cut_cell_gauss.h>
#include <scree/mechanics/discrete_problem.h>
#include <scree/mechanics/incremental_kinematics.h>
#include <scree/mechanics/material_point_quadrature.h>
#include <scree/mechanics/material_update.h>
#include <scree/mechanics/total_kinematics.h>

namespace scree
{
namespace
{
/** What `make` returns; its wall time is counted as that of the part. */
template <typename F>
auto
timed(Timings &timings, const std::string &part, const F &make)
{
  const Timings::Scope scope(timings, part);
  return make();
}

template <int dim>
ContactPoints<dim>
contact_points(const DiscreteProblem<dim> &problem, State<dim> &state, const double step_size)
{
  const Predictor<dim>    &predictor = state.predictor;
  IncrementPrediction<dim> prediction;
  if (problem.is_moving() && !predictor.is_empty())
    prediction = [&](const unsigned int b, const dealii::Point<dim> &x) {
      return predictor.expected_increment(state.bodies[b], b, x, step_size);
    };
  typename Bulk<dim>::Vector ratios;
  if (problem.is_moving())
    ratios = problem.bulk.nodal_secant_ratios();
  const auto *u_n  = problem.is_moving() ? &problem.kinematics->start_displacement() : nullptr;
  const auto *flow = problem.is_moving() ? &ratios : nullptr;
  ContactPoints<dim> contact(
    problem.bodies, problem.pairs,
    problem.parameters.grid_nodes.is_chosen
      ? grid_node_contact(problem.space, problem.level_set_nodes, problem.bodies, problem.pairs,
                          problem.parameters.grid_nodes, prediction, u_n, flow, &state.start_gaps)
      : level_set_surface(problem.space, problem.level_set_nodes, problem.bodies, problem.pairs,
                          problem.shift(), prediction, u_n, flow, &state.start_gaps));
  contact.set_enforcement(make_enforcement<dim>(problem.parameters.enforcement, contact.points(),
                                                contact.enforcement().stiffness(),
                                                problem.communicator()));
  return contact;
}
} // namespace

template <int dim>
DiscreteProblem<dim>::Equations::Equations(DiscreteProblem &problem, State<dim> &state,
                                           const double step_size)
    : contact(timed(problem.timings, "contact search",
                    [&]() { return contact_points(problem, state, step_size); }))
    , equilibrium(timed(problem.timings, "linear assembly",
                        [&]() {
                          return Equilibrium<dim>(problem.space, problem.bodies,
                                                  *problem.kinematics, problem.boundary_terms,
                                                  contact, problem.mass,
                                                  problem.parameters.has_inertia);
                        }))
    , solver(problem.parameters.linear_solver, problem.space, equilibrium, contact.points().size(),
             problem.timings)
{
}

template <int dim>
DiscreteProblem<dim>::DiscreteProblem(const BackgroundGrid<dim>      &grid,
                                      const std::vector<ContactPair> &pairs,
                                      const ProblemParameters &parameters, State<dim> &state,
                                      const double step_size, Timings &timings)
    : parameters(parameters)
    , grid(grid)
    , bodies(state.bodies)
    , pairs(pairs)
    , level_set_nodes(timed(timings, "fields",
                            [&]() {
                              return LevelSetNodes<dim>(
                                grid, parameters.discretization.degree_of_level_sets(),
                                parameters.discretization.gauss_points());
                            }))
    , space(timed(timings, "fields",
                  [&]() {
                    return DisplacementSpace<dim>(grid, parameters.discretization.degree,
                                                  level_set_nodes, bodies,
                                                  BoundaryTerms<dim>::n_multipliers(bodies));
                  }))
    , quadrature(timed(timings, "quadrature",
                       [&]() { return CutQuadrature<dim>(space, level_set_nodes, bodies); }))
    , small_cuts(make_small_cut_treatment(space, parameters.discretization.ghost_penalty))
    , kinematics(make_kinematics(state, timings))
    , bulk(kinematics->bulk())
    , mass(!parameters.has_mass ? nullptr
                                : timed(timings, "mass",
                                        [&]() {
                                          return std::make_shared<const Mass<dim>>(
                                            space, bodies, *small_cuts, kinematics->mass_points(),
                                            is_moving() ? Mass<dim>::moving_jump_share : 1.,
                                            parameters.lumps_mass);
                                        }))
    , boundary_terms(timed(timings, is_moving() ? "history at quadrature points" : "quadrature",
                           [&]() {
                             return BoundaryTerms<dim>(space, level_set_nodes, quadrature, bodies,
                                                       *kinematics);
                           }))
    , timings(timings)
{
  find_contact(state, step_size);
}

template <int dim>
std::unique_ptr<const Kinematics<dim>>
DiscreteProblem<dim>::make_kinematics(State<dim> &state, Timings &timings) const
{
  if (!is_moving())
    return timed(timings, "quadrature", [&]() {
      return std::make_unique<TotalKinematics<dim>>(space, quadrature, bodies, *small_cuts);
    });
  auto start = timed(timings, "material points", [&]() { return start_of_step(state); });
  return timed(timings, "history at quadrature points", [&]() {
    std::unique_ptr<const BulkQuadrature<dim>> points;
    if (parameters.moving.integration == BulkIntegration::cut_cells)
      points = std::make_unique<CutCellGauss<dim>>(space, quadrature, bodies, *start);
    else
      points = std::make_unique<MaterialPointQuadrature<dim>>(space, bodies, *start);
    return std::make_unique<IncrementalKinematics<dim>>(
      space, quadrature, bodies, *small_cuts, std::move(start), std::move(points), state.time);
  });
}

template <int dim>
std::unique_ptr<const StepStart<dim>>
DiscreteProblem<dim>::start_of_step(State<dim> &state) const
{
  const MovingGeometryParameters &moving = parameters.moving;
  if (state.has_started)
    distribute_points(space, bodies, moving, state.points);
  else
    state.points = seed_points(space, level_set_nodes, bodies, quadrature, moving);
  return std::make_unique<const StepStart<dim>>(space, quadrature, bodies, state.points, moving);
}

template <int dim>
void
DiscreteProblem<dim>::find_contact(State<dim> &state, const double step_size)
{
  equations.reset();
  equations = std::make_unique<Equations>(*this, state, step_size);
}

template class DiscreteProblem<2>;
template class DiscreteProblem<3>;
} // namespace scree
