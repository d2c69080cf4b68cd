#pragma once

#include <deal.II/base/point.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace scree
{
/** Triangles between points, in the order of a file. */
struct TriangleSoup
{
  using Triangle = std::array<std::size_t, 3>;

  std::vector<dealii::Point<3>> points; //!< those of equal coordinates are one
  std::vector<Triangle>         triangles;

  /**
   * Reads STL and PLY (text or binary) or OBJ. Faces of more than three corners are divided into
   * fans.
   *
   * @param bytes of the file
   * @param name  of the file, for messages; its end tells an OBJ file
   * @throws UserError if it is damaged, of another kind, or has no triangle
   */
  static TriangleSoup read(const std::string &bytes, const std::string &name);
};
} // namespace scree
