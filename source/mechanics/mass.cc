#include <scree/base/exceptions.h>
#include <scree/base/joint_sum.h>
#include <scree/mechanics/added_spin.h>
#include <scree/mechanics/mass.h>
#include <scree/mechanics/resultant.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/sparsity_tools.h>
#include <deal.II/lac/trilinos_precondition.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace scree
{
namespace
{
/** A matrix or a preconditioner on the vectors that are zero where something sets them so. */
template <typename Operator>
struct Restricted
{
  using Vector = dealii::TrilinosWrappers::MPI::Vector;

  void vmult(Vector &result, const Vector &v) const
  {
    whole.vmult(result, v);
    if (set_zero)
      set_zero(result);
  }

  const Operator                      &whole;
  const std::function<void(Vector &)> &set_zero;
};

/** Puts the row sums of a matrix on its diagonal; zero where there is hardly any mass. */
template <typename Matrix>
void
lump(Matrix &matrix, const dealii::IndexSet &owned, const MPI_Comm communicator)
{
  dealii::TrilinosWrappers::MPI::Vector ones(owned, communicator), sums(ones);
  ones = 1.;
  matrix.vmult(sums, ones);
  matrix                  = 0.;
  const double negligible = 1e-10 * sums.linfty_norm();
  for (const DofIndex index : owned)
    matrix.set(index, index, sums(index) > negligible ? sums(index) : 0.);
  matrix.compress(dealii::VectorOperation::insert);
}
} // namespace

template <int dim>
Mass<dim>::Mass(const DisplacementSpace<dim> &space, const std::vector<Body<dim>> &bodies,
                const SmallCutTreatment<dim> &small_cuts, MassPoints<dim> points,
                const double jump_share, const bool is_lumped)
    : space(space)
    , bodies(bodies)
    , mass_points(std::move(points))
    , rigid_masses(space, bodies)
{
  require_densities();
  set_up_matrix(small_cuts, jump_share, is_lumped);
}

template <int dim>
void
Mass<dim>::require_densities() const
{
  for (const auto &body : bodies)
    require(body.density > 0. || (body.is_rigid() && !body.rigid->is_free()), body.path,
            "the body '" + body.name + "' has no mass, which its inertia needs",
            "set Density in the section of its material, or Time/Scheme = quasi-static");
}

template <int dim>
void
Mass<dim>::set_up_matrix(const SmallCutTreatment<dim> &small_cuts, const double jump_share,
                         const bool is_lumped)
{
  const MPI_Comm                     communicator = space.grid.communicator();
  std::vector<std::vector<DofIndex>> couplings    = small_cuts.couplings();
  // Points may lie beyond the owned cells, see locate_points().
  for (unsigned int a = 0; a < space.cells().size(); ++a)
    couplings.emplace_back(space.nodes(a), space.nodes(a) + space.basis.n_nodes);
  dealii::DynamicSparsityPattern pattern(space.n_dofs(), space.n_dofs(), space.relevant());
  for (const auto &nodes : couplings)
    space.hanging_constraints().add_entries_local_to_global(
      unknowns_of_nodes<dim>(nodes.data(), nodes.size()), pattern, true);
  for (const DofIndex index : space.owned())
    pattern.add(index, index);
  dealii::SparsityTools::distribute_sparsity_pattern(pattern, space.owned(), communicator,
                                                     space.relevant());
  const auto matrix = std::make_shared<Matrix>();
  matrix->reinit(space.owned(), space.owned(), pattern, communicator, true);
  add_points(*matrix);
  if (!is_lumped)
    add_jumps(small_cuts, jump_share, *matrix);
  matrix->compress(dealii::VectorOperation::add);
  if (is_lumped)
    lump(*matrix, space.owned(), communicator);
  mass_matrix = matrix;
}

template <int dim>
void
Mass<dim>::add_jumps(const SmallCutTreatment<dim> &small_cuts, const double jump_share,
                     Matrix &matrix) const
{
  // gamma_m rho h^2 instead of gamma E: h of the cells by the ratios.
  CutStiffness stiffness;
  for (const auto &body : bodies)
    stiffness.of_bodies.push_back(body.is_rigid() ? 0. : body.density);
  for (unsigned int a = 0; a < space.cells().size(); ++a)
    stiffness.ratios.push_back(jump_share * std::pow(space.cell_size(a), 2));
  small_cuts.add_to_matrix(stiffness, matrix);
}

template <int dim>
void
Mass<dim>::add_points(Matrix &matrix) const
{
  // One block of the matrix per cell.
  std::vector<std::size_t> order(mass_points.places.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](const std::size_t i, const std::size_t j) {
    return mass_points.places[i].active_cell < mass_points.places[j].active_cell;
  });
  const unsigned int                          n = space.basis.n_nodes;
  std::array<double, max_nodes_per_cell<dim>> shape;
  dealii::FullMatrix<double>                  block(n * dim, n * dim);
  for (std::size_t i = 0; i < order.size();)
    {
      const unsigned int cell = mass_points.places[order[i]].active_cell;
      block                   = 0.;
      for (; i < order.size() && mass_points.places[order[i]].active_cell == cell; ++i)
        {
          const double mass = mass_points.masses[order[i]];
          space.basis.evaluate_values(mass_points.places[order[i]].unit_point, shape.data());
          for (unsigned int a = 0; a < n; ++a)
            for (unsigned int b = 0; b < n; ++b)
              for (unsigned int d = 0; d < dim; ++d)
                block(a * dim + d, b * dim + d) += mass * shape[a] * shape[b];
        }
      space.hanging_constraints().distribute_local_to_global(
        block, unknowns_of_nodes<dim>(space.nodes(cell), n), matrix);
    }
}

