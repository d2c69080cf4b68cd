#pragma once

#include <scree/mechanics/time_scheme.h>

#include <functional>

namespace scree
{
/**
 * A one-step scheme by what it makes of the motion d = u - u_n of a step, v_n and a_n: linear
 * combinations, the same for nodes and for the point masses of rigid bodies.
 *
 * Contact is implicit whatever the scheme does with other forces (Kane et al. 1999): its force at
 * the end acts throughout the step, so that d and v get dt^2/2 a_c and dt a_c of the acceleration
 * M a_c = r_c, and a_n is that of the other forces r alone. A force that began in the last step
 * would otherwise push once more when contact has opened.
 */
struct StepFormula
{
  struct Combination
  {
    double motion, velocity, acceleration; //!< factors of d, v_n, a_n

    template <typename T>
    T operator()(const T &d, const T &v, const T &a) const
    {
      return motion * d + velocity * v + acceleration * a;
    }
  };
  Combination       balance;      //!< a* of r(u) + share r(u_n) + weight r_c(u) = M a*
  Combination       velocity;     //!< v at the end of the step, but for what contact adds
  Combination       acceleration; //!< a at the end of the step, but for what contact adds
  double            initial_share       = 0.; //!< of r(u_n), see Rates::forces
  double            contact_weight      = 1.;
  double            velocity_by_contact = 0., acceleration_by_contact = -1.; //!< factors of a_c
  LocalErrorFormula local_error = {};

  /** M a = r(u), so that the moments of M a are those of forces. */
  bool balances_at_end() const
  {
    return initial_share == 0.;
  }

  /** w = v_n + (factor) a_n of v = w + (factor) a + (factor) a_c, see AddedSpin. */
  Combination start_velocity() const;
};

/**
 * Newmark's method: d = dt v_n + dt^2/2 ((1 - 2 beta) a_n + 2 beta a + a_c),
 * v = v_n + dt ((1 - gamma) a_n + gamma a + a_c), a* = a + a_c/(2 beta).
 *
 * Without a_c d is wrong by (beta - 1/6) dt^2 (a - a_n) (Zienkiewicz & Xie 1991), v by
 * (gamma - 1/2) dt (a - a_n): the local error is the larger one of the first and dt times the
 * second.
 */
StepFormula newmark(const double dt, const double beta, const double gamma);

/** v = d/dt, a* = a + a_c = (v - v_n)/dt; d is wrong by dt^2 a/2. */
StepFormula backward_euler(const double dt);

/**
 * Generalized alpha (Chung & Hulbert 1993): Newmark's method with
 * (1 - alpha_m) M a + alpha_m M a_n = (1 - alpha_f) r(u) + alpha_f r(u_n), alpha_m = (2 rho - 1)/
 * (rho + 1), alpha_f = rho/(rho + 1), gamma = 1/2 - alpha_m + alpha_f,
 * beta = (1 - alpha_m + alpha_f)^2/4.
 *
 * Its a_n is the acceleration at t_n + theta dt, theta = alpha_m - alpha_f, so that d is wrong by
 * (beta + theta/2 - 1/6) dt^2 (a - a_n), v by less.
 *
 * @param rho the spectral radius at infinite frequency, 0 to 1
 */
StepFormula generalized_alpha(const double dt, const double rho);

/** The TimeScheme of a StepFormula. */
template <int dim>
class OneStepScheme : public TimeScheme<dim>
{
public:
  using typename TimeScheme<dim>::Vector;

  /** @param formula of a step of a size [time] */
  explicit OneStepScheme(const std::function<StepFormula(double)> &formula);

  /** u_n + dt v_n + dt^2/2 a_n. */
  std::optional<Vector> predicted(const Kinematics<dim> &kinematics, const State<dim> &state,
                                  const double time) const override;
  Inertia<dim>      inertia(const std::shared_ptr<const Mass<dim>> &mass, const State<dim> &state,
                            const double time) const override;
  Rates             rates(const Mass<dim> *mass, const State<dim> &state, const Vector &u,
                          const Vector &by_contact, const std::vector<bool> &turns_freely,
                          const double time) const override;
  LocalErrorFormula local_error(const double step_size) const override;

private:
  /** What rates() does to rigid bodies. */
  void set_rates_of_rigid(const StepFormula &of_step, const Mass<dim> &mass,
                          const State<dim> &state, const Vector &u, const Vector &by_contact,
                          const std::vector<bool> &loses_spin, Rates &rates) const;

  const std::function<StepFormula(double)> formula;
};
} // namespace scree
