#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace scree
{
/**
 * Which nodes of a big box are stored: tiles of 8^dim nodes, in the order in which they came. Nodes
 * count from the first one of the box. The last tiles may reach beyond the box.
 */
template <int dim>
class Tiles
{
public:
  using Node = std::array<int, dim>;

  static constexpr int         edge    = 8;                   // nodes of a tile per direction
  static constexpr std::size_t n_nodes = dim == 2 ? 64 : 512; // of a tile
  static constexpr std::size_t absent  = std::numeric_limits<std::size_t>::max();

  /** No tiles, for a box of no nodes. */
  Tiles() = default;

  /** No tile is stored yet. */
  explicit Tiles(const Node &n_box_nodes);

  bool empty() const;

  /** The position of a node in the stored values, `absent` if its tile is not stored. */
  std::size_t position(const Node &node) const;

  /** The node at a position in the stored values. */
  Node node(std::size_t position) const;

  /**
   * Counts that a node of an absent tile is asked for: whether an eighth of the nodes of the tile
   * has been, so that the tile had better be stored.
   */
  bool ask(const Node &node);

  /** Appends the tile of a node to those that are stored. Returns the position of its first node.
   */
  std::size_t store(const Node &node);

private:
  std::size_t tile(const Node &node) const;

  Node                  tile_count{};
  std::vector<int>      state;   // tile -> its number in the order of storage, or -1 - n_asked
  std::vector<unsigned> tile_of; // and back
};

template <int dim>
inline bool
Tiles<dim>::empty() const
{
  return state.empty();
}

template <int dim>
inline std::size_t
Tiles<dim>::position(const Node &node) const
{
  std::size_t tile = 0, within = 0;
  for (int d = dim - 1; d >= 0; --d)
    {
      tile   = tile * tile_count[d] + node[d] / edge;
      within = within * edge + node[d] % edge;
    }
  const int number = state[tile];
  return number < 0 ? absent : number * n_nodes + within;
}
} // namespace scree