template <int dim>
typename Mass<dim>::Vector
Mass<dim>::forces(const Vectors &values) const
{
  Vector                                      result(space.owned(), space.grid.communicator());
  const unsigned int                          n = space.basis.n_nodes;
  std::array<double, max_nodes_per_cell<dim>> shape;
  dealii::Vector<double>                      load(n * dim);
  for (std::size_t p = 0; p < mass_points.places.size(); ++p)
    {
      const auto &[cell, unit_point] = mass_points.places[p];
      space.basis.evaluate_values(unit_point, shape.data());
      for (unsigned int a = 0; a < n; ++a)
        for (unsigned int d = 0; d < dim; ++d)
          load(a * dim + d) = mass_points.masses[p] * shape[a] * values[p][d];
      space.hanging_constraints().distribute_local_to_global(
        load, unknowns_of_nodes<dim>(space.nodes(cell), n), result);
    }
  result.compress(dealii::VectorOperation::add);
  return result;
}

template <int dim>
void
Mass<dim>::add_weight(Vector &loads, const double time) const
{
  Vectors gravities;
  for (const auto &place : mass_points.places)
    gravities.push_back(bodies[space.cells()[place.active_cell].body].gravity.vector({}, time));
  loads.compress(dealii::VectorOperation::add);
  loads += forces(gravities);
}

template <int dim>
typename Mass<dim>::Vector
Mass<dim>::solve(const Vector &right_side, const std::function<void(Vector &)> &set_zero) const
{
  Vector result(space.owned(), space.grid.communicator()), forces(right_side);
  for (const DofIndex row : space.owned())
    if (mass_matrix->diag_element(row) == 0.)
      forces(row) = 0.;
  forces.compress(dealii::VectorOperation::insert);
  const double norm = forces.l2_norm();
  if (norm == 0.)
    return result;
  // Of the rows without mass.
  constexpr double                           no_mass = 1e-200;
  dealii::TrilinosWrappers::PreconditionSSOR preconditioner;
  preconditioner.initialize(*mass_matrix, {1., no_mass, 0});
  dealii::SolverControl    control(1000, 1e-14 * norm, false, false);
  dealii::SolverCG<Vector> solver(control);
  try
    {
      solver.solve(
        Restricted<Matrix>{*mass_matrix, set_zero}, result, forces,
        Restricted<dealii::TrilinosWrappers::PreconditionSSOR>{preconditioner, set_zero});
    }
  catch (const dealii::SolverControl::NoConvergence &failure)
    {
      // Round-off may end the iteration just above the tolerance.
      require(
        failure.last_residual < 1e-10 * norm, "Bodies",
        "velocities cannot be fitted to the material points: a body has moved to where it has "
        "none",
        "hold motions normal to the faces of the background box, or let bodies end inside it");
    }
  return result;
}

