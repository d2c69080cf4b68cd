#pragma once

#include <scree/mechanics/inertia.h>
#include <scree/mechanics/kinematics.h>
#include <scree/mechanics/time_scheme_parameters.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace scree
{
/**
 * The displacement that a scheme adds wrongly in a step, by its accelerations with those of
 * contact, e = at_end a_{n+1} + at_start a_n; e/dt is of the order p in dt.
 */
struct LocalErrorFormula
{
  double       at_end = 0., at_start = 0.; //!< [time^2]
  unsigned int order       = 1;            //!< p
  double       mass_factor = 0.;           //!< c of c M in the tangent [1/time^2]
};

/**
 * How the equations are integrated in time. A step to t_{n+1} solves r(u) - M a = 0, where the
 * scheme says what the acceleration a is of the unknown u. The equations know the Inertia, not the
 * scheme. State::predictor has the rates at the start of the step.
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

  /** What enters the equations of the step to `time`. @param mass null without inertia */
  virtual Inertia<dim> inertia(const std::shared_ptr<const Mass<dim>> &mass,
                               const State<dim> &state, const double time) const = 0;

  /**
   * Velocity and acceleration at the end of a step to `time`, where the displacement is u; forces
   * as at its start.
   *
   * @param by_contact   accelerations that contact causes there; of no use without inertia
   * @param turns_freely bodies that get no AddedSpin
   */
  virtual Rates rates(const Mass<dim> *mass, const State<dim> &state, const Vector &u,
                      const Vector &by_contact, const std::vector<bool> &turns_freely,
                      const double time) const = 0;

  /** The leading term of the local error of a step of a size [time]; zero without inertia. */
  virtual LocalErrorFormula local_error(const double step_size) const = 0;
};

/** The names that TimeSchemeParameters::scheme may have. */
std::vector<std::string> time_scheme_names();

/** The scheme of the present stage of a run. */
template <int dim>
std::unique_ptr<const TimeScheme<dim>> make_time_scheme(const TimeSchemeParameters &parameters);
} // namespace scree
