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

/** Whether the residual ceased to fall at the level of round-off, see the class documentation. */
bool
is_round_off_plateau(const std::vector<double> &residuals, const NewtonIteration &iteration,
                     const double norm_of_u)
{
  const std::size_t n = residuals.size();
  return n >= 3 && residuals[n - 1] <= round_off_factor * iteration.tolerance
         && residuals[n - 1] > 0.5 * residuals[n - 2] && residuals[n - 2] > 0.5 * residuals[n - 3]
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

/** A trial of the line search: the alpha, and the u and r there. */
struct Newton::Step
{
  double       alpha       = 1;
  unsigned int evaluations = 0;
  double       norm        = 0;
  Vector       u;
  Vector       r;
};

Newton::Newton(const NewtonParameters &parameters, const Hooks &hooks)
    : parameters(parameters)
    , hooks(hooks)
{
}

void
Newton::evaluate(Step &step, const double alpha, const Vector &u, const Vector &du) const
{
  step.alpha = alpha;
  step.u     = u;
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
Newton::search(const Vector &u, const Vector &du, const Vector &r, const double norm) const
{
  Step step;
  step.r.reinit(r, true);
  evaluate(step, 1., u, du);
  for (unsigned int k = 0; k < max_halvings && !std::isfinite(step.norm); ++k)
    evaluate(step, step.alpha / 2, u, du);
  if (!std::isfinite(step.norm) || parameters.line_search == LineSearch::none)
    return step;
  if (parameters.line_search == LineSearch::residual)
    return search_residual(std::move(step), u, du, norm);
  return search_work(std::move(step), u, du, r * du);
}

NewtonResult
Newton::solve(Vector &u) const
{
  NewtonResult    result;
  NewtonIteration iteration;
  Vector          r(u), du(u);
  double          linear_tolerance = parameters.loosest_linear_tolerance;
  hooks.residual(u, r);
  iteration.residual = r.l2_norm();

  const auto ended_as = [&](const NewtonStatus status, const std::string &message) {
    result.status  = status;
    result.message = message;
    return result;
  };

  for (;; ++iteration.number)
    {
      const double reference = hooks.reference();
      iteration.tolerance
        = parameters.relative_tolerance * reference + parameters.absolute_tolerance;
      result.residuals.push_back(iteration.residual);
      result.iterations = iteration.number;
      if (hooks.observe)
        hooks.observe(iteration);

      const auto told = [&](const char *format) {
        return in_words(format, iteration.number, iteration.residual, iteration.tolerance);
      };
      if (std::isfinite(iteration.residual) && iteration.residual <= iteration.tolerance)
        return ended_as(NewtonStatus::converged,
                        told("converged in %u iterations, |r| = %.3e <= %.3e"));
      if (!std::isfinite(iteration.residual)
          || iteration.residual > divergence_factor * std::max(result.residuals.front(), reference))
        return ended_as(NewtonStatus::diverged,
                        told("diverged in iteration %u, |r| = %.3e (tolerance %.3e)"));
      if (is_round_off_plateau(result.residuals, iteration, u.l2_norm()))
        return ended_as(NewtonStatus::converged_at_round_off,
                        told("ended at round-off in %u iterations, |r| = %.3e (tolerance %.3e)"));
      if (iteration.number >= parameters.max_iterations)
        return ended_as(NewtonStatus::max_iterations,
                        told("not converged in %u iterations, |r| = %.3e (tolerance %.3e)"));

      linear_tolerance = forcing_term(result.residuals, linear_tolerance, iteration.tolerance,
                                      parameters.loosest_linear_tolerance);
      try
        {
          hooks.solve(u, r, linear_tolerance, du);
        }
      catch (const LinearSolverFailure &failure)
        {
          ++result.iterations;
          return ended_as(NewtonStatus::linear_solver_failure, failure.what());
        }

      const Step step             = search(u, du, r, iteration.residual);
      u                           = step.u;
      r                           = step.r;
      iteration.residual          = step.norm;
      iteration.step_length       = step.alpha;
      iteration.increment         = step.alpha * du.l2_norm();
      iteration.extra_evaluations = step.evaluations - 1;
    }
}
} // namespace scree
