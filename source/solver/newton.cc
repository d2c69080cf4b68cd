#include <scree/solver/line_search.h>
#include <scree/solver/linear_solver.h>
#include <scree/solver/newton.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace scree
{
namespace
{
// The constants that newton.h documents.
constexpr double       armijo               = 1e-4;
constexpr unsigned int max_halvings         = 8;
constexpr double       good_reduction       = 0.3;
constexpr double       work_reduction       = 0.8;
constexpr unsigned int max_work_evaluations = 6;
constexpr double       divergence_factor    = 1e8;
constexpr double       round_off_factor     = 100;
constexpr double       round_off_increment  = 1e-10;
constexpr double       forcing_factor       = 0.9;
constexpr double       forcing_safeguard    = 0.1;
constexpr double       final_linear_factor  = 0.1;
constexpr unsigned int transient_iterations = 12;
constexpr double       transient_reduction  = 1e-3;
constexpr unsigned int stall_iterations     = 8;
constexpr double       stall_reduction      = 0.7;
constexpr double       first_mass           = 0.1;
constexpr double       smallest_mass        = 1e-6;
constexpr double       first_later_mass     = 1e-4;
constexpr double       smallest_later_mass  = 1e-9;
constexpr double       mass_decay           = 0.1;
constexpr double       mass_growth          = 4;
constexpr double       short_step           = 0.01;
constexpr unsigned int max_short_steps      = 3;
constexpr double       largest_mass         = 10;
constexpr double       first_secant_part    = 0.25;
constexpr double       least_secant_part    = 1e-2;
constexpr double       secant_growth        = 4;
constexpr double       secant_decay         = 0.5;
constexpr double       energy_overshoot     = 0.5;
constexpr double       energy_reduction     = 0.1;
constexpr unsigned int max_energy_trials    = 16;
constexpr unsigned int max_balances         = 6;

const EnumNames<LineSearch> line_search_names
  = {{LineSearch::none, "none"}, {LineSearch::residual, "residual"}, {LineSearch::work, "work"}};

std::string
in_words(const char *format, const unsigned int n, const double residual, const double tolerance)
{
  char text[200];
  std::snprintf(text, sizeof(text), format, n, residual, tolerance);
  return text;
}

/** The relative tolerance of the next linear system (Eisenstat, Walker, choice 2). */
double
forcing_term(const std::vector<double> &residuals, const double last, const double tolerance,
             const double loosest)
{
  const std::size_t n   = residuals.size();
  double            eta = loosest;
  if (n >= 2)
    {
      eta = forcing_factor * std::pow(residuals[n - 1] / residuals[n - 2], 2);
      if (forcing_factor * last * last > forcing_safeguard)
        eta = std::max(eta, forcing_factor * last * last);
    }
  return std::clamp(eta, std::min(loosest, final_linear_factor * tolerance / residuals[n - 1]),
                    loosest);
}

/** Whether the residual did not fall to half in either of the last two iterations. */
bool
is_plateau(const std::vector<double> &residuals)
{
  const std::size_t n = residuals.size();
  return n >= 3 && residuals[n - 1] > 0.5 * residuals[n - 2]
         && residuals[n - 2] > 0.5 * residuals[n - 3];
}

/** Whether the residual ceased to fall at the level of round-off, see the class documentation. */
bool
is_round_off(const NewtonIteration &iteration, const double norm_of_u)
{
  return iteration.residual <= round_off_factor * iteration.tolerance
         && iteration.increment <= iteration.step_length * round_off_increment * norm_of_u;
}

/** Whether the residual ceased to fall, see the class documentation. */
bool
is_stalled(const std::vector<double> &residuals)
{
  if (residuals.size() <= stall_iterations + 1)
    return false;
  const auto middle = residuals.end() - stall_iterations;
  return *std::min_element(middle, residuals.end())
         > stall_reduction * *std::min_element(residuals.begin(), middle);
}
} // namespace

void
NewtonParameters::declare(const ParameterSection &section)
{
  section.entry("Relative tolerance", relative_tolerance, dealii::Patterns::Double(1e-16, 0.01),
                "Converged when the residual is this small relative to the forces [-].");
  section.entry("Absolute tolerance", absolute_tolerance, dealii::Patterns::Double(0.),
                "Added to the relative tolerance times the forces [force].");
  section.entry("Maximum iterations", max_iterations, dealii::Patterns::Integer(1),
                "A load step that needs more is cut. Where Newton's method stalls, a second method "
                "with an artificial mass goes on; its iterations count too.");
  section.entry(
    "Loosest linear tolerance", loosest_linear_tolerance, dealii::Patterns::Double(0., 0.1),
    "Iterative linear solvers are asked for this at first and for more as the iteration "
    "converges (Eisenstat and Walker); 0: always for Linear/Tolerance [-].");
  section.entry("Line search", line_search, line_search_names,
                "work: shortens a step that overshoots, judged by the work of the residual on the "
                "increment. residual: halves a step until the residual falls. none: full steps.");
}

/** A trial of the line search: the alpha, and the u and r there. */
struct Newton::Step
{
  double       alpha       = 1;
  unsigned int evaluations = 0;
  double       norm        = 0;
  Vector       u;
  Vector       r;
};

/** What the method of the iteration is. */
struct Newton::Progress
{
  bool         is_transient = false; //!< the first part of a round
  bool         is_later     = false; //!< in a round
  LineSearch   line_search;
  double       mass          = 0.; //!< s
  double       secant_part   = 0.; //!< of friction
  unsigned int iterations    = 0;  //!< before this method
  unsigned int n_short_steps = 0;  //!< in a row

  /** Makes s smaller after a long step, larger after a short one. */
  void adapt(const double alpha)
  {
    if (alpha > 0.5)
      mass = std::max(is_transient ? smallest_mass : smallest_later_mass, mass_decay * mass);
    else if (alpha < 0.2)
      mass = std::min(largest_mass, mass_growth * mass);
  }

  /** Starts the method anew. */
  void begin()
  {
    n_short_steps = 0;
    secant_part   = 0.;
  }

  /**
   * Counts short steps and chooses the part of the secant of friction.
   * @param ratio  of the residuals after and before the step
   * @param is_far whether a body would go far in the whole step
   */
  void end_step(const double alpha, const double ratio, const bool is_far)
  {
    n_short_steps = alpha < short_step ? n_short_steps + 1 : 0;
    if (is_transient)
      return;
    if (alpha < 0.5 && (is_far || secant_part > 0.))
      secant_part = std::clamp(secant_growth * secant_part, first_secant_part, 1.);
    else
      secant_part *= std::min(secant_decay, ratio);
    if (secant_part < least_secant_part)
      secant_part = 0.;
  }
};

/** The end of an iteration. */
struct Newton::End
{
  NewtonStatus status;
  const char  *format; //!< of the message: iteration, residual, tolerance
};

Newton::Newton(const NewtonParameters &parameters, const Hooks &hooks)
    : parameters(parameters)
    , hooks(hooks)
{
}

bool
Newton::balance(Vector &u, Vector &r) const
{
  unsigned int k = 0;
  for (; k < max_balances && hooks.balance && hooks.balance(u); ++k)
    hooks.residual(u, r);
  return k > 0;
}

void
Newton::evaluate(Step &step, const double alpha, const Vector &u, const Vector &du) const
{
  step.alpha = alpha;
  step.u     = u;
  if (hooks.advance)
    {
      Vector increment(du);
      increment *= alpha;
      hooks.advance(increment, step.u);
    }
  else
    step.u.add(alpha, du);
  hooks.residual(step.u, step.r);
  step.norm = step.r.l2_norm();
  ++step.evaluations;
}

Newton::Step
Newton::search_residual(Step step, const Vector &u, const Vector &du, const double norm) const
{
  double     best_alpha = step.alpha, best_norm = step.norm;
  const auto is_wanted = [&]() {
    const bool is_enough = step.norm <= (1 - armijo * step.alpha) * norm;
    return !is_enough || (step.norm <= best_norm && step.norm > good_reduction * norm);
  };
  for (unsigned int k = 0; k < max_halvings && is_wanted(); ++k)
    {
      evaluate(step, step.alpha / 2, u, du);
      if (!(best_norm <= step.norm))
        {
          best_alpha = step.alpha;
          best_norm  = step.norm;
        }
    }
  if (step.alpha != best_alpha)
    evaluate(step, best_alpha, u, du);
  return step;
}

Newton::Step
Newton::search_work(Step step, const Vector &u, const Vector &du, const double work) const
{
  // G has opposite signs at a and b; the Illinois variant halves the value of an end that stays.
  double a = 0, work_a = work, b = step.alpha, work_b = step.r * du;
  if (!(work_a * work_b < 0))
    return step;
  double last = work_b;
  for (unsigned int k = 0;
       k < max_work_evaluations && std::abs(last) > work_reduction * std::abs(work); ++k)
    {
      evaluate(step, (a * work_b - b * work_a) / (work_b - work_a), u, du);
      last = step.r * du;
      if (last * work_b < 0)
        {
          a      = b;
          work_a = work_b;
        }
      else
        work_a /= 2;
      b      = step.alpha;
      work_b = last;
    }
  return step;
}

Newton::Step
Newton::search(const Vector &u, const Vector &du, const Vector &r, const double norm,
               const LineSearch method) const
{
  Step step;
  step.r.reinit(r, true);
  evaluate(step, 1., u, du);
  for (unsigned int k = 0; k < max_halvings && !std::isfinite(step.norm); ++k)
    evaluate(step, step.alpha / 2, u, du);
  if (!std::isfinite(step.norm) || method == LineSearch::none)
    return step;
  if (method == LineSearch::residual)
    return search_residual(std::move(step), u, du, norm);
  return search_work(std::move(step), u, du, r * du);
}

Newton::Step
Newton::search_energy(const Vector &u, const Vector &du, const Vector &r, Progress &progress) const
{
  Step step;
  step.r.reinit(r, true);
  evaluate(step, 1., u, du);
  for (unsigned int k = 0; k < max_halvings && !std::isfinite(step.norm); ++k)
    evaluate(step, step.alpha / 4, u, du);
  const double mass = hooks.mass_work(du), start = r * du;
  const auto   G = [&]() { return step.r * du - step.alpha * mass; };
  if (const double after = G();
      start > 0. && std::isfinite(step.norm) && after < -energy_overshoot * start)
    find_zero(
      [&](const double alpha) {
        evaluate(step, alpha, u, du);
        return G();
      },
      start, step.alpha, after, energy_reduction * start, max_energy_trials);
  progress.adapt(step.alpha);
  return step;
}

NewtonResult
Newton::solve(Vector &u) const
{
  Vector   last(u);
  Progress progress;
  progress.line_search = parameters.line_search;
  NewtonResult result  = iterate(u, progress);
  if (!hooks.set_mass)
    return result;
  // Whether the residual fell.
  const auto go_on = [&](Vector &from) {
    progress.iterations        = result.iterations;
    NewtonResult        next   = iterate(from, progress);
    const bool          fell   = next.residuals.back() < next.residuals.front();
    std::vector<double> before = std::move(result.residuals);
    before.insert(before.end(), next.residuals.begin(), next.residuals.end());
    next.residuals = std::move(before);
    result         = std::move(next);
    return fell;
  };
  double transient_mass = first_mass;
  while (!result.converged() && result.iterations < parameters.max_iterations)
    {
      progress.is_transient = true;
      progress.is_later     = true;
      progress.mass         = transient_mass;
      hooks.residual(last, u);
      hooks.freeze(true);
      go_on(last);
      hooks.freeze(false);
      if (!std::isfinite(result.residuals.back()))
        break;
      transient_mass        = std::max(progress.mass, first_later_mass);
      progress.mass         = first_later_mass;
      progress.is_transient = false;
      // What one line search cycles in, the other one may leave.
      if (parameters.line_search != LineSearch::none)
        progress.line_search
          = progress.line_search == LineSearch::work ? LineSearch::residual : LineSearch::work;
      u = last;
      if (go_on(u))
        last = u;
    }
  hooks.set_mass(smallest_mass);
  return result;
}

std::optional<Newton::End>
Newton::end_of(const NewtonIteration &iteration, const std::vector<double> &residuals,
               const Progress &progress, const Vector &u, const Vector &r) const
{
  const double residual = iteration.residual;
  if (std::isfinite(residual) && residual <= iteration.tolerance)
    return End{NewtonStatus::converged, "converged in %u iterations, |r| = %.3e <= %.3e"};
  if (!std::isfinite(residual)
      || residual > divergence_factor * std::max(residuals.front(), iteration.reference))
    return End{NewtonStatus::diverged, "diverged in iteration %u, |r| = %.3e (tolerance %.3e)"};
  if (is_plateau(residuals) && is_round_off(iteration, u.l2_norm()))
    return End{NewtonStatus::converged_at_round_off,
               "ended at round-off in %u iterations, |r| = %.3e (tolerance %.3e)"};
  if (is_plateau(residuals) && hooks.is_geometric && hooks.is_geometric(r, iteration.tolerance))
    return End{
      NewtonStatus::converged_at_round_off,
      "ended at the accuracy of the geometry in %u iterations, |r| = %.3e (tolerance %.3e)"};
  if (progress.is_transient
      && (residuals.size() > transient_iterations
          || residual <= transient_reduction * residuals.front()))
    return End{NewtonStatus::stalled, "frozen friction: iteration %u, |r| = %.3e (tolerance %.3e)"};
  if (hooks.set_mass && !progress.is_transient
      && (is_stalled(residuals) || progress.n_short_steps >= max_short_steps))
    return End{NewtonStatus::stalled, "stalled in iteration %u, |r| = %.3e (tolerance %.3e)"};
  if (iteration.number >= parameters.max_iterations)
    return End{NewtonStatus::max_iterations,
               "not converged in %u iterations, |r| = %.3e (tolerance %.3e)"};
  return {};
}

NewtonResult
Newton::iterate(Vector &u, Progress &progress) const
{
  NewtonResult    result;
  NewtonIteration iteration;
  iteration.number = progress.iterations;
  Vector r(u), du(u);
  double linear_tolerance = parameters.loosest_linear_tolerance;
  progress.begin();
  hooks.residual(u, r);
  balance(u, r);
  iteration.residual = r.l2_norm();

  for (;; ++iteration.number)
    {
      iteration.reference = hooks.reference();
      iteration.tolerance
        = parameters.relative_tolerance * iteration.reference + parameters.absolute_tolerance;
      result.residuals.push_back(iteration.residual);
      result.iterations = iteration.number;
      if (hooks.observe)
        hooks.observe(iteration);

      if (const auto end = end_of(iteration, result.residuals, progress, u, r))
        {
          result.status = end->status;
          result.message
            = in_words(end->format, iteration.number, iteration.residual, iteration.tolerance);
          return result;
        }

      linear_tolerance = forcing_term(result.residuals, linear_tolerance, iteration.tolerance,
                                      parameters.loosest_linear_tolerance);
      try
        {
          if (progress.is_later)
            hooks.set_mass(progress.mass);
          if (hooks.set_secant_part)
            hooks.set_secant_part(progress.secant_part);
          hooks.solve(u, r, linear_tolerance, du);
        }
      catch (const LinearSolverFailure &failure)
        {
          ++result.iterations;
          result.status  = NewtonStatus::linear_solver_failure;
          result.message = failure.what();
          return result;
        }

      const Step step = progress.is_transient
                          ? search_energy(u, du, r, progress)
                          : search(u, du, r, iteration.residual, progress.line_search);
      if (progress.is_later && !progress.is_transient)
        progress.adapt(step.alpha);
      u                  = step.u;
      r                  = step.r;
      iteration.residual = balance(u, r) ? r.l2_norm() : step.norm;
      progress.end_step(step.alpha, iteration.residual / result.residuals.back(),
                        hooks.goes_far && hooks.goes_far(du));
      iteration.step_length       = step.alpha;
      iteration.increment         = step.alpha * du.l2_norm();
      iteration.extra_evaluations = step.evaluations - 1;
    }
}
} // namespace scree
