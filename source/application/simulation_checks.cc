#include <scree/application/simulation.h>
#include <scree/base/exceptions.h>
#include <scree/contact/contact_reach.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

// What a step must satisfy after it converged, and what the user should know of it.
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
/** Of the result: the error of linear kinematics that is told. */
constexpr double largest_rotation_error = 0.01;

/** Whether the moments of a law vanish on the deformed body of a moving geometry: with small
 * strains they vanish where the forces were at the start of the run. */
bool
balances_moments(const std::string &law)
{
  return law.find("linear elastic") == std::string::npos
         && law.find("small strain") == std::string::npos;
}
} // namespace

template <int dim>
void
Simulation<dim>::throw_out_of_balance(const BodyBalance<dim> &balance, const bool is_force) const
{
  const double force = balance.force.norm(), moment = balance.moment.norm();
  std::string  what
    = "the step to time " + short_number(record.time) + " converged, but the body '"
      + bodies[balance.body].name + "' is not in balance: "
      + (is_force
           ? "its contact forces, loads and reactions of " + short_number(balance.force_scale)
               + " in all add up to " + short_number(force)
           : "the moments of its contact forces, loads and reactions ("
               + short_number(balance.force_scale) + " in all, at distances of about "
               + short_number(balance.radius) + ") add up to " + short_number(moment));
  const auto  &newton    = parameters.newton;
  const double tolerance = newton.relative_tolerance * equilibrium->force_scale();
  std::string  remedy;
  if (equilibrium->round_off() > tolerance + newton.absolute_tolerance)
    {
      double stiffest = 0., softest = std::numeric_limits<double>::max(), poisson = -1.;
      for (const auto &body : bodies)
        if (!body.is_rigid())
          {
            stiffest = std::max(stiffest, body.material->young());
            softest  = std::min(softest, body.material->young());
            poisson  = std::max(poisson, body.material->poisson());
          }
      what += "; round-off in the stiffness of the bodies is that large (Young's moduli from "
              + short_number(softest) + " to " + short_number(stiffest)
              + ", Poisson's ratios up to 0.5 - " + short_number(0.5 - poisson) + ")";
      remedy = "make bodies that hardly deform rigid (Law = rigid), keep Poisson's ratio below "
               "0.49999";
    }
  else
    {
      what += "; the tolerances of the iteration are Relative tolerance = "
              + short_number(newton.relative_tolerance)
              + ", Absolute tolerance = " + short_number(newton.absolute_tolerance)
              + " of forces of " + short_number(equilibrium->force_scale());
      remedy = "tighten them in section Solver/Newton";
    }
  throw UserError(bodies[balance.body].path, what, remedy);
}

template <int dim>
std::vector<BodyBalance<dim>>
Simulation<dim>::require_balance(const typename Equilibrium<dim>::Vector &u)
{
  const auto balances = equilibrium->balance(u);
  // Of bodies without any forces: what moving the softest of them leaves by rounding.
  const auto [lower, upper] = grid->box().get_boundary_points();
  double motion             = is_moving() ? 1e-3 * lower.distance(upper) : 0.;
  double softest            = std::numeric_limits<double>::max();
  for (const BodyBalance<dim> &balance : balances)
    {
      motion  = std::max(motion, balance.largest_u);
      softest = std::min(softest, bodies[balance.body].material->young()
                                    * std::pow(balance.radius, dim - 2));
    }
  const double scale     = equilibrium->force_scale();
  const double tolerance = std::max(parameters.newton.relative_tolerance * scale,
                                    std::min(equilibrium->round_off(), round_off * scale));
  for (const BodyBalance<dim> &balance : balances)
    {
      // Residuals of the nodes may all point the same way.
      const double allowed = largest_imbalance * balance.force_scale
                             + std::sqrt(balance.n_nodes) * tolerance + no_force * softest * motion;
      const double held = equilibrium->held_moment(balance.body);
      // On a moving geometry points are where they were at the start of the step.
      const double allowed_moment
        = 2. * balance.radius * (allowed + 2. * held)
          + (is_moving() ? 2. * balance.largest_u * balance.force_scale : 0.);
      const bool is_force = !(balance.force.norm() <= allowed);
      if (held > told_imbalance * balance.force_scale
          && warned_pairs.insert({balance.body, dealii::numbers::invalid_unsigned_int}).second)
        log.line("Warning: contact at few points holds the body " + bodies[balance.body].name
                 + " against turning only to " + short_number(100. * held / balance.force_scale)
                 + " % of what acts on it times half its size; refine the grid there");
      const bool has_moments
        = !is_moving()
          || balances_moments(
            parameters.materials.at(parameters.bodies[balance.body].material).law);
      if (is_force || (has_moments && !(balance.moment.norm() <= allowed_moment)))
        throw_out_of_balance(balance, is_force);
    }
  return balances;
}

