#include <scree/base/exceptions.h>
#include <scree/base/log.h>
#include <scree/bodies/broad_phase.h>
#include <scree/contact/contact_reach.h>
#include <scree/level_set/node_search.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <set>

namespace scree
{
template <int dim>
void
require_contact_within_reach(const ContactPoints<dim> &contact, const double reach,
                             const MPI_Comm communicator)
{
  const double largest_gap = 0.8 * reach;
  bool         at_nodes    = false;
  unsigned int n_beyond    = 0;
  for (unsigned int i = 0; i < contact.points().size(); ++i)
    {
      at_nodes = at_nodes || contact.points()[i].is_node;
      n_beyond += contact.points()[i].initial_gap > largest_gap && contact.gap(i) < 0.
                  && contact.responses()[i].pressure > 0.;
    }
  if (dealii::Utilities::MPI::sum(n_beyond, communicator) == 0)
    return;
  at_nodes = dealii::Utilities::MPI::max(at_nodes ? 1 : 0, communicator) == 1;
  throw UserError(at_nodes ? "Contact/Surface" : "Contact/Shift",
                  "bodies touch where they were farther apart than " + short_number(largest_gap)
                    + " at the start, "
                    + (at_nodes ? "and may have met where they share no nodes"
                                : "which is where the contact surface ends"),
                  at_nodes
                    ? "take more steps on a moving geometry, or set Contact/Surface = level sets"
                    : "raise Contact/Shift");
}

template <int dim>
std::vector<std::pair<unsigned int, unsigned int>>
pairs_that_may_have_met(const std::vector<Body<dim>> &bodies, const ContactPoints<dim> &contact,
                        const ContactParameters &parameters, const double reach,
                        const std::vector<double> &motion, const MPI_Comm communicator)
{
  std::vector<unsigned int> n_points(contact.pairs().size());
  for (const ContactPoint<dim> &point : contact.points())
    ++n_points[point.pair];
  dealii::Utilities::MPI::sum(n_points, communicator, n_points);
  std::set<std::pair<unsigned int, unsigned int>> watched;
  for (unsigned int p = 0; p < n_points.size(); ++p)
    if (n_points[p] > 0)
      watched.insert({contact.pairs()[p].a, contact.pairs()[p].b});
  std::vector<dealii::BoundingBox<dim>> reached;
  for (unsigned int b = 0; b < bodies.size(); ++b)
    {
      reached.push_back(bodies[b].box);
      reached.back().extend(motion[b]);
    }
  std::vector<std::pair<unsigned int, unsigned int>> result;
  for (const auto &pair : BodyBoxes<dim>(reached).pairs(0.))
    if (watched.count(pair) == 0 && motion[pair.first] + motion[pair.second] > reach
        && parameters.law_of(bodies[pair.first].name, bodies[pair.second].name).kind->acts)
      result.push_back(pair);
  return result;
}

template <int dim>
void
require_distinct(const std::vector<Body<dim>> &bodies, const std::vector<ContactPair> &pairs)
{
  constexpr double    largest_part = 0.9;
  std::vector<double> depths(bodies.size(), -1.);
  const auto          depth = [&](const unsigned int body) {
    if (depths[body] < 0.)
      depths[body] = -smallest_value(bodies[body].level_set);
    return depths[body];
  };
  for (const ContactPair &pair : pairs)
    {
      const Lattice<dim>             &a = bodies[pair.a].level_set, &b = bodies[pair.b].level_set;
      const dealii::BoundingBox<dim> &of_b = bodies[pair.b].box;
      if (of_b.get_neighbor_type(bodies[pair.a].box) == dealii::NeighborType::not_neighbors)
        continue;
      double overlap = 0.;
      search_nodes<dim>({a.lower(), a.n_nodes()},
                        [&](const auto &, const auto &centre, const double radius) {
                          const dealii::Point<dim> x = a.node(centre);
                          const double both = std::min(-a.passing_value(centre), -b.value(x, 1));
                          if (both > overlap && of_b.point_inside(x))
                            overlap = both;
                          return both + slope_bound * a.spacing() * radius > overlap;
                        });
      if (overlap < largest_part * std::min(depth(pair.a), depth(pair.b)))
        continue;
      throw UserError(bodies[pair.b].path + "/Shape",
                      "the bodies '" + bodies[pair.a].name + "' and '" + bodies[pair.b].name
                        + "' coincide, or one lies inside the other: they overlap by "
                        + short_number(2. * overlap) + ", so there is no surface between them",
                      "move them apart, cut the hole into the outer one (Type = difference), or "
                      "set Law = none for this pair");
    }
}

template <int dim>
std::vector<unsigned int>
under_resolved_pairs(const ContactPoints<dim> &contact, const MPI_Comm communicator)
{
  constexpr unsigned int    enough = dim == 2 ? 3 : 9;
  std::vector<unsigned int> n_closed(contact.pairs().size()), result;
  for (unsigned int i = 0; i < contact.points().size(); ++i)
    n_closed[contact.points()[i].pair] += contact.responses()[i].pressure != 0.;
  dealii::Utilities::MPI::sum(n_closed, communicator, n_closed);
  for (unsigned int p = 0; p < n_closed.size(); ++p)
    if (n_closed[p] > 0 && n_closed[p] < enough)
      result.push_back(p);
  return result;
}

#define SCREE_INSTANTIATE(dim)                                                             \
  template void require_contact_within_reach(const ContactPoints<dim> &, const double,     \
                                             const MPI_Comm);                              \
  template std::vector<std::pair<unsigned int, unsigned int>> pairs_that_may_have_met(     \
    const std::vector<Body<dim>> &, const ContactPoints<dim> &, const ContactParameters &, \
    const double, const std::vector<double> &, const MPI_Comm);                            \
  template void                      require_distinct(const std::vector<Body<dim>> &,      \
                                                      const std::vector<ContactPair> &);   \
  template std::vector<unsigned int> under_resolved_pairs(const ContactPoints<dim> &,      \
                                                          const MPI_Comm);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
