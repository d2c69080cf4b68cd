#include <scree/base/joint_sum.h>
#include <scree/discretization/own_nodes.h>
#include <scree/mechanics/equilibrium.h>

// The stress of each body by its field and by the forces on it.
namespace scree
{
namespace
{
template <int dim>
void
add_force(const dealii::Tensor<1, dim> &force, const dealii::Point<dim> &place,
          BodyStress<dim> &sum)
{
  sum.force += force;
  sum.virial += outer_product(force, dealii::Tensor<1, dim>(place));
}

/** Adds forces at the nodes of this process; positions x + `motion` u. */
template <int dim>
void
add_nodal_forces(const DisplacementSpace<dim>                &space,
                 const dealii::TrilinosWrappers::MPI::Vector &forces, const PointEvaluator<dim> &u,
                 const double motion, std::vector<BodyStress<dim>> &sums)
{
  for_each_own_node(space, [&](const unsigned int a, const unsigned int i, const DofIndex node) {
    dealii::Tensor<1, dim> force, displacement;
    for (unsigned int d = 0; d < dim; ++d)
      {
        force[d]        = forces(node + d);
        displacement[d] = u.nodal_values(a)[i * dim + d];
      }
    add_force(force, space.position(a, space.basis.node(i)) + motion * displacement,
              sums[space.cells()[a].body]);
  });
}

/** The tractions of a mean support at the points of its region: linear in the position. */
template <int dim>
std::vector<dealii::Tensor<1, dim>>
spread(const BoundaryRegion<dim> &region, const Resultant<dim> &resultant)
{
  const double moment = resultant.moment[2] - moment_of<dim>(region.centre, resultant.force)[2];
  std::vector<dealii::Tensor<1, dim>> tractions;
  for (const auto &point : region.points)
    {
      const dealii::Tensor<1, dim> arm = point.position - region.centre;
      tractions.push_back(resultant.force / region.area);
      tractions.back()[0] -= moment / region.polar_moment * arm[1];
      tractions.back()[1] += moment / region.polar_moment * arm[0];
    }
  return tractions;
}

template <int dim>
void
sum_over_processes(std::vector<BodyStress<dim>> &sums, const MPI_Comm communicator)
{
  JointSum joint;
  for (auto &sum : sums)
    {
      joint.add(sum.integral.volume);
      joint.add(sum.integral.moved_volume);
      for (unsigned int i = 0; i < sum.integral.stress.n_independent_components; ++i)
        joint.add(sum.integral.stress.access_raw_entry(i));
      joint.add(sum.force);
      joint.add(sum.virial);
    }
  joint.reduce(communicator);
}
} // namespace

template <int dim>
std::vector<BodyStress<dim>>
Equilibrium<dim>::body_stresses(const Vector &u) const
{
  const double                 motion       = kinematics.moves_bodies() ? 1. : 0.;
  const PointEvaluator<dim>    displacement = at_points(u);
  const auto                   integrals    = bulk.stress_integrals(seen_by_bulk);
  std::vector<BodyStress<dim>> result(bodies.size());
  for (unsigned int b = 0; b < bodies.size(); ++b)
    result[b].integral = integrals[b];

  Vector at_nodes(contact_forces), held(internal_forces);
  at_nodes = 0.;
  add_volume_forces(at_nodes);
  at_nodes.compress(dealii::VectorOperation::add);
  at_nodes += inertia_forces;
  at_nodes.add(inertia.contact_weight - 1., contact_forces);
  reactions(held);
  held.add(1. - inertia.contact_weight, contact_forces);
  for (const auto &unknown : supports.unknowns())
    at_nodes(unknown.index) += held(unknown.index);
  at_nodes.compress(dealii::VectorOperation::add);
  add_nodal_forces(space, at_nodes, displacement, motion, result);

  const auto resultants = boundary_terms.resultants(seen_by_bulk, time);
  for (unsigned int r = 0; r < boundary_terms.regions().size(); ++r)
    {
      const auto &region    = boundary_terms.regions()[r];
      auto        tractions = boundary_terms.tractions(r, seen_by_bulk, time);
      if (region.condition->n_multipliers() > 0)
        tractions = spread(region, resultants[r]);
      for (unsigned int q = 0; q < tractions.size(); ++q)
        {
          const auto &point = region.points[q];
          add_force(point.weight * tractions[q],
                    point.position + motion * displacement.value(point.in_cell()),
                    result[region.body]);
        }
    }
  sum_over_processes(result, space.grid.communicator());
  return result;
}

template std::vector<BodyStress<2>> Equilibrium<2>::body_stresses(const Vector &) const;
template std::vector<BodyStress<3>> Equilibrium<3>::body_stresses(const Vector &) const;
} // namespace scree