template <int dim>
typename Mass<dim>::Vector
Mass<dim>::with_ghosts(const Vector &v) const
{
  Vector distributed(v);
  space.hanging_constraints().distribute(distributed);
  dealii::IndexSet ghosts = space.relevant();
  ghosts.add_range(space.n_dofs() - space.n_trailing(), space.n_dofs());
  Vector result(space.owned(), ghosts, space.grid.communicator());
  result = distributed;
  return result;
}

template <int dim>
PointEvaluator<dim>
Mass<dim>::field(const Vector &v) const
{
  return {space, with_ghosts(v)};
}

template <int dim>
typename Mass<dim>::Vectors
Mass<dim>::at_points(const Vector &v) const
{
  const PointEvaluator<dim> values = field(v);
  Vectors                   result;
  result.reserve(mass_points.places.size());
  for (const auto &place : mass_points.places)
    result.push_back(values.value(place));
  return result;
}

template <int dim>
void
Mass<dim>::set_accelerations(const Vector &u, const Vector &r,
                             const std::function<void(Vector &)> &set_zero, Rates &rates) const
{
  rates.acceleration = solve(r, set_zero);
  const Vector where = with_ghosts(u), v = with_ghosts(rates.velocity), forces = with_ghosts(r);
  for (const auto &body : rigid_masses.bodies())
    rigid_masses.write(body,
                       body.accelerated(pose(body, where), rigid_masses.read(body, v, v),
                                        rigid_unknowns(space, body.body, forces)),
                       rates.velocity, rates.acceleration);
  for (Vector *vector : {&rates.velocity, &rates.acceleration})
    vector->compress(dealii::VectorOperation::insert);
}

template <int dim>
typename Mass<dim>::Vectors
Mass<dim>::initial_velocities() const
{
  std::vector<double>                 masses(bodies.size(), 0.);
  std::vector<dealii::Tensor<1, dim>> centres(bodies.size());
  for (std::size_t p = 0; p < mass_points.places.size(); ++p)
    {
      const unsigned int b = space.cells()[mass_points.places[p].active_cell].body;
      masses[b] += mass_points.masses[p];
      centres[b] += mass_points.masses[p] * mass_points.positions[p];
    }
  JointSum sum;
  for (unsigned int b = 0; b < bodies.size(); ++b)
    {
      sum.add(masses[b]);
      sum.add(centres[b]);
    }
  sum.reduce(space.grid.communicator());
  Vectors result;
  for (std::size_t p = 0; p < mass_points.places.size(); ++p)
    {
      const unsigned int b   = space.cells()[mass_points.places[p].active_cell].body;
      const auto         arm = mass_points.positions[p] - centres[b] / masses[b];
      result.push_back(bodies[b].initial_velocity.vector(mass_points.positions[p])
                       + turned<dim>(bodies[b].initial_spin, arm));
    }
  return result;
}

template <int dim>
void
Mass<dim>::set_initial_motion(Rates &rates) const
{
  for (const auto &body : rigid_masses.bodies())
    {
      const auto     &definition = bodies[body.body];
      RigidRates<dim> motion;
      motion.spin = definition.initial_spin;
      motion.velocity
        = definition.initial_velocity.vector(body.rigid->moments.centre)
          + turned<dim>(motion.spin, body.rigid->reference_point - body.rigid->moments.centre);
      rigid_masses.write(body, motion, rates.velocity, rates.acceleration);
    }
  for (Vector *vector : {&rates.velocity, &rates.acceleration})
    vector->compress(dealii::VectorOperation::insert);
}

