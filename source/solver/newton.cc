#include <scree/solver/linear_solver.h>
#include <scree/solver/newton.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace scree
{
namespace
{
// The constants that newton.h documents.
constexpr double       divergence_factor   = 1e8;
constexpr double       round_off_factor    = 100;
constexpr double       round_off_increment = 1e-10;
constexpr unsigned int many_standing       = 8;
constexpr unsigned int few_standing        = 3;
constexpr double       forcing_factor      = 0.9;
constexpr double       forcing_safeguard   = 0.1;
constexpr double       final_linear_factor = 0.1;
constexpr double       short_step          = 0.5;
constexpr double       full_step           = 0.99;
constexpr double       good_lagged_step    = 0.5;
constexpr double       poor_step           = 4;
constexpr unsigned int max_without_gain    = 5;
constexpr double       first_mass          = 1e-4;
constexpr double       smallest_mass       = 1e-9;
constexpr double       largest_mass        = 0.1;
constexpr double       mass_decay          = 0.1;
constexpr double       mass_growth         = 4;
constexpr unsigned int max_balances        = 6;
constexpr unsigned int max_rising_balances = 3;
constexpr double       balance_reduction   = 0.1;

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

/** Whether the residual stands at the least that it has reached, for `n_iterations`. */
bool
is_standstill(const std::vector<double> &residuals, const std::ptrdiff_t n_iterations)
{
  if (static_cast<std::ptrdiff_t>(residuals.size()) <= n_iterations)
    return false;
  const auto   last   = residuals.end() - n_iterations;
  const double before = *std::min_element(residuals.begin(), last);
  return *std::min_element(last, residuals.end()) > 0.5 * before && residuals.back() < 2. * before;
}

/** Whether the residual ceased to fall at the level of round-off, see the class documentation. */
bool
is_round_off(const NewtonIteration &iteration, const double norm_of_u)
{
  return iteration.residual <= round_off_factor * iteration.tolerance
         && iteration.increment <= iteration.step_length * round_off_increment * norm_of_u;
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
                "A load step that needs more is cut.");
  section.entry(
    "Loosest linear tolerance", loosest_linear_tolerance, dealii::Patterns::Double(0., 0.1),
    "Iterative linear solvers are asked for this at first and for more as the iteration "
    "converges (Eisenstat and Walker); 0: always for Linear/Tolerance [-].");
  section.entry("Line search", line_search, line_search_names,
                "work: shortens a step that overshoots, judged by the work of the residual on the "
                "increment. residual: halves a step until the residual falls. none: full steps.");
}

/** What the next step is. */
struct Newton::Progress
{
  bool         is_lagged      = false;      //!< friction in the next step
  double       mass           = first_mass; //!< s of a lagged step
  unsigned int n_full         = 0;          //!< lagged steps of alpha = 1 in a row
  unsigned int n_wanted       = 1;          //!< of these before a step with the tangent
  unsigned int n_rising       = 0;          //!< balances that raised the residual
  unsigned int n_tangent      = 0;          //!< steps with the tangent that follow in any case
  unsigned int n_without_gain = 0; //!< steps in a row that did not halve the least residual
  double       least          = std::numeric_limits<double>::infinity(); //!< that was halved last
  /** The largest residual with which a balance is tried. */
  double balance_below = std::numeric_limits<double>::infinity();

  /**
   * @param residual after the step
   * @param ratio    of the residuals after and before the step
   * @param rises    whether it is above 1 where something moves freely
   */
  void end_step(const double alpha, const double residual, const double ratio, const bool rises)
  {
    const bool is_standing = stands_at(residual);
    n_tangent -= n_tangent > 0;
    if (!is_lagged)
      {
        is_lagged = n_tangent == 0 && (alpha < short_step || rises);
        n_full    = 0;
        return;
      }
    if (is_standing)
      {
        is_lagged = false;
        n_tangent = max_without_gain;
        return;
      }
    n_full    = alpha > full_step ? n_full + 1 : 0;
    is_lagged = n_full == 0 || (n_full < n_wanted && ratio > good_lagged_step);
    if (!is_lagged && ratio > good_lagged_step)
      n_wanted *= 2;
    if (alpha > 0.5)
      mass = std::max(smallest_mass, mass_decay * mass);
    else if (alpha < 0.2)
      mass = std::min(largest_mass, mass_growth * mass);
  }

  /** Whether so many steps in a row did not halve the least residual; then they count anew. */
  bool stands_at(const double residual)
  {
    ++n_without_gain;
    if (residual < good_lagged_step * least)
      {
        least          = residual;
        n_without_gain = 0;
      }
    if (n_without_gain < max_without_gain)
      return false;
    n_without_gain = 0;
    return true;
  }
};

/** The end of an iteration. */
struct Newton::End
{
  NewtonStatus status;
  const char  *format; //!< of the message: iteration, residual, tolerance
};

/** The iterate of the least residual near the tolerance. */
struct Newton::Best
{
  Vector       u;
  double       residual = std::numeric_limits<double>::infinity();
  unsigned int number   = 0; //!< of the iteration
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
Newton::balance_after(Step &step, const double norm_before, Progress &progress) const
{
  if (step.norm > progress.balance_below)
    return;
  Step balanced = step;
  if (!balance(balanced.u, balanced.r))
    return;
  balanced.norm        = balanced.r.l2_norm();
  const bool is_rising = hooks.lag && balanced.norm > step.norm;
  if (!is_rising || (progress.n_rising++ < max_rising_balances && balanced.norm <= norm_before))
    {
      step = std::move(balanced);
      return;
    }
  progress.balance_below = balance_reduction * step.norm;
  hooks.residual(step.u, step.r);
}

bool
Newton::can_lag() const
{
  return hooks.lag && parameters.line_search != LineSearch::none;
}

void
Newton::begin_parts() const
{
  if (hooks.parts)
    hooks.parts(true);
}

Newton::Step
Newton::lagged_step(const double mass, const double linear_tolerance, const Vector &u, Vector &r,
                    Vector &du) const
{
  hooks.lag(mass);
  hooks.residual(u, r); // the same r, another tangent
  begin_parts();
  try
    {
      hooks.solve(u, r, linear_tolerance, du);
    }
  catch (const LinearSolverFailure &)
    {
      hooks.lag({});
      throw;
    }
  Step step = search_energy(u, du, r);
  hooks.lag({});
  hooks.residual(step.u, step.r);
  step.norm = step.r.l2_norm();
  return step;
}

Newton::Step
Newton::take_step(const double linear_tolerance, const double norm, const Vector &u, Vector &r,
                  Vector &du, Progress &progress) const
{
  const auto is_poor = [&](const Step &step) {
    return can_lag() && step.norm > poor_step * norm && hooks.mass(du) * du > 0.;
  };
  Step step;
  if (!progress.is_lagged)
    {
      begin_parts();
      hooks.solve(u, r, linear_tolerance, du);
      step = search(u, du, r, norm);
      if (progress.n_tangent > 0 || !is_poor(step))
        return step;
      progress.is_lagged = true;
    }
  step = lagged_step(progress.mass, linear_tolerance, u, r, du);
  while (is_poor(step) && progress.mass < largest_mass)
    {
      progress.mass = std::min(largest_mass, 10. * std::max(first_mass, progress.mass));
      step          = lagged_step(progress.mass, linear_tolerance, u, r, du);
    }
  return step;
}

bool
Newton::is_best_in_balance(const bool is_last, NewtonIteration &iteration, Vector &u, Vector &r,
                           Best &best) const
{
  if (!hooks.is_in_balance)
    return false;
  const bool is_near = iteration.residual <= round_off_factor * iteration.tolerance;
  if (is_near && iteration.residual < best.residual)
    best = {u, iteration.residual, iteration.number};
  else if (std::isfinite(best.residual)
           && (is_last || iteration.number == best.number + few_standing))
    {
      hooks.residual(best.u, r);
      if (hooks.is_in_balance(best.u, best.residual))
        {
          u                  = best.u;
          iteration.residual = best.residual;
          return true;
        }
      hooks.residual(u, r);
    }
  return false;
}

std::optional<Newton::End>
Newton::end_of(const std::vector<double> &residuals, NewtonIteration &iteration, Vector &u,
               Vector &r, Best &best) const
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
  const bool is_near = residual <= round_off_factor * iteration.tolerance;
  if (hooks.is_in_balance && is_standstill(residuals, is_near ? few_standing : many_standing)
      && hooks.is_in_balance(u, residual))
    return End{NewtonStatus::converged_at_standstill,
               "stands still in balance after %u iterations, |r| = %.3e (tolerance %.3e)"};
  if (hooks.is_interrupted && hooks.is_interrupted())
    return End{NewtonStatus::interrupted,
               "interrupted after %u iterations, |r| = %.3e (tolerance %.3e)"};
  const std::size_t n         = residuals.size();
  const bool        goes_well = (n > 1 && residuals[n - 1] <= 0.1 * residuals[n - 2])
                         || (n > 2 && residuals[n - 1] <= 0.01 * residuals[n - 3]);
  const bool is_last = iteration.number >= parameters.max_iterations
                       || (iteration.number >= parameters.patience && !goes_well);
  if (is_best_in_balance(is_last, iteration, u, r, best))
    return End{NewtonStatus::converged_at_standstill,
               "fell no further, in balance, in %u iterations, |r| = %.3e (tolerance %.3e)"};
  if (is_last)
    return End{NewtonStatus::max_iterations,
               "not converged in %u iterations, |r| = %.3e (tolerance %.3e)"};
  return {};
}

NewtonResult
Newton::solve(Vector &u) const
{
  NewtonResult    result;
  Best            best;
  NewtonIteration iteration;
  Progress        progress;
  Vector          r(u), du(u);
  double          linear_tolerance = parameters.loosest_linear_tolerance;
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

      if (const auto end = end_of(result.residuals, iteration, u, r, best))
        {
          result.residuals.back() = iteration.residual;
          result.status           = end->status;
          result.message
            = in_words(end->format, iteration.number, iteration.residual, iteration.tolerance);
          return result;
        }

      linear_tolerance = forcing_term(result.residuals, linear_tolerance, iteration.tolerance,
                                      parameters.loosest_linear_tolerance);
      Step step;
      try
        {
          step = take_step(linear_tolerance, iteration.residual, u, r, du, progress);
        }
      catch (const LinearSolverFailure &failure)
        {
          ++result.iterations;
          result.status  = NewtonStatus::linear_solver_failure;
          result.message = failure.what();
          return result;
        }
      if (can_lag())
        {
          const double ratio = step.norm / iteration.residual;
          progress.end_step(step.alpha, step.norm, ratio, ratio > 1. && hooks.mass(du) * du > 0.);
        }
      balance_after(step, iteration.residual, progress);
      u                           = step.u;
      r                           = step.r;
      iteration.residual          = step.norm;
      iteration.step_length       = step.alpha;
      iteration.increment         = step.alpha * du.l2_norm();
      iteration.extra_evaluations = step.evaluations - 1;
    }
}
} // namespace scree
