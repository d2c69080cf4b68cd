#include <scree/mechanics/condition_motion.h>
#include <scree/mechanics/equilibrium.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Import.h>
#include <Epetra_Vector.h>
#include <algorithm>
#include <cmath>

namespace scree
{
template <int dim>
Equilibrium<dim>::Equilibrium(const DisplacementSpace<dim> &space,
                              const std::vector<Body<dim>> &bodies,
                              const Kinematics<dim>        &kinematics,
                              const BoundaryTerms<dim> &boundary_terms, ContactPoints<dim> &contact,
                              const std::shared_ptr<const Mass<dim>> &mass, const bool has_inertia)
    : kinematics(kinematics)
    , mass(mass)
    , is_static(!mass || !has_inertia)
    , space(space)
    , bodies(bodies)
    , bulk(kinematics.bulk())
    , boundary_terms(boundary_terms)
    , contact(contact)
    , supports(space, bodies, kinematics)
    , rigid(space, bodies, contact)
    , free(space, bodies, supports, boundary_terms, contact, kinematics.rotations_are_finite(),
           !is_static)
    , holds(free)
    , ledger(space, bodies, kinematics, boundary_terms, contact, supports, rigid)
    , seen_by_bulk(space)
{
  set_up_matrices();
  const MPI_Comm communicator = space.grid.communicator();
  for (Vector *vector : {&loads, &dead_loads, &internal_forces, &contact_forces, &applied_forces,
                         &inertia_forces, &artificial_mass})
    vector->reinit(space.owned(), communicator);
  ghosted.reinit(space.owned(), ghosted_dofs, communicator);
  set_up_artificial_mass();
}

template <int dim>
void
Equilibrium<dim>::make_matrix(const std::vector<std::vector<DofIndex>> &of_contact,
                              Matrix                                   &matrix) const
{
  const MPI_Comm                 communicator = space.grid.communicator();
  dealii::DynamicSparsityPattern pattern(space.n_dofs(), space.n_dofs(), ghosted_dofs);
  for (const auto &nodes : bulk.couplings())
    space.hanging_constraints().add_entries_local_to_global(
      unknowns_of_nodes<dim>(nodes.data(), nodes.size()), pattern, true);
  // Contact stencils have no hanging nodes, but may have nodes that are not relevant here
  // otherwise.
  for (const auto &list : {of_contact, rigid.couplings()})
    for (const auto &unknowns : list)
      for (const DofIndex row : unknowns)
        pattern.add_entries(row, unknowns.begin(), unknowns.end(), true);
  for (const auto &unknowns : boundary_terms.multiplier_couplings())
    space.hanging_constraints().add_entries_local_to_global(unknowns, pattern, true);
  for (const DofIndex index : space.owned())
    pattern.add(index, index);
  dealii::SparsityTools::distribute_sparsity_pattern(pattern, space.owned(), communicator,
                                                     ghosted_dofs);
  matrix.reinit(space.owned(), space.owned(), pattern, communicator, true);
}

template <int dim>
void
Equilibrium<dim>::set_up_matrices()
{
  const MPI_Comm communicator = space.grid.communicator();
  ghosted_dofs                = space.relevant();
  // At once: single lists are inserted in linear time each.
  const auto of_stencils = contact.jump_operator().all_unknowns();
  ghosted_dofs.add_indices(of_stencils.begin(), of_stencils.end());
  ghosted_dofs.compress();
  make_matrix({}, stiffness);

  bulk.add_to_matrix(stiffness);
  stiffness.compress(dealii::VectorOperation::add);
  start_forces.reinit(space.owned(), communicator);
  if (bulk.is_linear())
    stiffness.vmult(start_forces, kinematics.start_displacement());
  else
    bulk.add_start_forces(kinematics.start_displacement_field(), start_forces);
  start_forces.compress(dealii::VectorOperation::add);
  boundary_terms.add_to_matrix(stiffness);
  stiffness.compress(dealii::VectorOperation::add);
  diagonal.reinit(space.owned(), communicator);
  scratch.reinit(space.owned(), communicator);
  for (const DofIndex index : space.owned())
    {
      diagonal(index)   = stiffness.diag_element(index);
      largest_stiffness = std::max(largest_stiffness, std::abs(diagonal(index)));
    }
  diagonal.compress(dealii::VectorOperation::insert);
  largest_stiffness = dealii::Utilities::MPI::max(largest_stiffness, communicator);
}

template <int dim>
void
Equilibrium<dim>::add_volume_forces(Vector &forces) const
{
  bulk.add_body_forces(forces, time);
  if (mass) // Gravity accelerates what has mass.
    mass->add_weight(forces, time);
  else
    bulk.add_weight(forces, time);
}

template <int dim>
void
Equilibrium<dim>::set_time(const double new_time, Vector &u)
{
  time       = new_time;
  is_driven  = true;
  dead_loads = 0.;
  add_volume_forces(dead_loads);
  boundary_terms.add_loads(dead_loads, time, true, false);
  dead_loads.compress(dealii::VectorOperation::add);
  loads = 0.;
  boundary_terms.add_loads(loads, time, false, true);
  loads.compress(dealii::VectorOperation::add);
  loads += dead_loads;
  set_prescribed(u);
}

template <int dim>
bool
Equilibrium<dim>::set_unloaded(Vector &u)
{
  Vector before(u);
  set_time(0., u);
  is_driven = false;
  loads -= dead_loads;
  dead_loads = 0.;
  before -= u;
  return before.linfty_norm() == 0. && loads.linfty_norm() == 0.;
}

template <int dim>
void
Equilibrium<dim>::set_prescribed(Vector &u) const
{
  supports.set(u, time);
  rigid.set(u, time);
}

template <int dim>
void
Equilibrium<dim>::set_zero_on_prescribed(Vector &r) const
{
  supports.set_zero(r);
  for (const DofIndex index : rigid.prescribed())
    r(index) = 0.;
  r.compress(dealii::VectorOperation::insert);
}

template <int dim>
bool
Equilibrium<dim>::has_free_rigid_bodies() const
{
  return std::any_of(free_bodies().begin(), free_bodies().end(),
                     [&](const FreeMotion &motion) { return bodies[motion.body].is_rigid(); });
}

template <int dim>
void
Equilibrium<dim>::residual(const Vector &u, const ContactHistory<dim> &history, Vector &r)
{
  // Contact stencils have no hanging nodes, stresses see them.
  scratch = u;
  space.hanging_constraints().distribute(scratch);
  ghosted = scratch;
  scratch = u;
  scratch.scale(diagonal);
  stiffness_times_displacement = scratch.l2_norm();
  inertia_terms                = has_inertia() ? inertia.size_of_terms() : 0.;
  contact.evaluate(ghosted, history);
  contact_forces = 0.;
  contact.add_to_residual(contact_forces);
  contact_forces.compress(dealii::VectorOperation::add);
  if (is_driven)
    rigid.applied(ghosted, time, applied_forces);
  else
    applied_forces = 0.;
  if (turns_infinitesimally())
    {
      // Contact sees u, the bulk what strains it.
      const Vector v = free.strained(u, ledger.accepted_displacement(), artificial_mass);
      seen_by_bulk.gather(with_ghosts(v));
      stiffness.vmult(internal_forces, v);
    }
  else
    {
      seen_by_bulk.gather(ghosted);
      stiffness.vmult(internal_forces, u);
    }
  internal_forces += start_forces;
  bulk.add_internal_forces(seen_by_bulk, internal_forces);
  boundary_terms.add_internal_forces(seen_by_bulk, time, internal_forces);
  internal_forces.compress(dealii::VectorOperation::add);
  r = loads;
  r -= internal_forces;
  r += contact_forces;
  r += applied_forces;
  if (has_inertia())
    {
      inertia.get_forces(u, ghosted, inertia_forces);
      r += inertia_forces;
      r.add(inertia.contact_weight - 1., contact_forces);
    }
  if (drag != 0.)
    {
      scratch = u;
      scratch -= ledger.accepted_displacement();
      scratch.scale(artificial_mass);
      r.add(-drag, scratch);
    }
  set_zero_where_not_sought(r);
  hold_moments(r);
}

template <int dim>
void
Equilibrium<dim>::set_zero_where_not_sought(Vector &r) const
{
  set_zero_on_prescribed(r);
  for (const auto &line : space.hanging_constraints().get_lines())
    if (space.owned().is_element(line.index))
      r(line.index) = 0.;
  r.compress(dealii::VectorOperation::insert);
}

template <int dim>
void
Equilibrium<dim>::reactions(Vector &result) const
{
  result = internal_forces;
  result -= contact_forces;
  result -= loads;
  result -= applied_forces;
  result -= inertia_forces;
}

template <int dim>
double
Equilibrium<dim>::force_scale() const
{
  Vector all(internal_forces);
  reactions(all);
  double squares = dead_loads.norm_sqr() + contact_forces.norm_sqr() + applied_forces.norm_sqr()
                   + inertia_forces.norm_sqr();
  double held = 0.;
  for (const auto &unknown : supports.unknowns())
    held += all(unknown.index) * all(unknown.index);
  for (unsigned int r = 0; r < boundary_terms.regions().size(); ++r)
    if (const auto &region = boundary_terms.regions()[r];
        region.condition->prescribes_displacement())
      {
        const auto tractions = boundary_terms.tractions(r, seen_by_bulk, time);
        for (unsigned int q = 0; q < tractions.size(); ++q)
          held += std::pow(region.points[q].weight, 2) * tractions[q].norm_square();
      }
  squares += dealii::Utilities::MPI::sum(held, space.grid.communicator());
  return std::sqrt(squares);
}

template <int dim>
double
Equilibrium<dim>::round_off() const
{
  return 1e-15 * (stiffness_times_displacement + inertia_terms)
         + 1e-16 * kinematics.position_scale() * diagonal.l2_norm();
}

template <int dim>
std::vector<typename Equilibrium<dim>::Vector>
Equilibrium<dim>::rigid_motions() const
{
  std::vector<Vector> result = near_null_space(space, bodies);
  for (Vector &motion : result)
    supports.set_zero(motion);
  return result;
}

template <int dim>
std::vector<double>
Equilibrium<dim>::largest_displacements(const Vector &u) const
{
  std::vector<double> result(bodies.size(), 0.);
  for (unsigned int a = 0; a < space.n_owned_cells(); ++a)
    for (unsigned int i = 0; i < space.basis.n_nodes; ++i)
      {
        const DofIndex         node = space.nodes(a)[i];
        dealii::Tensor<1, dim> displacement;
        if (space.owned().is_element(node) && !space.hanging_constraints().is_constrained(node))
          for (unsigned int d = 0; d < dim; ++d)
            displacement[d] = u(node + d);
        double &largest = result[space.cells()[a].body];
        largest         = std::max(largest, displacement.norm());
      }
  dealii::Utilities::MPI::max(result, space.grid.communicator(), result);
  const Vector with_ghost_values = with_ghosts(u);
  for (unsigned int b = 0; b < bodies.size(); ++b)
    if (bodies[b].is_rigid())
      result[b] = rigid.largest_displacement(b, with_ghost_values);
  return result;
}

template <int dim>
typename Equilibrium<dim>::Vector
Equilibrium<dim>::with_ghosts(const Vector &u) const
{
  Vector distributed(u);
  space.hanging_constraints().distribute(distributed);
  Vector result(space.owned(), ghosted_dofs, space.grid.communicator());
  result = distributed;
  return result;
}

template <int dim>
PointEvaluator<dim>
Equilibrium<dim>::at_points(const Vector &u) const
{
  return {space, with_ghosts(u)};
}

template <int dim>
std::vector<Resultant<dim>>
Equilibrium<dim>::resultants(const Vector &u) const
{
  const PointEvaluator<dim>   field  = at_points(u);
  std::vector<Resultant<dim>> result = boundary_terms.resultants(field, time);
  Vector                      forces(internal_forces);
  reactions(forces);
  for (const auto &resultant : supports.resultants(forces))
    result.push_back(resultant);
  const auto displacements = mean_displacements(space, boundary_terms, supports, field);
  for (unsigned int i = 0; i < result.size(); ++i)
    result[i].displacement = displacements[i];
  return result;
}

template <int dim>
std::vector<std::string>
Equilibrium<dim>::condition_names() const
{
  std::vector<std::string> names;
  for (const auto &region : boundary_terms.regions())
    names.push_back(bodies[region.body].name + "." + region.condition->name);
  for (const auto &[body, condition] : supports.conditions())
    names.push_back(bodies[body].name + "." + condition->name);
  return names;
}

template class Equilibrium<2>;
template class Equilibrium<3>;
} // namespace scree
