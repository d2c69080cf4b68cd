#include <scree/level_set/tiles.h>

namespace scree
{
template <int dim>
Tiles<dim>::Tiles(const Node &n_box_nodes)
{
  std::size_t n = 1;
  for (int d = 0; d < dim; ++d)
    {
      tile_count[d] = (n_box_nodes[d] + edge - 1) / edge;
      n *= tile_count[d];
    }
  state.assign(n, -1);
}

template <int dim>
std::size_t
Tiles<dim>::tile(const Node &node) const
{
  std::size_t result = 0;
  for (int d = dim - 1; d >= 0; --d)
    result = result * tile_count[d] + node[d] / edge;
  return result;
}

template <int dim>
typename Tiles<dim>::Node
Tiles<dim>::node(const std::size_t position) const
{
  Node        result;
  std::size_t tile = tile_of[position / n_nodes], within = position % n_nodes;
  for (int d = 0; d < dim; ++d)
    {
      result[d] = static_cast<int>(tile % tile_count[d] * edge + within % edge);
      tile /= tile_count[d];
      within /= edge;
    }
  return result;
}

template <int dim>
bool
Tiles<dim>::ask(const Node &node)
{
  constexpr int enough  = n_nodes / 8;
  int          &n_asked = state[tile(node)];
  --n_asked;
  return n_asked < -enough;
}

template <int dim>
std::size_t
Tiles<dim>::store(const Node &node)
{
  const std::size_t number = tile(node);
  state[number]            = static_cast<int>(tile_of.size());
  tile_of.push_back(static_cast<unsigned>(number));
  return state[number] * n_nodes;
}

template class Tiles<2>;
template class Tiles<3>;
} // namespace scree
