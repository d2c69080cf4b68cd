#include <scree/base/log.h>
#include <scree/mechanics/step_criteria.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace scree
{
namespace
{
/** By how much each body may move [L], see why_too_large() (collective). */
template <int dim>
std::vector<double>
largest_motions(const DiscreteProblem<dim> &problem, const double negligible_force)
{
  constexpr double loose_share = 0.75; // of the reach of contact
  const double of_pressed = problem.parameters.moving.largest_motion * problem.grid.finest_size();
  std::vector<double> forces(problem.bodies.size(), 0.), result(problem.bodies.size(), of_pressed);
  const ContactPoints<dim> &contact = problem.contact();
  for (unsigned int i = 0; i < contact.points().size(); ++i)
    {
      const ContactPair &pair = contact.pairs()[contact.points()[i].pair];
      const double force = contact.points()[i].weight * std::abs(contact.responses()[i].pressure);
      forces[pair.a] += force;
      forces[pair.b] += force;
    }
  dealii::Utilities::MPI::sum(forces, problem.communicator(), forces);
  for (const FreeMotion &free : problem.equilibrium().free_bodies())
    if (forces[free.body] <= negligible_force)
      result[free.body] = std::max(of_pressed, loose_share * problem.contact_reach());
  return result;
}
} // namespace

template <int dim>
std::string
why_too_large(const DiscreteProblem<dim> &problem, const MaterialPoints<dim> &before,
              const MaterialPoints<dim> &after, const double negligible_force)
{
  const double                    h        = problem.grid.finest_size();
  const MovingGeometryParameters &moving   = problem.parameters.moving;
  const unsigned int              n_bodies = problem.bodies.size();
  std::vector<double>             motions(2 * n_bodies, 0.); // and whether points turn inside out
  for (std::size_t p = 0; p < before.size(); ++p)
    {
      double &largest = motions[before.body[p]];
      largest         = std::max(largest, after.position[p].distance(before.position[p]));
      if (!(determinant(after.deformation_gradient[p]) > 0.)) // or it is not a number
        motions[n_bodies + before.body[p]] = 1.;
    }
  dealii::Utilities::MPI::max(motions, problem.communicator(), motions);
  const std::vector<double> allowed = largest_motions(problem, negligible_force);
  for (unsigned int b = 0; b < n_bodies; ++b)
    {
      if (motions[b] > allowed[b])
        return "the body " + problem.bodies[b].name + " moves by " + short_number(motions[b] / h)
               + " finest cells (Moving geometry/Largest motion)";
      if (motions[n_bodies + b] > 0.)
        return "material points of the body " + problem.bodies[b].name + " are turned inside out";
    }
  double slip = 0.;
  for (const auto &response : problem.contact().responses())
    slip = std::max(slip, response.slip);
  slip = dealii::Utilities::MPI::max(slip, problem.communicator());
  if (slip > moving.largest_slip * h)
    return "contact slides by " + short_number(slip / h)
           + " finest cells (Moving geometry/Largest slip)";
  return "";
}

template <int dim>
void
require_inside_box(const DiscreteProblem<dim> &problem, const MaterialPoints<dim> &points,
                   const double time)
{
  std::vector<double> outside(problem.bodies.size(), 0.);
  const auto [lower, upper] = problem.grid.box().get_boundary_points();
  for (std::size_t p = 0; p < points.size(); ++p)
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double x       = points.position[p][d];
        double      &largest = outside[points.body[p]];
        largest              = std::max({largest, lower[d] - x, x - upper[d]});
      }
  dealii::Utilities::MPI::max(outside, problem.communicator(), outside);
  for (unsigned int b = 0; b < outside.size(); ++b)
    require(outside[b] <= 0. || problem.parameters.moving.may_leave_box, problem.bodies[b].path,
            "the body '" + problem.bodies[b].name
              + "' has moved through a face of the background box at time " + short_number(time)
              + " (material points are outside by " + short_number(outside[b])
              + "), where it is cut off",
            "enlarge Grid/Lower corner, Upper corner (the number of Cells with them), hold the "
            "motion normal to the face, or set Moving geometry/Leaving the box = allowed");
}

template <int dim>
void
require_no_loss(const std::vector<Body<dim>> &bodies, const std::vector<PointTotals<dim>> &before,
                const std::vector<PointTotals<dim>> &after, const unsigned int n_processes)
{
  // The sums are compensated on each process, so that only those of the processes add up rounding.
  const double tolerance = (64. + n_processes) * std::numeric_limits<double>::epsilon();
  const auto   is_kept
    = [&](const double old, const double now) { return std::abs(now - old) <= tolerance * old; };
  for (unsigned int b = 0; b < after.size(); ++b)
    AssertThrow(after[b].count >= before[b].count && is_kept(before[b].mass, after[b].mass)
                  && is_kept(before[b].initial_volume, after[b].initial_volume),
                dealii::ExcMessage("material points of " + bodies[b].name + " were lost"));
}

template <int dim>
std::optional<UserError>
slide(const DiscreteProblem<dim> &problem, const ContactHistory<dim> &history, const double time,
      const double step_fraction)
{
  // Gap, slip in cells, and pair of the point where bodies are nearest.
  const ContactPoints<dim> &contact = problem.contact();
  const double              h       = problem.grid.finest_size();
  std::array<double, 3>     nearest = {{std::numeric_limits<double>::max(), 0., 0.}};
  for (unsigned int i = 0; i < contact.points().size(); ++i)
    if (contact.gap(i) < nearest[0])
      {
        const auto &n    = contact.points()[i].normal;
        const auto  jump = contact.jumps()[i] - history.jump[i];
        nearest          = {
                   {contact.gap(i), (jump - (n * jump) * n).norm() / h, double(contact.points()[i].pair)}};
      }
  for (const auto &other : dealii::Utilities::MPI::all_gather(problem.communicator(), nearest))
    nearest = std::min(nearest, other);
  if (nearest[1] < step_fraction)
    return {};
  const ContactPair &pair = contact.pairs()[static_cast<unsigned int>(nearest[2])];
  return UserError("Contact/" + pair.law.name,
                   "'" + problem.bodies[pair.a].name + "' or '" + problem.bodies[pair.b].name
                     + "' slides away at time " + short_number(time)
                     + ": what is prescribed presses them, and they slip along each other by "
                     + short_number(nearest[1] * h) + " until nothing presses any more",
                   "hold the body that slides, drive it by a force, or raise the friction "
                   "coefficient");
}

#define SCREE_INSTANTIATE(dim)                                                                       \
  template std::string why_too_large(const DiscreteProblem<dim> &, const MaterialPoints<dim> &,      \
                                     const MaterialPoints<dim> &, const double);                     \
  template void        require_inside_box(const DiscreteProblem<dim> &, const MaterialPoints<dim> &, \
                                          const double);                                             \
  template void        require_no_loss(const std::vector<Body<dim>> &,                               \
                                       const std::vector<PointTotals<dim>> &,                        \
                                       const std::vector<PointTotals<dim>> &, const unsigned int);   \
  template std::optional<UserError> slide(                                                           \
    const DiscreteProblem<dim> &, const ContactHistory<dim> &, const double, const double);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
