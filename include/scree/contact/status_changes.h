#pragma once

#include <scree/contact/contact_points.h>

#include <vector>

namespace scree
{
/** Counts the contact points that change between open, stick and slip from iteration to iteration.
 */
class StatusChanges
{
public:
  /** Compares the last evaluation with the one that was counted before. */
  template <int dim>
  void count(const ContactPoints<dim> &contact)
  {
    const auto &responses = contact.responses();
    last.resize(responses.size(), ContactStatus::open);
    changes.assign(contact.pairs().size(), 0);
    for (unsigned int i = 0; i < responses.size(); ++i)
      {
        changes[contact.points()[i].pair] += responses[i].status != last[i];
        last[i] = responses[i].status;
      }
  }

  /** Of each pair, on this process. */
  const std::vector<unsigned int> &of_pairs() const
  {
    return changes;
  }

private:
  std::vector<ContactStatus> last;
  std::vector<unsigned int>  changes;
};
} // namespace scree
