#pragma once

#include <scree/mechanics/discrete_problem.h>
#include <scree/mechanics/time_scheme.h>

#include <functional>
#include <vector>

namespace scree
{
/** Root mean squares over the mass of the bodies of a field like the velocity at u, zero of those
 * without mass (collective). */
template <int dim>
std::vector<double> root_mean_squares(const DiscreteProblem<dim>              &problem,
                                      const typename Equilibrium<dim>::Vector &u,
                                      const typename Equilibrium<dim>::Vector &field);

/** When contact closes, as the motion at the start of a step goes on. */
struct Closing
{
  double       part = 1.; //!< of the step that is over; 1: not in this step
  unsigned int pair = 0;
};

/**
 * The error that a scheme makes in a step with inertia: e of LocalErrorFormula, by the
 * accelerations of all forces. They have parts of motions that are faster than the step and have no
 * amplitude. So the error is what the equations of the step make of it (Shampine & Baca 1984),
 * twice,
 *
 *     (c M + K) e' = c M e,   (c M + K) e'' = c M e',
 *
 * where modes of the frequency w have (c/(c + w^2))^2 of e. Rigid bodies have their point masses.
 * All functions are collective.
 */
template <int dim>
class LocalError
{
public:
  using Vector = typename Equilibrium<dim>::Vector;
  using Solve  = std::function<void(const Vector &b, Vector &x)>;

  /** At the start of a step: evaluates residual() there. All arguments outlive it. */
  LocalError(const DiscreteProblem<dim> &problem, const TimeScheme<dim> &scheme,
             const State<dim> &state);

  /**
   * When pairs that are open close in a step to `time` by velocities and mean accelerations of
   * bodies, if they then overlap by more than a length. Evaluates contact at another displacement.
   */
  Closing closing(const double time, const double overlap) const;

  /** The largest displacement in a step to `time` if velocities stay [L]. */
  double largest_motion(const double time) const;

  /**
   * Of each body the rms value of e'' of a step to `time`, at the u of the last residual().
   *
   * @param solve x with K x = b
   */
  std::vector<double> of_bodies(const Vector &u, const Rates &rates, const double time,
                                const Solve &solve) const;

  /** Of each pair whether it is closed at the last residual(), and whether it was at the start. */
  std::vector<bool>        are_closed() const;
  const std::vector<bool> &were_closed() const
  {
    return closed_at_start;
  }

private:
  using Points = std::vector<typename RigidMasses<dim>::Vectors>;

  /** u_n + dt v_n, and what is prescribed. */
  Vector predicted(const double time) const;
  /** Accelerations of all forces at the last residual(). */
  Vector accelerations(const Vector &u, const Rates &rates) const;
  /** M v of a field, with the rows of rigid bodies. */
  Vector momenta(const Vector &u, const Vector &field) const;
  Points of_rigid(const Vector &u, const Vector &velocity, const Vector &acceleration) const;

  const DiscreteProblem<dim> &problem;
  const TimeScheme<dim>      &scheme;
  const State<dim>           &state;
  Vector                      at_start; //!< a_n
  Points                      rigid_at_start;
  std::vector<bool>           closed_at_start;
};
} // namespace scree
