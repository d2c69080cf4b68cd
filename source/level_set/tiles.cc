#include <scree/level_set/tiles.h>

namespace scree
{
template <int dim>
Tiles<dim>::Tiles(const Node &n_box_nodes)
{
  std::size_t n = 1, n_coarse_nodes = 1;
  for (int d = 0; d < dim; ++d)
    {
      tile_count[d] = (n_box_nodes[d] + edge - 1) / edge;
      n *= tile_count[d];
      n_coarse_nodes *= tile_count[d] + 1;
    }
  stored.assign(n, -1);
  coarse_values.assign(n_coarse_nodes, std::numeric_limits<double>::quiet_NaN());
}

template <int dim>
const typename Tiles<dim>::Node &
Tiles<dim>::n_tiles() const
{
  return tile_count;
}

template <int dim>
typename Tiles<dim>::Node
Tiles<dim>::n_coarse() const
{
  Node result;
  for (int d = 0; d < dim; ++d)
    result[d] = tile_count[d] + 1;
  return result;
}

template <int dim>
std::vector<double> &
Tiles<dim>::coarse()
{
  return coarse_values;
}

template <int dim>
const std::vector<double> &
Tiles<dim>::coarse() const
{
  return coarse_values;
}

template <int dim>
void
Tiles<dim>::store(const Node &tile)
{
  std::size_t number = 0;
  for (int d = dim - 1; d >= 0; --d)
    number = number * tile_count[d] + tile[d];
  stored[number] = static_cast<int>(tile_of.size());
  tile_of.push_back(static_cast<unsigned>(number));
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
double
Tiles<dim>::coarse_value(const Node &node) const
{
  double sum = 0;
  for (int corner = 0; corner < (1 << dim); ++corner)
    {
      double weight = 1;
      Node   at;
      for (int d = 0; d < dim; ++d)
        {
          const int    upper = (corner >> d) & 1;
          const double t     = node[d] % edge / double(edge);
          weight *= upper ? t : 1 - t;
          at[d] = node[d] / edge + upper;
        }
      sum += weight * coarse_at(at);
    }
  return sum;
}

template class Tiles<2>;
template class Tiles<3>;
} // namespace scree
