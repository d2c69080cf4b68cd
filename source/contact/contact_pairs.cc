#include <scree/bodies/broad_phase.h>
#include <scree/contact/contact_pairs.h>

#include <cstdint>
#include <map>
#include <optional>

namespace scree
{
namespace
{
template <int dim>
bool
is_driven(const Body<dim> &body)
{
  return body.is_rigid() && !body.rigid->is_free();
}

template <int dim>
std::optional<ContactPairParameters>
law_between(const Body<dim> &a, const Body<dim> &b, const ContactParameters &contact)
{
  if (is_driven(a) && is_driven(b))
    return {};
  const auto law = contact.law_of(a.name, b.name);
  if (!law.kind->acts)
    return {};
  return law;
}
} // namespace

template <int dim>
std::vector<ContactPair>
pairs_within(const double reach, const std::vector<Body<dim>> &bodies,
             const ContactParameters &contact)
{
  std::vector<ContactPair> result;
  for (const auto &[a, b] : BodyBoxes<dim>(bodies).pairs(reach))
    if (const auto law = law_between(bodies[a], bodies[b], contact))
      result.push_back({a, b, bodies[a].name + "-" + bodies[b].name, *law});
  return result;
}

template <int dim>
bool
has_more_pairs_than(const unsigned int n, const std::vector<Body<dim>> &bodies,
                    const ContactParameters &contact)
{
  // Bodies of one kind, few in number, have the same laws: the first stands for all.
  struct Kind
  {
    const Body<dim> *first;
    std::uint64_t    n_bodies = 0;
  };
  std::map<std::vector<bool>, Kind> kinds;
  for (const Body<dim> &body : bodies)
    {
      auto key = contact.roles_of(body.name);
      key.push_back(is_driven(body));
      ++kinds.emplace(key, Kind{&body}).first->second.n_bodies;
    }
  std::uint64_t n_pairs = 0;
  for (auto a = kinds.begin(); a != kinds.end(); ++a)
    for (auto b = a; b != kinds.end() && n_pairs <= n; ++b)
      if (law_between(*a->second.first, *b->second.first, contact))
        n_pairs += a == b ? a->second.n_bodies * (a->second.n_bodies - 1) / 2
                          : a->second.n_bodies * b->second.n_bodies;
  return n_pairs > n;
}

#define SCREE_INSTANTIATE(dim)                                                                 \
  template std::vector<ContactPair> pairs_within(const double, const std::vector<Body<dim>> &, \
                                                 const ContactParameters &);                   \
  template bool has_more_pairs_than(const unsigned int, const std::vector<Body<dim>> &,        \
                                    const ContactParameters &);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
