#pragma once

#include <scree/application/parameters.h>
#include <scree/base/run_log.h>
#include <scree/mechanics/discrete_problem.h>
#include <scree/mechanics/time_scheme.h>
#include <scree/output/results.h>
#include <scree/state/gathered_state.h>

#include <memory>
#include <vector>

namespace scree
{
/**
 * The bodies of a run on their grid: a State and the discrete problem on it. The state changes in
 * accept() and move_geometry() and nowhere else.
 */
template <int dim>
class Model
{
public:
  using Vector = typename Equilibrium<dim>::Vector;

  /**
   * Parameters and log outlive it.
   *
   * @param step_size of the first step [time]
   * @throws UserError if the set-up is impossible
   */
  Model(const Parameters<dim> &parameters, const double step_size, const MPI_Comm communicator,
        RunLog &run_log);

  Model(const Model &)            = delete; // the problem refers to the state
  Model &operator=(const Model &) = delete;

  const State<dim> &state() const
  {
    return current;
  }

  DiscreteProblem<dim> &problem() const
  {
    return *discrete_problem;
  }

  const TimeScheme<dim> &time_scheme() const
  {
    return *scheme;
  }

  bool is_moving() const
  {
    return parameters.moving.is_moving;
  }

  /** Whether bodies have inertia in the present stage. Their Mass they have in all stages. */
  bool has_inertia() const
  {
    return parameters.time_scheme.has_inertia() && !parameters.time_scheme.is_static_stage;
  }

  /** Whether pairs are found anew in every step: there are many on a moving geometry. */
  bool pairs_change() const
  {
    return pairs_are_many;
  }

  /**
   * Takes u at `time`, which the equilibrium accepted, as the state. On a moving geometry
   * move_geometry() follows.
   *
   * @param rates there; none unless time goes on
   */
  void accept(const Vector &u, const double time, const Rates &rates = {});

  /**
   * Moves the bodies by the accepted displacement: level sets, poses, material points; makes the
   * discrete problem there and carries contact on to it (theory.md section 3, step 7).
   *
   * @param points    after the step, see moved_points()
   * @param step_size of the next step [time]
   * @throws UserError if a body has left the background box and must not
   */
  MotionRecord<dim> move_geometry(MaterialPoints<dim> &&points, const double step_size);

  /** On a moving geometry: begins a step of another size, for contact points expect its slip. */
  void begin_again(const double step_size);

  /**
   * On a moving geometry: goes back to a state that state() was since the last step, and begins a
   * step there (collective).
   */
  void go_back(State<dim> &&to, const double step_size);

  /**
   * Undoes accept(), before the geometry moves: goes back to what state() was before, and begins a
   * step there (collective).
   */
  void take_back(State<dim> &&before, const double step_size);

  /**
   * Takes what drives the rigid bodies from now on, friction, and whether there is inertia, from
   * the parameters (collective). Where other components are free than before, or friction changes,
   * the discrete problem is made anew. Where inertia begins, so does the initial motion.
   */
  void begin_stage(const bool friction_changes, const double step_size);

  /**
   * On a moving geometry without inertia, at the start of a step: lets the bodies be free of
   * stress, strain and tangential traction where they are, the new start of their displacements;
   * equivalent plastic strain stays (collective).
   *
   * @return the change of the stored energy
   */
  double reset(const double step_size);

  /** What a checkpoint needs of the state, on process 0; collective. */
  GatheredState<dim> gathered() const;

  /**
   * Goes to a saved state at `time` (collective).
   * @throws UserError if it does not fit; names the directory of the checkpoint
   */
  void restore(const GatheredState<dim> &saved, const double time, const double step_size,
               const std::string &directory);

private:
  std::vector<Body<dim>> make_bodies_and_laws();
  /** Those that may touch before the pairs are found again. */
  std::vector<ContactPair> find_pairs() const;
  /** Of each body, whether a load drives it in some stage: so are pairs the same in all stages. */
  std::vector<bool> ever_free() const;
  /** Lattice nodes coincide with the nodes of level sets on the finest cells. */
  LatticeFrame<dim> lattice_frame() const;
  /** Wide enough for the reach of contact and for coarse cells that straddle the surface. */
  double lattice_margin() const;
  /** Grid and discrete problem of the present geometry. */
  void discretise(const double step_size);
  void make_problem(const double step_size);
  /** On a fixed geometry: makes the problem see the state. */
  void resume_problem();
  /** Begins a step on the new geometry: State::displacement and the history of contact. */
  void start_step();
  /** Sets the displacements of rigid bodies to their poses. */
  void set_rigid_rows();
  /** With inertia: the initial velocities, and the accelerations that belong to them; all that the
   * bodies then have is external work, but for what they have had before. */
  void start_motion(const double step_size);
  /** With inertia on a moving geometry: those of the bodies for the next grid. */
  void keep_rates_of_rigid();
  /** With inertia on a moving geometry: velocities and accelerations of points and rigid bodies as
   * fields on the new grid. */
  void fit_rates();
  /** Level sets, boxes, poses, and what the next step expects of a displacement with ghosts;
   * returns the number of islands. */
  unsigned int move_bodies(const Vector &ghosted);

  const Parameters<dim>                 &parameters;
  const MPI_Comm                         communicator;
  RunLog                                &run_log;
  std::unique_ptr<const TimeScheme<dim>> scheme;
  std::unique_ptr<BackgroundGrid<dim>>   grid;
  State<dim>                             current;
  bool                                   pairs_are_many = false;
  bool                                   is_reset       = false; //!< in the course of the run
  std::vector<ContactPair>               pairs;
  std::unique_ptr<DiscreteProblem<dim>>  discrete_problem;
};
} // namespace scree
