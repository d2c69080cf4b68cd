#include <scree/base/exceptions.h>
#include <scree/mechanics/balance_checks.h>
#include <scree/mechanics/existence.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace scree
{
namespace
{
/** Of the forces on a body: the imbalance that ends a run. */
constexpr double largest_imbalance = 1e-3;
/** Of all forces: what rounding may leave on a body that carries hardly any. */
constexpr double round_off = 1e-6;
/** Of the forces on a body times half its size: the held moment that is told. */
constexpr double told_imbalance = 1e-2;
/** Of a stiffness times a motion: what is no force but rounding. */
constexpr double no_force = 1e-11;
/** Times the rounding in the stiffness of the softest body: forces that are none. */
constexpr double no_forces = 100.;
/** Of the result: the error of linear kinematics that is told. */
constexpr double largest_rotation_error = 0.01;
/** Of a body that only contact holds: the angle that ends the run on a fixed geometry. */
constexpr double largest_rotation = 0.8;

/** Where the imbalance comes from, and what helps. */
struct Explanation
{
  std::string cause, remedy;
};

/** Young's moduli of the softest and the stiffest body. */
template <int dim>
std::pair<double, double>
least_and_most_stiff(const std::vector<Body<dim>> &bodies)
{
  double least = std::numeric_limits<double>::max(), most = 0.;
  for (const auto &body : bodies)
    if (!body.is_rigid())
      {
        least = std::min(least, body.material->young());
        most  = std::max(most, body.material->young());
      }
  return {least, most};
}

template <int dim>
Explanation
explain_imbalance(const DiscreteProblem<dim> &problem, const NewtonParameters &newton)
{
  const Equilibrium<dim> &equilibrium = problem.equilibrium();
  const double            tolerance   = newton.relative_tolerance * equilibrium.force_scale();
  if (equilibrium.round_off() <= tolerance + newton.absolute_tolerance)
    return {"; the tolerances of the iteration are Relative tolerance = "
              + short_number(newton.relative_tolerance)
              + ", Absolute tolerance = " + short_number(newton.absolute_tolerance)
              + " of forces of " + short_number(equilibrium.force_scale()),
            "tighten them in section Solver/Newton"};
  const auto [softest, stiffest] = least_and_most_stiff(problem.bodies);
  double poisson                 = -1.;
  for (const auto &body : problem.bodies)
    if (!body.is_rigid())
      poisson = std::max(poisson, body.material->poisson());
  return {"; round-off in the stiffness of the bodies is that large (Young's moduli from "
            + short_number(softest) + " to " + short_number(stiffest)
            + ", Poisson's ratios up to 0.5 - " + short_number(0.5 - poisson) + ")",
          "make bodies that hardly deform rigid (Law = rigid), keep Poisson's ratio below 0.49999"};
}

template <int dim>
[[noreturn]] void
throw_out_of_balance(const DiscreteProblem<dim> &problem, const BodyBalance<dim> &balance,
                     const bool is_force, const NewtonParameters &newton, const double time)
{
  const Body<dim>  &body = problem.bodies[balance.body];
  const std::string what
    = "the step to time " + short_number(time) + " converged, but the body '" + body.name
      + "' is not in balance: "
      + (is_force
           ? "its contact forces, loads and reactions of " + short_number(balance.force_scale)
               + " in all add up to " + short_number(balance.force.norm())
           : "the moments of its contact forces, loads and reactions ("
               + short_number(balance.force_scale) + " in all, at distances of about "
               + short_number(balance.radius) + ") add up to "
               + short_number(balance.moment.norm()));
  const auto [cause, remedy] = explain_imbalance(problem, newton);
  throw UserError(body.path, what + cause, remedy);
}

/** What may be left of the forces and moments on a body. */
template <int dim>
class BalanceLimits
{
public:
  BalanceLimits(const DiscreteProblem<dim> &problem, const std::vector<BodyBalance<dim>> &balances,
                const NewtonParameters &newton)
      : problem(problem)
  {
    // Of bodies without any forces: what moving the softest of them leaves by rounding.
    double motion  = 2e-3 * problem.kinematics->position_scale();
    double softest = std::numeric_limits<double>::max();
    for (const BodyBalance<dim> &balance : balances)
      {
        motion  = std::max(motion, balance.largest_u);
        softest = std::min(softest, problem.bodies[balance.body].material->young()
                                      * std::pow(balance.radius, dim - 2));
      }
    of_motion                           = no_force * softest * motion;
    const Equilibrium<dim> &equilibrium = problem.equilibrium();
    const double            scale       = equilibrium.force_scale();
    const auto [least, most]            = least_and_most_stiff(problem.bodies);
    of_node                             = std::max(newton.relative_tolerance * scale,
                                                   std::min(equilibrium.round_off(), round_off * scale));
    if (scale <= no_forces * equilibrium.round_off() * least / most)
      of_node = std::max(of_node, equilibrium.round_off());
  }

  bool allow_force(const BodyBalance<dim> &balance) const
  {
    return balance.force.norm() <= force(balance);
  }

  bool allow_moment(const BodyBalance<dim> &balance) const
  {
    const double held = problem.equilibrium().held_moment(balance.body);
    return !problem.kinematics->balances_moments(problem.bodies[balance.body])
           || balance.moment.norm()
                <= 2. * balance.radius * (force(balance) + 2. * held)
                     + 2. * problem.kinematics->arm_error(balance.largest_u) * balance.force_scale;
  }

private:
  double force(const BodyBalance<dim> &balance) const
  {
    // Residuals of the nodes may all point the same way.
    return largest_imbalance * balance.force_scale + std::sqrt(balance.n_nodes) * of_node
           + of_motion;
  }

  const DiscreteProblem<dim> &problem;
  double                      of_motion, of_node;
};

/** Angles of the rigid bodies, and the sums of their contact pressures times arms (collective). */
template <int dim>
void
find_rigid_rotations(const DiscreteProblem<dim>              &problem,
                     const typename Equilibrium<dim>::Vector &u, std::vector<double> &angle,
                     std::vector<double> &moment)
{
  const auto  ghosted = problem.equilibrium().with_ghosts(u);
  const auto &bodies  = problem.bodies;
  const auto &contact = problem.contact();
  for (unsigned int b = 0; b < bodies.size(); ++b)
    if (bodies[b].is_rigid())
      angle[b] = RigidPose<dim>(*bodies[b].rigid, rigid_unknowns(problem.space, b, ghosted))
                   .rotation()
                   .norm();
  for (unsigned int i = 0; i < contact.points().size(); ++i)
    {
      const ContactPoint<dim> &point = contact.points()[i];
      const ContactPair       &pair  = contact.pairs()[point.pair];
      const double             f     = point.weight * std::abs(contact.responses()[i].pressure);
      for (const unsigned int b : {pair.a, pair.b})
        if (bodies[b].is_rigid())
          moment[b] += f * point.position.distance(bodies[b].rigid->reference_point);
    }
  dealii::Utilities::MPI::sum(moment, problem.communicator(), moment);
}
} // namespace

double
balanced_residual(const double force_scale, const double relative_tolerance,
                  const double stiffness_round_off, const double softest_to_stiffest)
{
  const bool   are_forces = force_scale > no_forces * softest_to_stiffest * stiffness_round_off;
  const double rounding
    = are_forces ? std::min(stiffness_round_off, round_off * force_scale) : stiffness_round_off;
  return std::max(relative_tolerance * force_scale, rounding);
}

template <int dim>
std::vector<BodyBalance<dim>>
require_balance(const DiscreteProblem<dim> &problem, const typename Equilibrium<dim>::Vector &u,
                const NewtonParameters &newton, const double time, RunLog &run_log)
{
  const auto               balances = problem.equilibrium().balance(u);
  const BalanceLimits<dim> limits(problem, balances, newton);
  for (const BodyBalance<dim> &balance : balances)
    {
      const double held = problem.equilibrium().held_moment(balance.body);
      if (held > told_imbalance * balance.force_scale
          && run_log.warnings.is_new(Warning::badly_held, balance.body))
        run_log.log.line("Warning: contact at few points holds the body "
                         + problem.bodies[balance.body].name + " against turning only to "
                         + short_number(100. * held / balance.force_scale)
                         + " % of what acts on it times half its size; refine the grid there");
      if (!limits.allow_force(balance) || !limits.allow_moment(balance))
        throw_out_of_balance(problem, balance, !limits.allow_force(balance), newton, time);
    }
  return balances;
}

template <int dim>
bool
is_in_balance(const DiscreteProblem<dim> &problem, const typename Equilibrium<dim>::Vector &u,
              const double residual, const NewtonParameters &newton)
{
  constexpr double  n_rounded   = 100.; // bodies that nothing presses
  Equilibrium<dim> &equilibrium = problem.equilibrium();
  if (!(residual
        <= std::max(round_off * equilibrium.force_scale(), n_rounded * equilibrium.round_off())))
    return false;
  const auto               balances = equilibrium.balance(u);
  const BalanceLimits<dim> limits(problem, balances, newton);
  return std::all_of(balances.begin(), balances.end(), [&](const BodyBalance<dim> &balance) {
    return limits.allow_force(balance) && limits.allow_moment(balance);
  });
}

template <int dim>
void
require_small_rotations(const DiscreteProblem<dim>          &problem,
                        const std::vector<BodyBalance<dim>> &balances, const State<dim> &state,
                        const double time)
{
  std::vector<bool> is_free(problem.bodies.size(), false);
  for (const FreeMotion &motion : problem.equilibrium().free_bodies())
    is_free[motion.body] = true;
  for (const BodyBalance<dim> &balance : balances)
    if (is_free[balance.body] && balance.rotation > largest_rotation)
      {
        require_equilibrium_exists(problem, state, time);
        const Body<dim> &body = problem.bodies[balance.body];
        throw UserError(
          body.path,
          "the body '" + body.name + "' has turned by "
            + short_number(balance.rotation * 180. / M_PI) + " degrees at time "
            + short_number(time) + ", but on a fixed geometry rotations are taken as small",
          "set Moving geometry/Update = every step, or hold the body against turning");
      }
}

template <int dim>
void
warn_of_rotations(const DiscreteProblem<dim>              &problem,
                  const std::vector<BodyBalance<dim>>     &balances,
                  const typename Equilibrium<dim>::Vector &u, const double time, RunLog &run_log)
{
  const auto         &bodies = problem.bodies;
  std::vector<double> moment(bodies.size()), angle(bodies.size());
  find_rigid_rotations(problem, u, angle, moment);
  for (const BodyBalance<dim> &balance : balances)
    {
      angle[balance.body]  = balance.rotation;
      moment[balance.body] = 0.5 * balance.force_scale * balance.radius;
    }
  double       stiffness = 0.;
  const auto   volumes   = problem.bulk.volumes();
  const double work      = 2. * problem.equilibrium().energies().stored();
  for (unsigned int b = 0; b < bodies.size(); ++b)
    if (!bodies[b].is_rigid())
      stiffness += bodies[b].material->young() * volumes[b];
  for (unsigned int b = 0; b < bodies.size(); ++b)
    {
      const double second_order = 0.5 * angle[b] * angle[b] * moment[b];
      const bool   is_strained  = work > 1e-20 * angle[b] * angle[b] * stiffness;
      if (is_strained && second_order > largest_rotation_error * work
          && run_log.warnings.is_new(Warning::turned, b))
        run_log.log.line("Warning: the body " + bodies[b].name + " has turned by "
                         + short_number(angle[b] * 180. / M_PI) + " degrees at time "
                         + short_number(time)
                         + ". On a fixed geometry, where rotations are taken as small, this makes "
                           "forces wrong by more than 1 %: set Moving geometry/Update = every "
                           "step");
    }
}

template <int dim>
void
warn_of_large_strains(const DiscreteProblem<dim>          &problem,
                      const std::vector<BodyBalance<dim>> &balances, const double time,
                      RunLog &run_log)
{
  constexpr double largest_strain = 0.05;
  for (const BodyBalance<dim> &balance : balances)
    if (balance.strain > largest_strain && run_log.warnings.is_new(Warning::strained, balance.body))
      run_log.log.line("Warning: the body " + problem.bodies[balance.body].name
                       + " has a mean strain of " + short_number(100. * balance.strain)
                       + " % at time " + short_number(time)
                       + ". On a fixed geometry strains are taken as small: set Moving "
                         "geometry/Update = every step");
}

#define SCREE_INSTANTIATE(dim)                                                                     \
  template std::vector<BodyBalance<dim>> require_balance(                                          \
    const DiscreteProblem<dim> &, const Equilibrium<dim>::Vector &, const NewtonParameters &,      \
    const double, RunLog &);                                                                       \
  template bool is_in_balance(const DiscreteProblem<dim> &, const Equilibrium<dim>::Vector &,      \
                              const double, const NewtonParameters &);                             \
  template void require_small_rotations(const DiscreteProblem<dim> &,                              \
                                        const std::vector<BodyBalance<dim>> &, const State<dim> &, \
                                        const double);                                             \
  template void warn_of_rotations(const DiscreteProblem<dim> &,                                    \
                                  const std::vector<BodyBalance<dim>> &,                           \
                                  const Equilibrium<dim>::Vector &, const double, RunLog &);       \
  template void warn_of_large_strains(                                                             \
    const DiscreteProblem<dim> &, const std::vector<BodyBalance<dim>> &, const double, RunLog &);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
