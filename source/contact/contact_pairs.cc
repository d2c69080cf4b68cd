#include <scree/bodies/broad_phase.h>
#include <scree/contact/contact_pairs.h>

#include <optional>

namespace scree
{
namespace
{
template <int dim>
std::optional<ContactPairParameters>
law_between(const Body<dim> &a, const Body<dim> &b, const ContactParameters &contact)
{
  const auto is_driven
    = [](const Body<dim> &body) { return body.is_rigid() && !body.rigid->is_free(); };
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
  unsigned int n_pairs = 0;
  for (unsigned int b = 0; b < bodies.size(); ++b)
    for (unsigned int a = 0; a < b && n_pairs <= n; ++a)
      n_pairs += law_between(bodies[a], bodies[b], contact).has_value();
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
