#pragma once

#include <map>
#include <string>
#include <vector>

namespace scree
{
/**
 * A relation between quantities of a run that have names, as in `p > 2` or
 * `abs(side-left.force_x) >= 0.3*lid.force_y`: formulas of muParser on both sides of <, <=, > or
 * >=. Where a '-' may be part of a name, the longest name that is known counts.
 */
class StopRelation
{
public:
  /** @throws UserError, named after `where`, unless there are two sides and one comparison */
  StopRelation(const std::string &text, const std::string &where);

  /** @throws UserError if there are other names in it, or a side is no formula of them */
  void require_known(const std::vector<std::string> &names) const;

  /** By how much it holds: the difference of its sides, not negative where it is fulfilled; NaN
   * where a side has no value. */
  double margin(const std::map<std::string, double> &quantities) const;

  const std::string &text() const
  {
    return relation;
  }

private:
  std::string relation, where, left, right; //!< it holds if left >= right
};
} // namespace scree
