#pragma once

#include <scree/bodies/body.h>

#include <deal.II/boost_adaptors/bounding_box.h>

#include <boost/geometry.hpp> // all that the tree needs: Boost 1.83 does not include it there
#include <boost/geometry/index/rtree.hpp>
#include <utility>
#include <vector>

namespace scree
{
/** Broad phase: which bodies are near a box, by an r-tree of their own boxes (Boost.Geometry). */
template <int dim>
class BodyBoxes
{
public:
  explicit BodyBoxes(const std::vector<dealii::BoundingBox<dim>> &boxes);
  explicit BodyBoxes(const std::vector<Body<dim>> &bodies);

  /** The bodies whose boxes intersect `box`, in ascending order. */
  void find(const dealii::BoundingBox<dim> &box, std::vector<unsigned int> &found) const;

  /** The pairs (a < b) whose boxes come closer than `reach` [L], in ascending order. */
  std::vector<std::pair<unsigned int, unsigned int>> pairs(const double reach) const;

  /** The box of a body. */
  const dealii::BoundingBox<dim> &box(const unsigned int body) const
  {
    return boxes[body];
  }

private:
  using Entry = std::pair<dealii::BoundingBox<dim>, unsigned int>;
  using Tree  = boost::geometry::index::rtree<Entry, boost::geometry::index::linear<16>>;

  std::vector<dealii::BoundingBox<dim>> boxes;
  Tree                                  tree;
};
} // namespace scree
