#pragma once

#include <scree/contact/grid_node_parameters.h>
#include <scree/mechanics/equilibrium.h>
#include <scree/mechanics/step_start.h>
#include <scree/mechanics/system_solver.h>

#include <memory>
#include <vector>

namespace scree
{
/** What the discrete problem of a run is made with. */
struct ProblemParameters
{
  const DiscretizationParameters &discretization;
  double                          contact_shift; //!< bound on phi on the contact surface, in h
  const GridNodeParameters       &grid_nodes;    //!< instead of the contact surface
  const EnforcementParameters    &enforcement;
  const MovingGeometryParameters &moving;
  const LinearSolverParameters   &linear_solver;
  bool                            has_mass    = false;
  bool                            has_inertia = false; //!< now, with a mass
  bool                            lumps_mass  = false;
};

/**
 * The discrete problem of the bodies where they are: unknowns, cut quadrature, kinematics and its
 * bulk, boundary conditions, contact points, equations and their solver
 * (theory.md section 3, steps 1 to 4). Its parts refer to each other; it is made and destroyed as a
 * whole, on a grid and bodies that outlive it and do not change meanwhile. Only the contact points,
 * which depend on the slip that is expected in the step, may be found anew.
 */
template <int dim>
class DiscreteProblem
{
public:
  /**
   * On a moving geometry seeds the material points of `state` if it has not started, else sends
   * them to the processes of their cells. Collective.
   *
   * @param step_size of the step that comes [time]
   */
  DiscreteProblem(const BackgroundGrid<dim> &grid, const std::vector<ContactPair> &pairs,
                  const ProblemParameters &parameters, State<dim> &state, const double step_size,
                  Timings &timings);

  /** Finds contact points, and makes their equations, for a step of another size (collective). */
  void find_contact(State<dim> &state, const double step_size);

  ContactPoints<dim> &contact() const
  {
    return equations->contact;
  }

  Equilibrium<dim> &equilibrium() const
  {
    return equations->equilibrium;
  }

  SystemSolver<dim> &solver() const
  {
    return equations->solver;
  }

  bool is_moving() const
  {
    return parameters.moving.is_moving;
  }

  /** The bound on phi on the contact surface [L]. */
  double shift() const
  {
    return parameters.contact_shift * grid.finest_size();
  }

  /** Bodies with larger gaps at the start of a step need not have contact points [L]. */
  double contact_reach() const
  {
    return parameters.grid_nodes.is_chosen ? GridNodeParameters::reach(grid.finest_size())
                                           : 2. * shift();
  }

  MPI_Comm communicator() const
  {
    return grid.communicator();
  }

  const ProblemParameters                             parameters;
  const BackgroundGrid<dim>                          &grid;
  const std::vector<Body<dim>>                       &bodies;
  const std::vector<ContactPair>                     &pairs;
  const LevelSetNodes<dim>                            level_set_nodes;
  const DisplacementSpace<dim>                        space;
  const CutQuadrature<dim>                            quadrature;
  const std::unique_ptr<const SmallCutTreatment<dim>> small_cuts;
  const std::unique_ptr<const Kinematics<dim>>        kinematics;
  const Bulk<dim>                                    &bulk; //!< of the kinematics
  const std::shared_ptr<const Mass<dim>>              mass; //!< null without inertia
  const BoundaryTerms<dim>                            boundary_terms;

private:
  /** Here it is chosen what u means; see the constructor. */
  std::unique_ptr<const Kinematics<dim>> make_kinematics(State<dim> &state, Timings &timings) const;
  /** On a moving geometry. */
  std::unique_ptr<const StepStart<dim>> start_of_step(State<dim> &state) const;

  /** What depends on the contact points. */
  struct Equations
  {
    Equations(DiscreteProblem &problem, State<dim> &state, const double step_size);

    ContactPoints<dim> contact;
    Equilibrium<dim>   equilibrium;
    SystemSolver<dim>  solver;
  };

  Timings                   &timings;
  std::unique_ptr<Equations> equations;
};
} // namespace scree
