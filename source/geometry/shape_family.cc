#include <scree/geometry/shape_family.h>

namespace scree
{
ShapeEntry
positive_length(const std::string &key, const std::string &text)
{
  return {key, text, "[L]", unset_number, true};
}

ShapeEntry
coordinates(const std::string &key, const std::string &text, const std::string &unit)
{
  return {key, text, unit, std::vector<double>()};
}

ShapeEntry
checksum_entry()
{
  return {"Checksum", "CRC-32 of the file, written by the program: another file is then refused",
          "",         std::string(),
          false,      false};
}

ShapeEntry
corner_radius()
{
  return {"Corner radius",
          "Radius of the corners, in 3D of the edges too, of %; unset: they are sharp",
          "[L]",
          unset_number,
          true,
          false};
}

ShapeEntry
scale_of_file()
{
  return {"Scale", "Factor of the coordinates of the file; unset: 1", "", unset_number, true,
          false};
}

ShapeEntry
semi_axes_entry()
{
  return {"Semi-axes", "Half the widths of % along x, y (and z)", "[L]", std::vector<double>(),
          true};
}
} // namespace scree
