#include <scree/solver/line_search.h>
#include <scree/solver/newton.h>

#include <cmath>
#include <numeric>
#include <optional>

// The line searches of Newton's method.
namespace scree
{
/** When a step goes too far, and how it is shortened. */
struct Newton::Search
{
  double       overshoot;  //!< of G(0), by which G has another sign in the end
  double       reduction;  //!< of G(0), to which |G| is brought
  unsigned int max_trials; //!< of that
  double       shortening; //!< of a step to a residual that is not finite
};

namespace
{
// The constants that newton.h documents.
constexpr double       armijo         = 1e-4;
constexpr unsigned int max_halvings   = 8;
constexpr double       good_reduction = 0.3;
} // namespace

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
Newton::whole_step(const Vector &u, const Vector &du, const double shortening) const
{
  Step step;
  step.r.reinit(u, true);
  evaluate(step, 1., u, du);
  for (unsigned int k = 0; k < max_halvings && !std::isfinite(step.norm); ++k)
    evaluate(step, step.alpha * shortening, u, du);
  return step;
}

Newton::Step
Newton::search_zeros(const Search &search, const Vector &u, const Vector &du, const Vector &r,
                     const Vector *mass_du) const
{
  Step step = whole_step(u, du, search.shortening);
  if (!std::isfinite(step.norm))
    return step;
  const Partition           parts = hooks.parts ? hooks.parts(false) : Partition();
  const std::vector<double> start = parts.products(r, du), weights = parts.products(r, r);
  std::vector<double>       mass(parts.n_parts), alphas(parts.n_parts, step.alpha);
  if (mass_du != nullptr)
    mass = parts.products(*mass_du, du);
  // Falls from |G(0)|.
  const auto G = [&]() {
    std::vector<double> result = parts.products(step.r, du);
    for (unsigned int p = 0; p < parts.n_parts; ++p)
      result[p] = std::copysign(1., start[p]) * (result[p] - alphas[p] * mass[p]);
    return result;
  };
  std::vector<double>                    after = G();
  std::vector<std::optional<ZeroSearch>> searches(parts.n_parts);
  for (unsigned int p = 0; p < parts.n_parts; ++p)
    if (after[p] < -search.overshoot * std::abs(start[p]) && (start[p] > 0. || mass_du == nullptr))
      searches[p].emplace(std::abs(start[p]), step.alpha, after[p]);
  for (unsigned int k = 0; k < search.max_trials; ++k)
    {
      std::vector<unsigned int> sought;
      for (unsigned int p = 0; p < parts.n_parts; ++p)
        if (searches[p] && searches[p]->last() > search.reduction * std::abs(start[p]))
          {
            sought.push_back(p);
            alphas[p] = searches[p]->next();
          }
      if (sought.empty())
        break;
      Vector shortened(du);
      parts.scale(alphas, shortened);
      evaluate(step, 1., u, shortened);
      after = G();
      for (const unsigned int p : sought)
        searches[p]->take(after[p]);
    }
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.);
  step.alpha       = sum > 0.
                       ? std::inner_product(weights.begin(), weights.end(), alphas.begin(), 0.) / sum
                       : alphas[0];
  return step;
}

Newton::Step
Newton::search(const Vector &u, const Vector &du, const Vector &r, const double norm) const
{
  constexpr Search work_search{0.8, 0.8, 6, 0.5};
  if (parameters.line_search == LineSearch::work)
    return search_zeros(work_search, u, du, r, nullptr);
  Step step = whole_step(u, du, work_search.shortening);
  if (!std::isfinite(step.norm) || parameters.line_search == LineSearch::none)
    return step;
  return search_residual(std::move(step), u, du, norm);
}

Newton::Step
Newton::search_energy(const Vector &u, const Vector &du, const Vector &r) const
{
  constexpr Search energy_search{0.5, 0.1, 16, 0.25};
  const Vector     mass_du = hooks.mass(du);
  return search_zeros(energy_search, u, du, r, &mass_du);
}
} // namespace scree
