#include <scree/level_set/pieces.h>

#include <algorithm>
#include <cmath>

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

template <int dim>
unsigned int
remove_islands(Lattice<dim> &lattice, const std::vector<double> &old,
               const std::vector<char> &known, const NodalVectors<dim> &du)
{
  const Pieces pieces = negative_pieces(lattice);
  if (pieces.n <= 1)
    return 0;
  std::vector<char> has_material(pieces.n + 1, 0);
  for (std::size_t i = 0; i < known.size(); ++i)
    {
      if (!known[i] || old[i] >= 0.)
        continue;
      typename Lattice<dim>::Index below = lattice.index(i);
      for (unsigned int d = 0; d < dim; ++d)
        below[d] += static_cast<int>(std::floor(du[d][i] / lattice.spacing()));
      for (unsigned int corner = 0; corner < (1u << dim); ++corner)
        {
          typename Lattice<dim>::Index node = below;
          for (unsigned int d = 0; d < dim; ++d)
            node[d] += corner >> d & 1u;
          if (lattice.contains(node))
            has_material[pieces.of_node[lattice.offset(node)]] = 1;
        }
    }
  for (std::size_t i = 0; i < pieces.of_node.size(); ++i)
    if (pieces.of_node[i] > 0 && !has_material[pieces.of_node[i]])
      lattice.values()[i] = 0.5 * lattice.spacing();
  return std::count(has_material.begin() + 1, has_material.end(), 0);
}

template Pieces negative_pieces(const Lattice<2> &);
template Pieces negative_pieces(const Lattice<3> &);

template unsigned int remove_islands<2>(Lattice<2> &, const std::vector<double> &,
                                        const std::vector<char> &, const NodalVectors<2> &);
template unsigned int remove_islands<3>(Lattice<3> &, const std::vector<double> &,
                                        const std::vector<char> &, const NodalVectors<3> &);
} // namespace scree
