#include <scree/mechanics/local_error.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace scree
{
namespace
{
constexpr unsigned int n_smoothings = 2;

/** Mean accelerations of the bodies, zero of those without mass (collective). */
template <int dim>
std::vector<dealii::Tensor<1, dim>>
mean_accelerations(const DiscreteProblem<dim>                            &problem,
                   const typename Equilibrium<dim>::Vector               &acceleration,
                   const std::vector<typename RigidMasses<dim>::Vectors> &of_rigid)
{
  const MassPoints<dim> &points = problem.mass->points();
  const auto             values = problem.mass->at_points(acceleration);
  std::vector<double>    sums((dim + 1) * problem.bodies.size()); // of m a, and of m
  for (std::size_t p = 0; p < values.size(); ++p)
    {
      const unsigned int b = problem.space.cells()[points.places[p].active_cell].body;
      for (unsigned int d = 0; d < dim; ++d)
        sums[(dim + 1) * b + d] += points.masses[p] * values[p][d];
      sums[(dim + 1) * b + dim] += points.masses[p];
    }
  dealii::Utilities::MPI::sum(sums, problem.communicator(), sums);
  std::vector<dealii::Tensor<1, dim>> result(problem.bodies.size());
  for (unsigned int b = 0; b < result.size(); ++b)
    for (unsigned int d = 0; d < dim && sums[(dim + 1) * b + dim] > 0.; ++d)
      result[b][d] = sums[(dim + 1) * b + d] / sums[(dim + 1) * b + dim];
  for (unsigned int i = 0; i < of_rigid.size(); ++i)
    for (const auto &a : of_rigid[i])
      result[problem.mass->rigid().bodies()[i].body] += a / double(of_rigid[i].size());
  return result;
}
} // namespace

template <int dim>
std::vector<double>
root_mean_squares(const DiscreteProblem<dim> &problem, const typename Equilibrium<dim>::Vector &u,
                  const typename Equilibrium<dim>::Vector &field)
{
  const Mass<dim>       &mass   = *problem.mass;
  const MassPoints<dim> &points = mass.points();
  const unsigned int     n      = problem.bodies.size();
  const auto             values = mass.at_points(field);
  std::vector<double>    sums(2 * n); // of m |v|^2, and of m
  for (std::size_t p = 0; p < values.size(); ++p)
    {
      const unsigned int b = problem.space.cells()[points.places[p].active_cell].body;
      sums[b] += points.masses[p] * values[p].norm_square();
      sums[n + b] += points.masses[p];
    }
  dealii::Utilities::MPI::sum(sums, problem.communicator(), sums);
  std::vector<double> result(n);
  for (unsigned int b = 0; b < n; ++b)
    result[b] = sums[n + b] > 0. ? std::sqrt(sums[b] / sums[n + b]) : 0.;
  const auto where = mass.with_ghosts(u), v = mass.with_ghosts(field);
  for (const auto &body : mass.rigid().bodies())
    result[body.body] = std::sqrt(
      2. * body.kinetic_energy(mass.pose(body, where), mass.rigid().read(body, v, v)) / body.mass);
  return result;
}

template <int dim>
LocalError<dim>::LocalError(const DiscreteProblem<dim> &problem, const TimeScheme<dim> &scheme,
                            const State<dim> &state)
    : problem(problem)
    , scheme(scheme)
    , state(state)
{
  Vector       r(state.displacement);
  const Rates &rates = state.predictor.rates;
  problem.contact().start_step(state.contact); // An attempt may have changed multipliers.
  problem.equilibrium().residual(state.displacement, state.contact, r);
  at_start        = accelerations(state.displacement, rates);
  rigid_at_start  = of_rigid(state.displacement, rates.velocity, at_start);
  closed_at_start = are_closed();
}

template <int dim>
typename LocalError<dim>::Vector
LocalError<dim>::accelerations(const Vector &u, const Rates &rates) const
{
  Vector result = problem.equilibrium().accelerations_by_contact(u);
  result += rates.acceleration;
  return result;
}

template <int dim>
typename LocalError<dim>::Points
LocalError<dim>::of_rigid(const Vector &u, const Vector &velocity, const Vector &acceleration) const
{
  const Mass<dim> &mass  = *problem.mass;
  const auto       where = mass.with_ghosts(u), v = mass.with_ghosts(velocity),
             a = mass.with_ghosts(acceleration);
  Points result;
  for (const auto &body : mass.rigid().bodies())
    result.push_back(body.accelerations(mass.pose(body, where), mass.rigid().read(body, v, a)));
  return result;
}

template <int dim>
std::vector<bool>
LocalError<dim>::are_closed() const
{
  const ContactPoints<dim> &contact = problem.contact();
  std::vector<double>       closed(contact.pairs().size(), 0.);
  for (unsigned int i = 0; i < contact.points().size(); ++i)
    if (contact.responses()[i].status != ContactStatus::open)
      closed[contact.points()[i].pair] = 1.;
  dealii::Utilities::MPI::max(closed, problem.communicator(), closed);
  std::vector<bool> result;
  for (const double value : closed)
    result.push_back(value > 0.);
  return result;
}

template <int dim>
typename LocalError<dim>::Vector
LocalError<dim>::predicted(const double time) const
{
  Vector       result = state.displacement;
  const double dt     = time - state.time;
  result.add(dt, state.predictor.rates.velocity);
  problem.equilibrium().set_time(time, result);
  return result;
}

template <int dim>
double
LocalError<dim>::largest_motion(const double time) const
{
  const auto motions = problem.equilibrium().largest_displacements(predicted(time));
  return *std::max_element(motions.begin(), motions.end());
}

template <int dim>
Closing
LocalError<dim>::closing(const double time, const double overlap) const
{
  constexpr double    sliver  = 1e-3; // of the surface, which carries nothing
  ContactPoints<dim> &contact = problem.contact();
  std::vector<double> before(contact.points().size());
  contact.evaluate(problem.equilibrium().with_ghosts(state.displacement), state.contact);
  for (unsigned int i = 0; i < before.size(); ++i)
    before[i] = contact.gap(i);
  contact.evaluate(problem.equilibrium().with_ghosts(predicted(time)), state.contact);
  // Accelerations of surfaces are mostly those of waves, which are faster than the step.
  const auto   means = mean_accelerations(problem, at_start, rigid_at_start);
  const double half  = 0.5 * std::pow(time - state.time, 2);
  Closing      result;
  for (unsigned int i = 0; i < before.size(); ++i)
    {
      const ContactPoint<dim> &point = contact.points()[i];
      const ContactPair       &pair  = contact.pairs()[point.pair];
      const double after = contact.gap(i) + half * (point.normal * (means[pair.b] - means[pair.a]));
      if (closed_at_start[point.pair] || after > -overlap || before[i] < 0.
          || point.weight < sliver * std::pow(point.cell_size, dim - 1))
        continue;
      if (const double part = before[i] / (before[i] - after); part < result.part)
        result = {part, point.pair};
    }
  const auto all   = dealii::Utilities::MPI::all_gather(problem.communicator(),
                                                        std::make_pair(result.part, result.pair));
  const auto first = *std::min_element(all.begin(), all.end());
  return {first.first, first.second};
}

template <int dim>
typename LocalError<dim>::Vector
LocalError<dim>::momenta(const Vector &u, const Vector &field) const
{
  const Mass<dim> &mass = *problem.mass;
  Vector           result(field);
  mass.matrix()->vmult(result, field);
  const auto where = mass.with_ghosts(u), v = mass.with_ghosts(field);
  for (const auto &body : mass.rigid().bodies())
    {
      const auto pose = mass.pose(body, where);
      const auto q
        = pose.generalised_force(body.load(body.velocities(pose, mass.rigid().read(body, v, v))));
      mass.rigid().add(body, q, result);
    }
  result.compress(dealii::VectorOperation::add);
  return result;
}

template <int dim>
std::vector<double>
LocalError<dim>::of_bodies(const Vector &u, const Rates &rates, const double time,
                           const Solve &solve) const
{
  const LocalErrorFormula formula = scheme.local_error(time - state.time);
  const Mass<dim>        &mass    = *problem.mass;
  const Vector            at_end  = accelerations(u, rates);
  const Points            rigid   = of_rigid(u, rates.velocity, at_end);
  Vector                  e(at_end), forces(at_end);
  e *= formula.at_end;
  e.add(formula.at_start, at_start);
  mass.matrix()->vmult(forces, e);
  const auto where = mass.with_ghosts(u);
  for (unsigned int i = 0; i < rigid.size(); ++i)
    {
      const auto &body   = mass.rigid().bodies()[i];
      auto        points = rigid[i];
      for (unsigned int p = 0; p < points.size(); ++p)
        points[p] = formula.at_end * points[p] + formula.at_start * rigid_at_start[i][p];
      mass.rigid().add(body, mass.pose(body, where).generalised_force(body.load(points)), forces);
    }
  forces.compress(dealii::VectorOperation::add);
  for (unsigned int n = 0; n < n_smoothings; ++n)
    {
      if (n > 0)
        forces = momenta(u, e);
      forces *= formula.mass_factor;
      problem.equilibrium().set_zero_where_not_sought(forces);
      if (forces.l2_norm() == 0.)
        return std::vector<double>(problem.bodies.size(), 0.);
      e = 0.;
      solve(forces, e);
    }
  return root_mean_squares(problem, u, e);
}

#define SCREE_INSTANTIATE(dim)                                                      \
  template std::vector<double> root_mean_squares(const DiscreteProblem<dim> &,      \
                                                 const Equilibrium<dim>::Vector &,  \
                                                 const Equilibrium<dim>::Vector &); \
  template class LocalError<dim>;

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
