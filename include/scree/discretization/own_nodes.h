#pragma once

#include <scree/discretization/displacement_space.h>

#include <vector>

namespace scree
{
/**
 * Calls act(a, i, node) once for each node of this process that no constraint hangs: node i of the
 * active cell a, whose first unknown is `node`.
 */
template <int dim, typename F>
void
for_each_own_node(const DisplacementSpace<dim> &space, const F &act)
{
  std::vector<bool> is_known(space.owned().n_elements(), false);
  for (unsigned int a = 0; a < space.n_owned_cells(); ++a)
    for (unsigned int i = 0; i < space.basis.n_nodes; ++i)
      {
        const DofIndex node = space.nodes(a)[i];
        if (!space.owned().is_element(node) || space.hanging_constraints().is_constrained(node))
          continue;
        const auto place = space.owned().index_within_set(node);
        if (is_known[place])
          continue;
        is_known[place] = true;
        act(a, i, node);
      }
}
} // namespace scree
