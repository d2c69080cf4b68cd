#pragma once

#include <array>
#include <boost/serialization/array.hpp>
#include <boost/serialization/library_version_type.hpp> // set.hpp needs it
#include <boost/serialization/set.hpp>
#include <set>

namespace scree
{
/** What a run tells once of a body or a pair of bodies. */
enum class Warning : unsigned int
{
  leaves_box,     // moves through a face of the background box
  badly_held,     // contact at few points hardly holds it against turning
  loose,          // nothing holds it
  turned,         // too far for linear kinematics
  strained,       // too much for them
  under_resolved, // contact at very few points
  may_have_met,   // without contact points
  lost_contact    // nothing presses any more; of no body
};

/** What a run has warned about; a run that is resumed does not tell it again. */
class Warnings
{
public:
  /** Whether this was not told yet; from now on it counts as told. */
  bool is_new(const Warning kind, const unsigned int body, const unsigned int other_body = 0)
  {
    return told.insert(Entry{{static_cast<unsigned int>(kind), body, other_body}}).second;
  }

  /** Number of bodies or pairs that were told. */
  unsigned int count(const Warning kind) const
  {
    unsigned int n = 0;
    for (const auto &entry : told)
      n += entry[0] == static_cast<unsigned int>(kind);
    return n;
  }

  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &told;
  }

private:
  using Entry = std::array<unsigned int, 3>; //!< kind and bodies

  std::set<Entry> told;
};
} // namespace scree
