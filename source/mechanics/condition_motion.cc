#include <scree/base/joint_sum.h>
#include <scree/mechanics/condition_motion.h>

#include <cmath>
#include <map>
#include <set>

namespace scree
{
namespace
{
template <int dim>
struct WeightedSum
{
  dealii::Tensor<1, dim> displacement;
  double                 weight = 0.;

  void add(const dealii::Tensor<1, dim> &value, const double w)
  {
    displacement += w * value;
    weight += w;
  }
};

/** A node of some supports: its displacement at the start of the step, and which supports. */
template <int dim>
struct SupportNode
{
  dealii::Tensor<1, dim> before;
  std::set<unsigned int> supports;
};

/** The own nodes of the supports by their first unknown. */
template <int dim>
std::map<DofIndex, SupportNode<dim>>
nodes_of(const StrongSupports<dim> &supports)
{
  std::map<DofIndex, SupportNode<dim>> nodes;
  for (const auto &unknown : supports.unknowns())
    {
      auto &node  = nodes[unknown.index - unknown.component];
      node.before = unknown.position - unknown.reference_position;
      node.supports.insert(unknown.support);
    }
  return nodes;
}
} // namespace

template <int dim>
std::vector<dealii::Tensor<1, dim>>
mean_displacements(const DisplacementSpace<dim> &space, const BoundaryTerms<dim> &terms,
                   const StrongSupports<dim> &supports, const PointEvaluator<dim> &u)
{
  const auto                   &regions = terms.regions();
  std::vector<WeightedSum<dim>> sums(regions.size() + supports.conditions().size());
  for (unsigned int r = 0; r < regions.size(); ++r)
    for (unsigned int q = 0; q < regions[r].points.size(); ++q)
      sums[r].add(terms.displacement_at(regions[r], q, u),
                  regions[r].points[q].weight * regions[r].points[q].area_ratio);

  const auto nodes = nodes_of(supports);
  for (unsigned int a = 0; a < space.cells().size() && !nodes.empty(); ++a)
    {
      const double face = std::pow(space.cell_size(a), dim - 1);
      for (unsigned int i = 0; i < space.basis.n_nodes; ++i)
        {
          const DofIndex first = space.nodes(a)[i];
          const auto     found = nodes.find(first);
          if (found == nodes.end())
            continue;
          dealii::Tensor<1, dim> displacement = found->second.before;
          for (unsigned int d = 0; d < dim; ++d)
            displacement[d] += u.nodal_values(a)[i * dim + d];
          for (const unsigned int support : found->second.supports)
            sums[regions.size() + support].add(displacement, face);
        }
    }

  JointSum sum;
  for (auto &of_condition : sums)
    {
      sum.add(of_condition.displacement);
      sum.add(of_condition.weight);
    }
  sum.reduce(space.grid.communicator());
  std::vector<dealii::Tensor<1, dim>> result;
  result.reserve(sums.size());
  for (const auto &of_condition : sums)
    result.push_back(of_condition.weight > 0. ? of_condition.displacement / of_condition.weight
                                              : dealii::Tensor<1, dim>());
  return result;
}

#define SCREE_INSTANTIATE(dim)                                                               \
  template std::vector<dealii::Tensor<1, dim>> mean_displacements(                           \
    const DisplacementSpace<dim> &, const BoundaryTerms<dim> &, const StrongSupports<dim> &, \
    const PointEvaluator<dim> &);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
