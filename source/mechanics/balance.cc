#include <scree/base/joint_sum.h>
#include <scree/discretization/own_nodes.h>
#include <scree/mechanics/equilibrium.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

// The balance of each body: what its history tells must add up to zero.
namespace scree
{
namespace
{
using Vector = dealii::TrilinosWrappers::MPI::Vector;

/** Sums over the own nodes of a body, for one reduction: see the functions below. */
template <int dim>
struct NodeSums
{
  double                 n = 0.;
  dealii::Tensor<1, dim> x, u, force; //!< x relative to the centre of the body's box
  dealii::Tensor<2, dim> x_x, u_x;    //!< sums of x x^T and u x^T
  dealii::Tensor<1, 3>   moment;      //!< sum of x cross f about the origin
  double                 scale = 0.;
};

template <int dim>
void
sum_over_processes(std::vector<NodeSums<dim>> &sums, const MPI_Comm communicator)
{
  JointSum joint;
  for (auto &sum : sums)
    {
      joint.add(sum.n);
      joint.add(sum.scale);
      for (auto *vector : {&sum.x, &sum.u, &sum.force})
        joint.add(*vector);
      for (auto *tensor : {&sum.x_x, &sum.u_x})
        joint.add(*tensor);
      joint.add(sum.moment);
    }
  joint.reduce(communicator);
}

/** The sum of (x - mean)(x - mean)^T. */
template <int dim>
dealii::Tensor<2, dim>
spread_of(const NodeSums<dim> &sums)
{
  return sums.x_x - dealii::outer_product(sums.x / sums.n, sums.x);
}

/** |omega| of the u = a + omega cross x that fits best at the nodes. */
template <int dim>
double
rotation_of(const NodeSums<dim> &sums)
{
  const dealii::Tensor<1, dim> mean    = sums.x / sums.n;
  const dealii::Tensor<1, 3>   angular = moment_of<dim>(sums.u_x) - moment_of<dim>(mean, sums.u);
  const dealii::Tensor<2, dim> C       = spread_of(sums);
  if constexpr (dim == 2)
    return std::abs(angular[2]) / trace(C);
  else
    {
      dealii::Tensor<2, dim> inertia = -C;
      for (unsigned int d = 0; d < dim; ++d)
        inertia[d][d] += trace(C);
      return (invert(inertia) * angular).norm();
    }
}

/** |sym G| of the u = a + G x that fits best at the nodes; zero if these are all in a plane. */
template <int dim>
double
strain_of(const NodeSums<dim> &sums)
{
  constexpr double             flat = 1e-6;
  const dealii::Tensor<2, dim> C    = spread_of(sums);
  if (!(determinant(C) > flat * std::pow(trace(C), dim)))
    return 0.;
  const dealii::Tensor<2, dim> G
    = (sums.u_x - dealii::outer_product(sums.u, sums.x / sums.n)) * invert(C);
  return symmetrize(G).norm();
}

/** Of the nodes of each body on this process, with the forces at them. */
template <int dim>
std::vector<NodeSums<dim>>
node_sums(const DisplacementSpace<dim> &space, const std::vector<Body<dim>> &bodies,
          const Vector &u, const Vector &contact_forces, const Vector &body_forces)
{
  std::vector<NodeSums<dim>> sums(bodies.size());
  for_each_own_node(space, [&](const unsigned int a, const unsigned int i, const DofIndex node) {
    const unsigned int           body     = space.cells()[a].body;
    NodeSums<dim>               &sum      = sums[body];
    const dealii::Point<dim>     position = space.position(a, space.basis.node(i));
    const dealii::Tensor<1, dim> x        = position - bodies[body].box.center();
    dealii::Tensor<1, dim>       displacement, contact_force, body_force;
    for (unsigned int d = 0; d < dim; ++d)
      {
        displacement[d]  = u(node + d);
        contact_force[d] = contact_forces(node + d);
        body_force[d]    = body_forces(node + d);
      }
    sum.n += 1.;
    sum.x += x;
    sum.u += displacement;
    sum.x_x += dealii::outer_product(x, x);
    sum.u_x += dealii::outer_product(displacement, x);
    sum.force += contact_force + body_force;
    sum.moment += moment_of<dim>(position, contact_force + body_force);
    sum.scale += contact_force.norm() + body_force.norm();
  });
  return sums;
}

/** @param sum over all processes */
template <int dim>
BodyBalance<dim>
balance_of(const NodeSums<dim> &sum, const Body<dim> &body, const unsigned int number)
{
  const dealii::Tensor<1, dim> mean   = sum.x / sum.n;
  const dealii::Point<dim>     centre = body.box.center() + mean;
  BodyBalance<dim>             result;
  result.body        = number;
  result.force       = sum.force;
  result.moment      = sum.moment - moment_of<dim>(centre, sum.force);
  result.force_scale = sum.scale;
  result.n_nodes     = sum.n;
  result.radius      = std::sqrt(trace(sum.x_x) / sum.n - mean.norm_square());
  result.rotation    = rotation_of(sum);
  result.strain      = strain_of(sum);
  return result;
}
} // namespace

template <int dim>
std::vector<BodyBalance<dim>>
Equilibrium<dim>::balance(const Vector &u) const
{
  Vector body_forces(contact_forces), held(internal_forces);
  body_forces = 0.;
  add_volume_forces(body_forces);
  body_forces.compress(dealii::VectorOperation::add);
  body_forces += inertia_forces;
  body_forces.add(inertia.contact_weight - 1., contact_forces);
  reactions(held);
  held.add(1. - inertia.contact_weight, contact_forces);

  auto sums = node_sums(space, bodies, u, contact_forces, body_forces);
  for (unsigned int r = 0; r < boundary_terms.regions().size(); ++r)
    {
      const auto &region    = boundary_terms.regions()[r];
      const auto  tractions = boundary_terms.tractions(r, seen_by_bulk, time);
      for (unsigned int q = 0; q < tractions.size(); ++q)
        sums[region.body].scale += region.points[q].weight * tractions[q].norm();
    }
  for (const auto &unknown : supports.unknowns())
    sums[supports.conditions()[unknown.support].first].scale += std::abs(held(unknown.index));
  sum_over_processes(sums, space.grid.communicator());

  const auto add = [&](const unsigned int body, const Resultant<dim> &resultant) {
    sums[body].force += resultant.force;
    sums[body].moment += resultant.moment;
  };
  const auto of_regions = boundary_terms.resultants(seen_by_bulk, time);
  for (unsigned int i = 0; i < of_regions.size(); ++i)
    add(boundary_terms.regions()[i].body, of_regions[i]);
  const auto of_supports = supports.resultants(held);
  for (unsigned int i = 0; i < of_supports.size(); ++i)
    add(supports.conditions()[i].first, of_supports[i]);

  const std::vector<double>     largest = largest_displacements(u);
  std::vector<BodyBalance<dim>> result;
  for (unsigned int b = 0; b < bodies.size(); ++b)
    if (!bodies[b].is_rigid() && sums[b].n > 0.)
      {
        result.push_back(balance_of(sums[b], bodies[b], b));
        result.back().largest_u = largest[b];
      }
  return result;
}

template std::vector<BodyBalance<2>> Equilibrium<2>::balance(const Vector &) const;
template std::vector<BodyBalance<3>> Equilibrium<3>::balance(const Vector &) const;
} // namespace scree
