#include <scree/bodies/broad_phase.h>

#include <algorithm>
#include <iterator>

namespace scree
{
namespace bgi = boost::geometry::index;

template <int dim>
BodyBoxes<dim>::BodyBoxes(const std::vector<dealii::BoundingBox<dim>> &boxes)
    : boxes(boxes)
{
  std::vector<Entry> entries;
  for (unsigned int b = 0; b < boxes.size(); ++b)
    entries.emplace_back(boxes[b], b);
  tree = Tree(entries);
}

template <int dim>
BodyBoxes<dim>::BodyBoxes(const std::vector<Body<dim>> &bodies)
    : BodyBoxes([&bodies] {
      std::vector<dealii::BoundingBox<dim>> boxes;
      boxes.reserve(bodies.size());
      for (const Body<dim> &body : bodies)
        boxes.push_back(body.box);
      return boxes;
    }())
{
}

template <int dim>
void
BodyBoxes<dim>::find(const dealii::BoundingBox<dim> &box, std::vector<unsigned int> &found) const
{
  found.clear();
  for (auto it = tree.qbegin(bgi::intersects(box)); it != tree.qend(); ++it)
    found.push_back(it->second);
  std::sort(found.begin(), found.end());
}

template <int dim>
std::vector<std::pair<unsigned int, unsigned int>>
BodyBoxes<dim>::pairs(const double reach) const
{
  std::vector<std::pair<unsigned int, unsigned int>> result;
  std::vector<unsigned int>                          found;
  for (unsigned int a = 0; a < boxes.size(); ++a)
    {
      dealii::BoundingBox<dim> enlarged(boxes[a]);
      enlarged.extend(reach);
      find(enlarged, found);
      for (const unsigned int b : found)
        if (a < b)
          result.emplace_back(a, b);
    }
  return result;
}

template class BodyBoxes<2>;
template class BodyBoxes<3>;
} // namespace scree
