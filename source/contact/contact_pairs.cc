#include <scree/bodies/broad_phase.h>
#include <scree/contact/contact_pairs.h>

#include <cstdint>
#include <map>
#include <optional>

namespace scree
{
namespace
{
/** Of each body, whether it is rigid and its motion prescribed at all times. */
template <int dim>
std::vector<bool>
are_driven(const std::vector<Body<dim>> &bodies, const std::vector<bool> &responds)
{
  std::vector<bool> result;
  for (unsigned int b = 0; b < bodies.size(); ++b)
    result.push_back(bodies[b].is_rigid() && !bodies[b].rigid->is_free()
                     && !(b < responds.size() && responds[b]));
  return result;
}

template <int dim>
std::optional<ContactPairParameters>
law_between(const unsigned int a, const unsigned int b, const std::vector<Body<dim>> &bodies,
            const std::vector<bool> &driven, const ContactParameters &contact)
{
  if (driven[a] && driven[b])
    return {};
  const auto law = contact.law_of(bodies[a].name, bodies[b].name);
  if (!law.kind->acts)
    return {};
  return law;
}
} // namespace

template <int dim>
std::vector<ContactPair>
pairs_within(const double reach, const std::vector<Body<dim>> &bodies,
             const ContactParameters &contact, const std::vector<bool> &responds)
{
  const std::vector<bool>  driven = are_driven(bodies, responds);
  std::vector<ContactPair> result;
  for (const auto &[a, b] : BodyBoxes<dim>(bodies).pairs(reach))
    if (const auto law = law_between(a, b, bodies, driven, contact))
      result.push_back({a, b, bodies[a].name + "-" + bodies[b].name, *law});
  return result;
}

template <int dim>
bool
has_more_pairs_than(const unsigned int n, const std::vector<Body<dim>> &bodies,
                    const ContactParameters &contact, const std::vector<bool> &responds)
{
  const std::vector<bool> driven = are_driven(bodies, responds);
  // Bodies of one kind, few in number, have the same laws: the first stands for all.
  struct Kind
  {
    unsigned int  first;
    std::uint64_t n_bodies = 0;
  };
  std::map<std::vector<bool>, Kind> kinds;
  for (unsigned int b = 0; b < bodies.size(); ++b)
    {
      auto key = contact.roles_of(bodies[b].name);
      key.push_back(driven[b]);
      ++kinds.emplace(key, Kind{b}).first->second.n_bodies;
    }
  std::uint64_t n_pairs = 0;
  for (auto a = kinds.begin(); a != kinds.end(); ++a)
    for (auto b = a; b != kinds.end() && n_pairs <= n; ++b)
      if (law_between(a->second.first, b->second.first, bodies, driven, contact))
        n_pairs += a == b ? a->second.n_bodies * (a->second.n_bodies - 1) / 2
                          : a->second.n_bodies * b->second.n_bodies;
  return n_pairs > n;
}

#define SCREE_INSTANTIATE(dim)                                                                 \
  template std::vector<ContactPair> pairs_within(const double, const std::vector<Body<dim>> &, \
                                                 const ContactParameters &,                    \
                                                 const std::vector<bool> &);                   \
  template bool has_more_pairs_than(const unsigned int, const std::vector<Body<dim>> &,        \
                                    const ContactParameters &, const std::vector<bool> &);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