template <int dim>
void
Simulation<dim>::warn_of_meetings(const typename Equilibrium<dim>::Vector &u)
{
  const double reach = 2. * parameters.contact.shift * grid->finest_size();
  for (const auto &pair :
       pairs_that_may_have_met(bodies, *contact, parameters.contact, reach,
                               equilibrium->largest_displacements(u), communicator))
    if (warned_pairs.insert(pair).second)
      log.line("Warning: " + bodies[pair.first].name + " and " + bodies[pair.second].name
               + " may have met, but were too far apart at the start for contact between them; "
                 "raise Contact/Shift if they should touch");
}

template <int dim>
void
Simulation<dim>::warn_of_rotations(const std::vector<BodyBalance<dim>>     &balances,
                                   const typename Equilibrium<dim>::Vector &u)
{
  // Force, force times arm, angle of each body.
  std::vector<double> force(bodies.size()), moment(bodies.size()), angle(bodies.size());
  const auto          ghosted = equilibrium->with_ghosts(u);
  for (unsigned int b = 0; b < bodies.size(); ++b)
    if (bodies[b].is_rigid())
      angle[b]
        = RigidPose<dim>(*bodies[b].rigid, rigid_unknowns(*fields, b, ghosted)).rotation().norm();
  for (unsigned int i = 0; i < contact->points().size(); ++i)
    {
      const ContactPoint<dim> &point = contact->points()[i];
      const ContactPair       &pair  = contact->pairs()[point.pair];
      const double             f     = point.weight * std::abs(contact->responses()[i].pressure);
      for (const unsigned int b : {pair.a, pair.b})
        if (bodies[b].is_rigid())
          {
            force[b] += f;
            moment[b] += f * point.position.distance(bodies[b].rigid->reference_point);
          }
    }
  dealii::Utilities::MPI::sum(force, communicator, force);
  dealii::Utilities::MPI::sum(moment, communicator, moment);
  for (const BodyBalance<dim> &balance : balances)
    {
      angle[balance.body]  = balance.rotation;
      moment[balance.body] = 0.5 * balance.force_scale * balance.radius;
    }

  double       stiffness = 0.;
  const auto   volumes   = bulk->volumes();
  const double work      = 2. * equilibrium->energies().stored();
  for (unsigned int b = 0; b < bodies.size(); ++b)
    if (!bodies[b].is_rigid())
      stiffness += bodies[b].material->young() * volumes[b];
  for (unsigned int b = 0; b < bodies.size(); ++b)
    {
      // Work of the forces on the second-order motion, which linear kinematics does not have.
      const double second_order = 0.5 * angle[b] * angle[b] * moment[b];
      const bool   is_strained  = work > 1e-20 * angle[b] * angle[b] * stiffness;
      if (is_strained && second_order > largest_rotation_error * work
          && warned_rotations.insert(b).second)
        log.line("Warning: the body " + bodies[b].name + " has turned by "
                 + short_number(angle[b] * 180. / M_PI) + " degrees at time "
                 + short_number(record.time)
                 + ". On a fixed geometry, where rotations are taken as small, this makes forces "
                   "wrong by more than 1 %: set Moving geometry/Update = every step");
    }
}

template <int dim>
void
Simulation<dim>::require_prescribable()
{
  auto         u   = state.displacement;
  const double end = parameters.time.end_time;
  for (const double time : {step_control.next_time(), 0.5 * (state.time + end), end, state.time})
    equilibrium->set_time(time, u);
}

template <int dim>
void
Simulation<dim>::require_inside_box() const
{
  std::vector<double> outside(bodies.size(), 0.);
  const auto [lower, upper] = grid->box().get_boundary_points();
  for (std::size_t p = 0; p < state.points.size(); ++p)
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double x = state.points.position[p][d];
        outside[state.points.body[p]]
          = std::max(outside[state.points.body[p]], std::max(lower[d] - x, x - upper[d]));
      }
  dealii::Utilities::MPI::max(outside, communicator, outside);
  for (unsigned int b = 0; b < bodies.size(); ++b)
    require(outside[b] <= 0. || parameters.moving.may_leave_box, bodies[b].path,
            "the body '" + bodies[b].name + "' has moved through a face of the background box at "
              + "time " + short_number(record.time) + " (material points are outside by "
              + short_number(outside[b]) + "), where it is cut off",
            "enlarge Grid/Lower corner, Upper corner (the number of Cells with them), hold the "
            "motion normal to the face, or set Moving geometry/Leaving the box = allowed");
}

#define SCREE_INSTANTIATE(dim)                                                                     \
  template void Simulation<dim>::throw_out_of_balance(const BodyBalance<dim> &, const bool) const; \
  template std::vector<BodyBalance<dim>> Simulation<dim>::require_balance(                         \
    const typename Equilibrium<dim>::Vector &);                                                    \
  template void Simulation<dim>::warn_of_rotations(const std::vector<BodyBalance<dim>> &,          \
                                                   const typename Equilibrium<dim>::Vector &);     \
  template void Simulation<dim>::warn_of_meetings(const typename Equilibrium<dim>::Vector &);      \
  template void Simulation<dim>::require_prescribable();                                           \
  template void Simulation<dim>::require_inside_box() const;

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
