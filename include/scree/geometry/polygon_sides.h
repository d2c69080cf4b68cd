#pragma once

#include <deal.II/base/point.h>

#include <array>
#include <cstddef>
#include <vector>

namespace scree
{
/**
 * The sides of a closed polygon in a binary tree of boxes around consecutive sides: distances and
 * insides take a time like the logarithm of the number of sides.
 */
class PolygonSides
{
public:
  explicit PolygonSides(const std::vector<dealii::Point<2>> &vertices);

  /** Distance to the nearest side; negative inside. */
  double signed_distance(const dealii::Point<2> &x) const;

  /** Whether two sides cross or touch beyond common vertices. */
  bool cross() const;

private:
  struct Box
  {
    std::array<double, 2> lower, upper;

    void   add(const Box &other);
    bool   meets(const Box &other) const;
    double squared_distance(const dealii::Point<2> &x) const;
  };
  struct Search;

  static constexpr std::size_t sides_of_leaf = 4;

  /** Side i goes from vertex i to the next one. */
  const dealii::Point<2> &start(const std::size_t i) const
  {
    return vertices[i];
  }
  const dealii::Point<2> &end(const std::size_t i) const
  {
    return vertices[i + 1 == vertices.size() ? 0 : i + 1];
  }
  bool conflict(const std::size_t i, const std::size_t j) const;
  Box  box_of(const std::size_t side) const;
  void build(const std::size_t node, const std::size_t first, const std::size_t last);
  void search(const dealii::Point<2> &x, const std::size_t node, const std::size_t first,
              const std::size_t last, Search &found) const;

  /** Whether side i conflicts with one of the later sides below a node. */
  bool any_conflict(const std::size_t i, const Box &box, const std::size_t node,
                    const std::size_t first, const std::size_t last) const;

  std::vector<dealii::Point<2>> vertices;
  std::vector<Box>              boxes; //!< children of node k: 2k + 1, 2k + 2
};
} // namespace scree
