#include <scree/mechanics/cut_cell_rule.h>

#include <cmath>

namespace scree
{
template <int dim>
CellRule<dim>
cut_cell_rule(const DisplacementSpace<dim> &space, const CutQuadrature<dim> &quadrature,
              const unsigned int active_cell)
{
  const ActiveCell &cell = space.cells()[active_cell];
  if (!cell.is_cut)
    return {quadrature.whole_cell.points.data(), quadrature.whole_cell.weights.data(),
            static_cast<unsigned int>(quadrature.whole_cell.points.size()),
            std::pow(space.cell_size(active_cell), dim)};
  const unsigned int begin = quadrature.bulk.begin[active_cell];
  return {quadrature.bulk.points.data() + begin, quadrature.bulk.weights.data() + begin,
          quadrature.bulk.begin[active_cell + 1] - begin, 1.};
}

#define SCREE_INSTANTIATE(dim)                                                                     \
  template CellRule<dim> cut_cell_rule(const DisplacementSpace<dim> &, const CutQuadrature<dim> &, \
                                       const unsigned int);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