template <int dim>
RigidPose<dim>
Mass<dim>::pose(const typename RigidMasses<dim>::OfBody &body, const Vector &ghosted) const
{
  return {*body.rigid, rigid_unknowns(space, body.body, ghosted)};
}

template <int dim>
double
Mass<dim>::kinetic_energy(const Vector &u, const Rates &rates) const
{
  Vector momentum(rates.velocity);
  mass_matrix->vmult(momentum, rates.velocity);
  double       result = 0.5 * (momentum * rates.velocity);
  const Vector where = with_ghosts(u), v = with_ghosts(rates.velocity),
               a = with_ghosts(rates.acceleration);
  for (const auto &body : rigid_masses.bodies())
    result += body.kinetic_energy(pose(body, where), rigid_masses.read(body, v, a));
  return result;
}

template <int dim>
std::vector<Momentum<dim>>
Mass<dim>::momenta(const Vector &u, const Rates &rates, const Vectors &motion,
                   const Vectors &velocities) const
{
  std::vector<Momentum<dim>> result(bodies.size());
  for (std::size_t p = 0; p < mass_points.places.size(); ++p)
    {
      auto &of_body = result[space.cells()[mass_points.places[p].active_cell].body];
      const dealii::Tensor<1, dim> mv = mass_points.masses[p] * velocities[p];
      of_body.linear += mv;
      of_body.angular += moment_of<dim>(mass_points.positions[p] + motion[p], mv);
    }
  JointSum sum;
  for (auto &of_body : result)
    {
      sum.add(of_body.linear);
      sum.add(of_body.angular);
    }
  sum.reduce(space.grid.communicator());
  const Vector where = with_ghosts(u), v = with_ghosts(rates.velocity),
               a = with_ghosts(rates.acceleration);
  for (const auto &body : rigid_masses.bodies())
    result[body.body] = body.momentum(pose(body, where), rigid_masses.read(body, v, a));
  return result;
}

template <int dim>
void
Mass<dim>::take_off_spins(const std::vector<bool> &of_bodies, const Vector &d, const Vector &w,
                          Vector &velocity) const
{
  if (std::count(of_bodies.begin(), of_bodies.end(), true) == 0)
    return;
  std::vector<AddedSpin<dim>> spins(bodies.size());
  const Vectors               motions = at_points(d), impulses = at_points(w);
  for (std::size_t p = 0; p < mass_points.places.size(); ++p)
    spins[space.cells()[mass_points.places[p].active_cell].body].add(
      mass_points.masses[p], mass_points.positions[p] + motions[p], motions[p], impulses[p]);
  JointSum sum;
  for (auto &spin : spins)
    spin.add_to(sum);
  sum.reduce(space.grid.communicator());
  for (auto &spin : spins)
    spin.finish();
  Vector       change(space.owned(), space.grid.communicator());
  const Vector moved = with_ghosts(d);
  for (unsigned int a = 0; a < space.cells().size(); ++a)
    for (unsigned int i = 0; i < space.basis.n_nodes && of_bodies[space.cells()[a].body]; ++i)
      {
        const DofIndex node = space.nodes(a)[i];
        if (!space.owned().is_element(node))
          continue;
        dealii::Point<dim> x = space.position(a, space.basis.node(i));
        for (unsigned int k = 0; k < dim; ++k)
          x[k] += moved(node + k);
        const dealii::Tensor<1, dim> v = spins[space.cells()[a].body].velocity(x);
        for (unsigned int k = 0; k < dim; ++k)
          change(node + k) = v[k];
      }
  change.compress(dealii::VectorOperation::insert);
  space.hanging_constraints().set_zero(change);
  velocity -= change;
}

template class Mass<2>;
template class Mass<3>;
} // namespace scree
