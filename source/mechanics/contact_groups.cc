#include <scree/mechanics/contact_groups.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <limits>

namespace scree
{
template <int dim>
ContactGroups<dim>::ContactGroups(const DisplacementSpace<dim> &space,
                                  const std::vector<Body<dim>> &bodies,
                                  const ContactPoints<dim>     &contact)
    : contact(contact)
    , communicator(space.grid.communicator())
    , body_of_unknown(space.owned().n_elements())
    , are_touching(contact.pairs().size())
{
  const auto set = [&](const DofIndex unknown, const unsigned int body) {
    if (space.owned().is_element(unknown))
      body_of_unknown[space.owned().index_within_set(unknown)] = body;
  };
  for (unsigned int a = 0; a < space.cells().size(); ++a)
    for (unsigned int k = 0; k < space.basis.n_nodes; ++k)
      for (unsigned int d = 0; d < dim; ++d)
        set(space.nodes(a)[k] + d, space.cells()[a].body);
  for (unsigned int b = 0; b < bodies.size(); ++b)
    {
      bool is_free = !bodies[b].is_rigid();
      for (unsigned int m = 0; bodies[b].is_rigid() && m < n_rigid_components<dim>; ++m)
        {
          set(space.rigid_unknown(b) + m, b);
          is_free = is_free || bodies[b].rigid->is_free(m);
        }
      is_joining.push_back(is_free);
    }
}

template <int dim>
void
ContactGroups<dim>::clear()
{
  std::fill(are_touching.begin(), are_touching.end(), 0);
}

template <int dim>
void
ContactGroups<dim>::add()
{
  for (unsigned int i = 0; i < contact.points().size(); ++i)
    if (contact.responses()[i].pressure != 0.)
      are_touching[contact.points()[i].pair] = 1;
}

template <int dim>
std::vector<unsigned int>
ContactGroups<dim>::groups() const
{
  auto everywhere = are_touching;
  dealii::Utilities::MPI::max(are_touching, communicator, everywhere);
  boost::disjoint_sets_with_storage<> sets(is_joining.size());
  for (unsigned int p = 0; p < everywhere.size(); ++p)
    if (const ContactPair &pair = contact.pairs()[p];
        everywhere[p] != 0 && is_joining[pair.a] && is_joining[pair.b])
      sets.union_set(std::size_t(pair.a), std::size_t(pair.b));
  constexpr unsigned int    none = std::numeric_limits<unsigned int>::max();
  std::vector<unsigned int> number(is_joining.size(), none);
  std::vector<unsigned int> result(is_joining.size());
  unsigned int              n_groups = 0;
  for (unsigned int b = 0; b < result.size(); ++b)
    {
      unsigned int &of_set = number[sets.find_set(std::size_t(b))];
      if (of_set == none)
        of_set = n_groups++;
      result[b] = of_set;
    }
  return result;
}

template <int dim>
Partition
ContactGroups<dim>::partition() const
{
  const std::vector<unsigned int> of_bodies = groups();
  Partition                       result;
  result.n_parts = 1 + *std::max_element(of_bodies.begin(), of_bodies.end());
  if (result.n_parts == 1)
    return result;
  result.parts.reserve(body_of_unknown.size());
  for (const unsigned int body : body_of_unknown)
    result.parts.push_back(of_bodies[body]);
  return result;
}

template class ContactGroups<2>;
template class ContactGroups<3>;
} // namespace scree
