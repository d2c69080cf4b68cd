#pragma once

#include <scree/mechanics/inertia.h>
#include <scree/mechanics/kinematics.h>

#include <memory>
#include <optional>

namespace scree
{
/**
 * How the equations are integrated in time. A step to t_{n+1} solves r(u) - M a = 0, where the
 * scheme says what the acceleration a is of the unknown u. In Newmark's method, for instance,
 *
 *     a = (u - u_p)/(beta dt^2),      u_p = u_n + dt v_n + dt^2/2 (1 - 2 beta) a_n,
 *     v = v_n + dt ((1 - gamma) a_n + gamma a),
 *
 * so that predicted() is u_p, inertia() has the factor 1/(beta dt^2) of M and the forces
 * M u_p/(beta dt^2), rates() are v and a. The equations know the Inertia, not the scheme.
 */
template <int dim>
class TimeScheme
{
public:
  using Vector = dealii::TrilinosWrappers::MPI::Vector;

  virtual ~TimeScheme() = default;

  /** u at `time` if the motion goes on, where Newton's method may begin; none: it is not known. */
  virtual std::optional<Vector> predicted(const Kinematics<dim> &kinematics,
                                          const State<dim> &state, const double time) const = 0;

  /** What enters the equations of the step to `time`. */
  virtual Inertia inertia(const Kinematics<dim> &kinematics, const State<dim> &state,
                          const double time) const = 0;

  /** Velocity and acceleration at the end of a step to `time`, where the displacement is u. */
  virtual Rates rates(const State<dim> &state, const Vector &u, const double time) const = 0;
};

/** The scheme of a run. */
template <int dim>
std::unique_ptr<const TimeScheme<dim>> make_time_scheme();
} // namespace scree
