#include <scree/geometry/shape_family.h>

namespace scree
{
ShapeEntry
positive_length(const std::string &key, const std::string &text)
{
  return {key, text, "[length]", unset_number, true};
}

ShapeEntry
coordinates(const std::string &key, const std::string &text, const std::string &unit)
{
  return {key, text, unit, std::vector<double>()};
}

ShapeEntry
semi_axes_entry()
{
  return {"Semi-axes", "Half the widths of % along x, y (and z)", "[length]", std::vector<double>(),
          true};
}
} // namespace scree
