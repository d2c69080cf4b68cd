#include <scree/base/exceptions.h>
#include <scree/base/log.h>
#include <scree/mechanics/existence.h>

#include <cmath>
#include <limits>

namespace scree
{
namespace
{
/** What of the loads of a time no contact can balance. */
template <int dim>
struct Unbalanced
{
  double                                part;   //!< of the loads
  typename FreeBodies<dim>::Coordinates motion; //!< that they drive
};

template <int dim>
Unbalanced<dim>
unbalanced(const DiscreteProblem<dim> &problem, const State<dim> &state, const double time)
{
  auto u = state.displacement;
  auto r = u;
  problem.equilibrium().set_time(time, u);
  problem.equilibrium().residual(u, state.contact, r);
  Unbalanced<dim> result{0., problem.equilibrium().unbalanced_loads()};
  for (const double part : result.motion)
    result.part += part * part;
  result.part = std::sqrt(result.part);
  return result;
}

/** @param held_until NaN: not even the loads of the start of the step are balanced */
template <int dim>
[[noreturn]] void
throw_slides_away(const DiscreteProblem<dim>                  &problem,
                  const typename FreeBodies<dim>::Coordinates &motion, const double time,
                  const double held_until)
{
  const auto &bodies  = problem.bodies;
  const auto &motions = problem.equilibrium().free_motions();
  const auto  moves   = motions.in_words(motion);
  std::string what, alone;
  bool        has_friction = false, turns = false;
  for (const auto &body : moves)
    {
      what += (what.empty() ? "" : ", ") + ("the body '" + bodies[body.body].name + "' ")
              + body.in_words();
      turns |= body.turns;
      if (!motions.has_neighbours(body.body))
        alone += (alone.empty() ? "" : ", ") + bodies[body.body].name;
    }
  for (const ContactPair &pair : problem.contact().pairs())
    for (const auto &body : moves)
      has_friction |= (pair.a == body.body || pair.b == body.body) && pair.law.kind->slides;
  std::string remedy = turns ? "hold it against turning, lower its loads or let them act nearer to "
                               "what holds it"
                             : "support it or lower its loads";
  if (has_friction)
    remedy += ", or raise the friction coefficient";
  if (!alone.empty())
    remedy = "no other body is within reach of " + alone
             + ": support it, place it nearer to what shall hold it, or raise Contact/Shift";
  throw UserError(
    bodies[moves.front().body].path,
    "no equilibrium exists at time " + short_number(time)
      + (turns ? ": the body tips over, turns or slides away" : ": the body slides away")
      + ", for no contact pressure and no friction within its "
        "limit balances the loads; driven by them "
      + what
      + (std::isnan(held_until)
           ? ""
           : "; they could be balanced up to time " + short_number(held_until)),
    remedy);
}
} // namespace

template <int dim>
void
require_equilibrium_exists(const DiscreteProblem<dim> &problem, const State<dim> &state,
                           const double time)
{
  // Less than what cut quadrature leaves in the resultants of loads, nothing is said about it.
  constexpr double       smallest_part = 1e-3;
  constexpr unsigned int n_bisections  = 12;
  if (problem.equilibrium().free_bodies().empty())
    return;
  const Unbalanced<dim> lost_at_end = unbalanced(problem, state, time);
  if (lost_at_end.part < smallest_part)
    return;
  const auto is_held
    = [&](const double t) { return unbalanced(problem, state, t).part < smallest_part; };
  double     held = state.time, lost = time;
  const bool was_held = is_held(held);
  for (unsigned int i = 0; i < n_bisections && was_held; ++i)
    {
      const double middle             = 0.5 * (held + lost);
      (is_held(middle) ? held : lost) = middle;
    }
  throw_slides_away(problem, lost_at_end.motion, time,
                    was_held ? held : std::numeric_limits<double>::quiet_NaN());
}

template void require_equilibrium_exists(const DiscreteProblem<2> &, const State<2> &,
                                         const double);
template void require_equilibrium_exists(const DiscreteProblem<3> &, const State<3> &,
                                         const double);
} // namespace scree
