#include <scree/level_set/pieces.h>

namespace scree
{
template <int dim>
Pieces
negative_pieces(const Lattice<dim> &lattice)
{
  Assert(!lattice.is_tiled(), dealii::ExcMessage("The lattice is not dense."));
  const std::vector<double> &phi = lattice.values();
  Pieces                     result;
  result.of_node.assign(phi.size(), 0);
  std::vector<std::size_t> open;
  const auto               visit = [&](const std::size_t node) {
    if (phi[node] < 0 && result.of_node[node] == 0)
      {
        result.of_node[node] = result.n;
        open.push_back(node);
      }
  };
  for (std::size_t start = 0; start < phi.size(); ++start)
    {
      if (result.of_node[start] != 0 || phi[start] >= 0)
        continue;
      ++result.n;
      visit(start);
      while (!open.empty())
        {
          const std::size_t node = open.back();
          open.pop_back();
          std::size_t stride = 1, rest = node;
          for (unsigned int d = 0; d < dim; ++d)
            {
              const std::size_t n = lattice.n_nodes()[d];
              if (rest % n > 0)
                visit(node - stride);
              if (rest % n + 1 < n)
                visit(node + stride);
              rest /= n;
              stride *= n;
            }
        }
    }
  return result;
}

template Pieces negative_pieces(const Lattice<2> &);
template Pieces negative_pieces(const Lattice<3> &);
} // namespace scree
