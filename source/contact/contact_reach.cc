#include <scree/base/exceptions.h>
#include <scree/base/log.h>
#include <scree/contact/contact_reach.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace scree
{
template <int dim>
void
require_contact_within_reach(const ContactPoints<dim> &contact, const double shift,
                             const MPI_Comm communicator)
{
  const double largest_gap = 0.8 * 2. * shift;
  unsigned int n_beyond    = 0;
  for (unsigned int i = 0; i < contact.points().size(); ++i)
    n_beyond
      += contact.points()[i].initial_gap > largest_gap && contact.responses()[i].pressure > 0.;
  require(dealii::Utilities::MPI::sum(n_beyond, communicator) == 0, "Contact/Shift",
          "bodies touch where they were farther apart than " + short_number(largest_gap)
            + " at the start, which is where the contact surface ends",
          "raise Contact/Shift");
}

template <int dim>
std::vector<std::pair<unsigned int, unsigned int>>
pairs_that_may_have_met(const std::vector<Body<dim>> &bodies, const std::vector<ContactPair> &pairs,
                        const ContactParameters &parameters, const std::vector<double> &motion)
{
  std::vector<std::pair<unsigned int, unsigned int>> result;
  for (unsigned int a = 0; a < bodies.size(); ++a)
    for (unsigned int b = a + 1; b < bodies.size(); ++b)
      {
        dealii::BoundingBox<dim> reached(bodies[a].box);
        reached.extend(motion[a] + motion[b]);
        const bool is_watched
          = std::any_of(pairs.begin(), pairs.end(),
                        [&](const ContactPair &pair) { return pair.a == a && pair.b == b; });
        if (!is_watched
            && reached.get_neighbor_type(bodies[b].box) != dealii::NeighborType::not_neighbors
            && parameters.law_of(bodies[a].name, bodies[b].name).law != ContactLaw::none)
          result.emplace_back(a, b);
      }
  return result;
}

#define SCREE_INSTANTIATE(dim)                                                                   \
  template void require_contact_within_reach(const ContactPoints<dim> &, const double,           \
                                             const MPI_Comm);                                    \
  template std::vector<std::pair<unsigned int, unsigned int>> pairs_that_may_have_met(           \
    const std::vector<Body<dim>> &, const std::vector<ContactPair> &, const ContactParameters &, \
    const std::vector<double> &);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
