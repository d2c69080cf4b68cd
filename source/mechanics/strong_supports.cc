#include <scree/base/exceptions.h>
#include <scree/base/joint_sum.h>
#include <scree/mechanics/strong_supports.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree
{
namespace
{
/** Whether two conditions prescribe different values, at one of some times; `length` is that of
 * which displacements are parts. */
template <int dim>
bool
contradict(const BoundaryCondition<dim> &a, const unsigned int value_a,
           const BoundaryCondition<dim> &b, const unsigned int value_b,
           const dealii::Point<dim> &position, const double length)
{
  // sin(pi) is no zero.
  const double rounding = 8. * std::numeric_limits<double>::epsilon() * length;
  for (const double time : {0., 0.37, 1.})
    {
      const double here  = a.value(value_a, position, time);
      const double there = b.value(value_b, position, time);
      if (std::abs(here - there) > 1e-10 * (std::abs(here) + std::abs(there)) + rounding)
        return true;
    }
  return false;
}
} // namespace

template <int dim>
StrongSupports<dim>::StrongSupports(const DisplacementSpace<dim> &space,
                                    const std::vector<Body<dim>> &bodies,
                                    const Kinematics<dim>        &kinematics)
    : kinematics(kinematics)
    , communicator(space.grid.communicator())
{
  std::vector<std::vector<unsigned int>> supports_of_body(bodies.size());
  for (unsigned int b = 0; b < bodies.size(); ++b)
    for (const auto &condition : bodies[b].conditions)
      if (condition.is_strong() || condition.is_at_vertex())
        {
          supports_of_body[b].push_back(supports.size());
          supports.emplace_back(b, &condition);
        }
  std::vector<Selection>                     selections(supports.size());
  std::map<DofIndex, PrescribedUnknown<dim>> found;
  for (unsigned int a = 0; a < space.cells().size(); ++a)
    for (const unsigned int support : supports_of_body[space.cells()[a].body])
      select(space, a, support, selections[support], found);
  require_selections(bodies, selections);
  for (const auto &[index, unknown] : found)
    prescribed.push_back(unknown);
  std::stable_sort(prescribed.begin(), prescribed.end(),
                   [](const auto &a, const auto &b) { return a.support < b.support; });
}

template <int dim>
bool
StrongSupports<dim>::is_prescribed_at(const BoundaryCondition<dim> &condition,
                                      const GridCell<dim>          &cell,
                                      const dealii::Point<dim>     &unit_node,
                                      const dealii::Point<dim>     &reference_position) const
{
  if (condition.is_at_vertex())
    return dealii::Point<dim>(cell.lower + cell.size * dealii::Tensor<1, dim>(unit_node))
             .distance(condition.parameters.point)
           < 1e-6 * cell.size;
  const unsigned int face = condition.box_face;
  return cell.iterator->at_boundary(face) && unit_node[face / 2] == double(face % 2)
         && condition.selects(reference_position);
}

template <int dim>
void
StrongSupports<dim>::select(const DisplacementSpace<dim> &space, const unsigned int a,
                            const unsigned int support, Selection &selection,
                            std::map<DofIndex, PrescribedUnknown<dim>> &found) const
{
  const BoundaryCondition<dim> &condition = *supports[support].second;
  const auto                   &cell      = space.grid.cells()[space.cells()[a].grid_cell];
  for (unsigned int i = 0; i < space.basis.n_nodes; ++i)
    {
      const dealii::Point<dim> unit_node          = space.basis.node(i);
      const dealii::Point<dim> position           = space.position(a, unit_node);
      const dealii::Point<dim> reference_position = kinematics.reference_position({a, unit_node});
      if (!is_prescribed_at(condition, cell, unit_node, reference_position))
        continue;
      ++selection.n_nodes;
      for (unsigned int k = 0; k < condition.components.size(); ++k)
        {
          const unsigned int component = condition.components[k];
          const DofIndex     index     = space.nodes(a)[i] + component;
          if (!space.owned().is_element(index) || space.hanging_constraints().is_constrained(index))
            continue;
          const auto other = found.find(index);
          if (other != found.end() && other->second.support != support)
            {
              selection.n_contradictions += contradict(
                condition, k, *supports[other->second.support].second, other->second.value,
                reference_position, space.grid.box().side_length(component));
              if (other->second.support < support)
                continue;
            }
          found[index] = {index, component, support, k, position, reference_position};
        }
    }
}

template <int dim>
void
StrongSupports<dim>::require_selections(const std::vector<Body<dim>> &bodies,
                                        std::vector<Selection>       &selections) const
{
  JointSum sum;
  for (auto &selection : selections)
    {
      sum.add(selection.n_nodes);
      sum.add(selection.n_contradictions);
    }
  sum.reduce(communicator);
  for (unsigned int s = 0; s < supports.size(); ++s)
    {
      const auto &[body, condition] = supports[s];
      const bool is_point           = condition->is_at_vertex();
      require(selections[s].n_nodes > 0., condition->path,
              is_point
                ? "there is no vertex of the body '" + bodies[body].name + "' at the given point"
                : "the region selects nothing of the body '" + bodies[body].name + "'",
              is_point ? "choose a vertex of a background cell inside the body"
                       : "check On and Where; does the body reach that face of the box?");
      require(selections[s].n_contradictions == 0., condition->path,
              "another condition prescribes other values for the same displacement components",
              "restrict one of them by Where or Components");
    }
}

template <int dim>
void
StrongSupports<dim>::set(Vector &u, const double time) const
{
  for (const auto &unknown : prescribed)
    u(unknown.index) = kinematics.prescribed(*supports[unknown.support].second, unknown, time);
  u.compress(dealii::VectorOperation::insert);
}

template <int dim>
void
StrongSupports<dim>::set_zero(Vector &r) const
{
  for (const auto &unknown : prescribed)
    r(unknown.index) = 0.;
  r.compress(dealii::VectorOperation::insert);
}

template <int dim>
std::vector<Resultant<dim>>
StrongSupports<dim>::resultants(const Vector &forces) const
{
  std::vector<Resultant<dim>> result(supports.size());
  for (const auto &unknown : prescribed)
    {
      dealii::Tensor<1, dim> force;
      force[unknown.component] = forces(unknown.index);
      result[unknown.support].force += force;
      result[unknown.support].moment += moment_of<dim>(unknown.position, force);
    }
  sum_over_processes(result, communicator);
  return result;
}

template class StrongSupports<2>;
template class StrongSupports<3>;
} // namespace scree
