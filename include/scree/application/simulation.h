#pragma once

#include <scree/application/checkpoint.h>
#include <scree/application/parameters.h>
#include <scree/base/log.h>
#include <scree/base/timings.h>
#include <scree/contact/contact_memory.h>
#include <scree/mechanics/equilibrium.h>
#include <scree/mechanics/error_indicator.h>
#include <scree/mechanics/moving_level_sets.h>
#include <scree/output/body_output.h>
#include <scree/output/results.h>

#include <deal.II/base/timer.h>

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace scree
{
/** Estimate of the error of the displacement in the energy norm. */
struct ErrorEstimate
{
  std::vector<double> squares;       //!< eta_K^2 of the owned grid cells [force L]
  double              relative = 0.; //!< sqrt(sum of eta_K^2 / (2 strain energy))
};

/**
 * A run: sets the bodies up on their grid, walks through the load steps, writes what happens.
 * The members are the modules, the steps those of theory.md section 3.
 */
template <int dim>
class Simulation
{
public:
  /**
   * @param output_directory where results go; must exist
   * @param checkpoint       of the run in that directory, which goes on after it; null: a new run
   * @throws UserError if the set-up is impossible, or the checkpoint belongs to something else
   */
  Simulation(const Parameters<dim> &parameters, const std::string &output_directory,
             const MPI_Comm communicator, const Checkpoint<dim> *checkpoint = nullptr);

  /** All load steps. @throws UserError if a step cannot be solved. */
  void run();

  /** Reports what was set up and writes it for pictures; computes nothing. */
  void check();

  /** Of the present state, by stress recovery; NaN on a moving geometry; collective. */
  ErrorEstimate estimate_error() const;

  /** Owned grid cells at which bodies were in contact at the end of some load step; collective. */
  std::vector<bool> contact_cells() const;

  /** Columns of history.csv and probes.csv, and their values after the last step. */
  std::vector<std::string> columns() const
  {
    return results->columns(*equilibrium, *contact);
  }
  std::vector<double> last_values() const
  {
    return results->last_values();
  }

  const BackgroundGrid<dim> &background_grid() const
  {
    return *grid;
  }

  const ContactPoints<dim> &contact_points() const
  {
    return *contact;
  }

  /** Nodal values of the level sets of all bodies. */
  double n_level_set_values() const;

  unsigned int n_unknowns() const;

private:
  void set_up();
  /** Those that may touch before the pairs are found again. */
  std::vector<ContactPair> find_pairs() const;
  /** Lattice nodes coincide with the support points of degree k on the finest cells. */
  LatticeFrame<dim> lattice_frame() const;
  /** Wide enough for the reach of contact and for coarse cells that straddle the surface. */
  double lattice_margin() const;
  /** Grid, fields, quadrature, contact points and equations of the present geometry. */
  void discretise();
  void set_up_equilibrium(); //!< contact points and equations
  bool is_moving() const
  {
    return parameters.moving.is_moving;
  }
  // Moving geometry, simulation_moving.cc.
  /** Material points, new or moved, on their processes, and what they say of the step's start. */
  void set_up_points();
  void seed_points();
  /** Begins a step on the new geometry, see State::step_end. */
  void         start_step();
  unsigned int points_per_direction() const; //!< m of the m^dim points of a cell
  void         divide_points();              //!< of finer cells than they were made for
  /** Moves the bodies by the last step and begins the next one. */
  void move_geometry();
  /** Compares with the totals of the step before. */
  void require_no_loss(const std::vector<PointTotals<dim>> &points);
  /** The material points after the increment, with the law's answers. */
  MaterialPoints<dim> moved_points(const typename Equilibrium<dim>::Vector &u) const;
  /** Why a converged increment is too large for the moving geometry; empty: it is not. */
  std::string why_too_large() const;
  /** expected_increment() for the search of contact; empty in the first step. */
  typename ContactPoints<dim>::Prediction prediction() const;
  /** What the last increment lets expect of a body at x in the coming step. */
  dealii::Tensor<1, dim> expected_increment(const unsigned int        body,
                                            const dealii::Point<dim> &x) const;
  /** The start of the step plus the last increment, scaled to the step. */
  typename Equilibrium<dim>::Vector predicted(const double time) const;
  // What a converged step must satisfy, simulation_checks.cc.
  /** Forces and moments of every body; @throws UserError if they are not in balance */
  std::vector<BodyBalance<dim>> require_balance(const typename Equilibrium<dim>::Vector &u);
  [[noreturn]] void             throw_out_of_balance(const BodyBalance<dim> &balance,
                                                     const bool              is_force) const;
  void warn_of_meetings(const typename Equilibrium<dim>::Vector &u); //!< beyond the contact search
  /** Tells once of each body that it turned too far for linear kinematics. */
  void warn_of_rotations(const std::vector<BodyBalance<dim>>     &balances,
                         const typename Equilibrium<dim>::Vector &u);
  /** What is prescribed, in the first step, half way and at the end, is possible and finite. */
  void require_prescribable();
  /** Of the material points. @throws UserError if some left the box and must not */
  void require_inside_box() const;
  // Checkpoints, simulation_checkpoint.cc.
  /** Writes a checkpoint if one is due after an accepted step; a failure is told in the log. */
  void save_if_due();
  void save();
  /** Saves and @throws Interrupted if a signal asked for it (collective). */
  void            end_if_interrupted();
  Checkpoint<dim> collect() const;
  FixedState<dim> collect_fixed() const;
  /** Goes to the state of a checkpoint; the problem is set up. */
  void resume(const Checkpoint<dim> &checkpoint);
  void resume_moving(const MovingState<dim> &saved);
  void resume_fixed(const FixedState<dim> &saved);
  void report_set_up();
  /** Of old displacements, their extrapolation and, with rigid bodies, the linear prediction, the
   * one with the smallest residual. */
  typename Equilibrium<dim>::Vector first_guess(const double time);
  typename Equilibrium<dim>::Vector extrapolated(const double time) const;
  bool                              solve_step(const double time);
  /**
   * Before the first step bodies that overlap find their equilibrium without friction and loads, on
   * a moving geometry in parts, where that fails against a drag: friction begins with tau = 0, the
   * energy is external work. If something is prescribed at t = 0, or nothing helps, step 1 does it.
   */
  void resolve_overlap();
  /** One part, which leaves the overlaps times `left`: the largest motion [L]; empty: it failed. */
  std::optional<double> resolve_part(const std::vector<double> &overlaps, const double left);
  /** On a moving geometry free bodies fall as rigid ones, driven by the loads of the next step,
   * half a cell at a time, until contact holds them; the energy is that of transfer. */
  void settle();
  /** The loads of step 1 close contact without friction; false: no, or motion is prescribed. */
  bool close_without_friction();
  /** Takes u, which the equilibrium accepted, as the state at the present time. */
  void go_on_from(const typename Equilibrium<dim>::Vector &u);
  /** Whether the geometry has moved or a step was accepted. */
  bool has_started() const
  {
    return geometry_has_moved || step_control.n_accepted() > 0;
  }
  /** What to tell if bodies on a fixed geometry slipped by more than a cell per nominal step. */
  std::optional<UserError> slide() const;
  NewtonResult             solve_equilibrium(typename Equilibrium<dim>::Vector &u);
  /** @param pressed the contact pressures, added up: now and at most */
  Newton::Hooks newton_hooks(std::pair<double, double> &pressed);
  /** Solves K du = r to |r - K du| <= tolerance |r| or better, condensed to the contact points
   * where that pays. */
  LinearSolveResult solve_linear_system(const LinearSolver::Vector &r, const double tolerance,
                                        LinearSolver::Vector &du);
  void              report_step(const double wall_time);
  /** Tells of contacts at very few points, once per pair. */
  void report_under_resolved();
  void report_end();
  /**
   * What of the loads of `time` on free bodies no contact can balance, a part of the loads, and the
   * motion they drive, see FreeBodies::unbalanced(); geometry and contact of the start of the step.
   */
  double unbalanced_part(const double time, typename FreeBodies<dim>::Coordinates &motion);
  /** @throws UserError if no contact can balance the loads of the step that failed. */
  void require_equilibrium_exists();
  /** @param held_until NaN: not even the loads of the start of the step are balanced */
  [[noreturn]] void throw_slides_away(const typename FreeBodies<dim>::Coordinates &motion,
                                      const double                                 held_until);
  /** Tells once of each body that nothing holds at the end of a step. */
  void tell_what_is_loose();
  /** Makes pictures of the output directory by contrib/plot, where it is installed. */
  void plot() const;
  /** Counts the contact points of each pair that changed their state since the last iteration. */
  void count_flips();
  void explain_failure(const NewtonResult &result);
  void write_results();

  Parameters<dim> parameters;
  MPI_Comm        communicator;
  Log             log;
  Timings         timings;
  std::string     directory;

  std::unique_ptr<BackgroundGrid<dim>> grid;
  std::vector<Body<dim>>               bodies;
  std::vector<ContactPair>             pairs;
  bool                                 pairs_change = false; //!< found in every step
  std::unique_ptr<LevelSetNodes<dim>>  level_set_nodes;
  std::unique_ptr<Fields<dim>>         fields;
  std::unique_ptr<CutQuadrature<dim>>  quadrature;
  std::unique_ptr<StepStart<dim>>      step_start; //!< on a moving geometry
  std::unique_ptr<ContactPoints<dim>>  contact;
  std::unique_ptr<Bulk<dim>>           bulk;
  std::unique_ptr<BoundaryTerms<dim>>  boundary_terms;
  std::unique_ptr<Equilibrium<dim>>    equilibrium;
  std::unique_ptr<LinearSolver>        linear_solver;
  std::unique_ptr<CondensedSolver>     condensed_solver; //!< made when first needed
  std::unique_ptr<Results<dim>>        results;
  StepControl                          step_control;
  double                               fraction_at_restart = 0.; //!< of the end time
  dealii::Timer                        since_checkpoint;
  unsigned int                         n_checkpoints    = 0;
  std::size_t                          checkpoint_bytes = 0; //!< of the last one, on process 0
  State<dim>                           state;
  StepRecord                           record;         //!< of the step being solved
  typename Equilibrium<dim>::Vector    last_increment; //!< of the last step, per time
  std::vector<PointTotals<dim>>        points_before;  //!< by body, at the end of the last step
  MaterialPoints<dim>                  points_at_end;  //!< of the step being solved
  Predictor<dim>                       predictor;      //!< on a moving geometry
  std::set<unsigned int>               told_as_loose;  //!< bodies
  bool                                 geometry_has_moved = false;
  bool                                 is_transient       = false; //!< K has more artificial mass
  bool is_second_attempt = false; //!< how steps are tried, see Equilibrium::set_second_attempt()
  bool is_too_large      = false; //!< the solution of the step, for the moving geometry
  /** Told once; (b, b): at the box, (b, none): out of balance, (b, a), b > a: under-resolved. */
  std::set<std::pair<unsigned int, unsigned int>> warned_pairs;
  std::set<unsigned int>                          warned_rotations; //!< bodies, told once
  std::vector<bool>          was_closed;  //!< contact points, at the end of some step
  std::vector<ContactStatus> last_status; //!< of the contact points in the last iteration
  std::vector<unsigned int>  n_flips;     //!< per pair
};
} // namespace scree
