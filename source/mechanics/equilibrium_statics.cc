#include <scree/mechanics/equilibrium.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

// Free bodies: their statics as rigid ones and the artificial mass that holds them.
namespace scree
{
// A body sums the round-off of its nodes; loads below it are none.
constexpr double round_off_of_bodies = 10.;

// The artificial mass of bodies whose moments are held whole: round-off alone turns them.
constexpr double held_mass_factor = 1e-3;

template <int dim>
void
Equilibrium<dim>::set_up_artificial_mass()
{
  std::vector<double> factors(bodies.size(), 0.);
  for (const FreeMotion &free : free_bodies())
    if (!bodies[free.body].is_rigid())
      {
        const double length = RigidMotions<dim>(bodies[free.body]).length();
        factors[free.body]  = bodies[free.body].material->young() / (length * length);
      }
  bulk.add_lumped_volumes(artificial_mass, factors);
  artificial_mass.compress(dealii::VectorOperation::add);
  std::vector<unsigned int> rigid_ones;
  for (const FreeMotion &free : free_bodies())
    if (bodies[free.body].is_rigid())
      rigid_ones.push_back(free.body);
  const std::vector<double> masses = rigid.stiffness_scales(rigid_ones);
  for (unsigned int i = 0; i < rigid_ones.size(); ++i)
    for (unsigned int m = 0; m < n_rigid_components<dim>; ++m)
      if (const DofIndex unknown = space.rigid_unknown(rigid_ones[i]) + m;
          space.owned().is_element(unknown))
        artificial_mass(unknown) = masses[i];
  artificial_mass.compress(dealii::VectorOperation::insert);
}

template <int dim>
void
Equilibrium<dim>::add_artificial_mass(Matrix &matrix) const
{
  for (const DofIndex index : space.owned())
    if (artificial_mass(index) != 0.)
      matrix.add(index, index, (mass_factor + drag) * artificial_mass(index));
  holds.add_to(artificial_mass, matrix);
  for (unsigned int i = 0; i < free_bodies().size(); ++i)
    for (const DofIndex unknown : free.unknowns(i))
      if (are_moments_whole && held_moments[free_bodies()[i].body] != 0.
          && mass_factor < held_mass_factor)
        matrix.add(unknown, unknown, (held_mass_factor - mass_factor) * artificial_mass(unknown));
  // Rows without any other entry.
  for (const DofIndex index : rigid.prescribed())
    matrix.add(index, index, largest_stiffness);
}

template <int dim>
void
Equilibrium<dim>::shorten(Vector &du, const double length) const
{
  if (has_inertia() || free_bodies().empty()) // inertia holds everything
    return;
  const auto   motions = free.of_not_held(free.largest_components(du), length);
  const double largest = *std::max_element(motions.begin(), motions.end());
  if (largest > length)
    du *= length / largest;
}

template <int dim>
bool
Equilibrium<dim>::adapt_holds(const Vector &du, const double length)
{
  return !has_inertia() && holds.adapt(du, length, mass_factor + drag);
}

template <int dim>
BodyHolds<dim> &
Equilibrium<dim>::body_holds()
{
  return holds;
}

template <int dim>
void
Equilibrium<dim>::set_artificial_mass(const double factor)
{
  mass_factor = factor;
}

template <int dim>
bool
Equilibrium<dim>::set_moved(const double new_time, Vector &u)
{
  Vector before(u);
  set_time(ledger.time_of_accepted(), before);
  Vector change(loads);
  change -= dead_loads;
  set_time(new_time, u);
  change -= loads;
  change += dead_loads;
  before -= u;
  return before.linfty_norm() != 0. || change.linfty_norm() != 0.;
}

template <int dim>
void
Equilibrium<dim>::set_drag(const double factor)
{
  drag = factor;
}

template <int dim>
typename Equilibrium<dim>::Vector
Equilibrium<dim>::artificial_forces(const Vector &du) const
{
  Vector result(du);
  result.scale(artificial_mass);
  result *= mass_factor;
  return result;
}

template <int dim>
typename FreeBodies<dim>::Coordinates
Equilibrium<dim>::loads_on_free_bodies() const
{
  Vector forces(internal_forces);
  reactions(forces);
  forces += contact_forces;
  forces *= -1.;
  return free.resultants(forces);
}

template <int dim>
typename FreeBodies<dim>::Coordinates
Equilibrium<dim>::unbalanced_loads() const
{
  const auto loads_on_motions = loads_on_free_bodies();
  double     norm             = 0.;
  for (const double load : loads_on_motions)
    norm += load * load;
  norm = std::sqrt(norm);
  if (norm <= round_off_of_bodies * round_off())
    return std::vector<double>(loads_on_motions.size(), 0.);
  auto result = free.unbalanced(loads_on_motions);
  for (double &part : result)
    part /= norm;
  return result;
}

template <int dim>
std::optional<double>
Equilibrium<dim>::balance_rigid_motions(Vector &u, const ContactHistory<dim> &history,
                                        const bool is_settling) const
{
  if (free_bodies().empty() || has_inertia() || drag != 0.)
    return {};
  const auto forces = loads_on_free_bodies();
  const auto motion
    = free.balancing(forces, history, round_off_of_bodies * round_off(), is_settling);
  if (motion.empty())
    return {};
  free.add(motion, u, turns_infinitesimally());
  return free.work(forces, motion);
}

template <int dim>
void
Equilibrium<dim>::hold_moments(Vector &r)
{
  held_moments.assign(bodies.size(), 0.);
  are_moments_whole = false;
  if (!is_second_attempt || free_bodies().empty())
    return;
  const auto [moments, factor] = free.misplaced_moments(free.resultants(r));
  if (moments.empty())
    return;
  free.subtract(moments, artificial_mass, r);
  are_moments_whole = factor == 1.;
  for (unsigned int i = 0; i < free_bodies().size(); ++i)
    held_moments[free_bodies()[i].body] = free.magnitude(moments, i);
}

template <int dim>
bool
Equilibrium<dim>::is_geometric(const Vector &r, const double tolerance) const
{
  constexpr double accuracy = 1e-4;
  constexpr double far      = 1e-2; // from what such moments can be
  if (free_bodies().empty() || r.l2_norm() > far * force_scale())
    return false;
  const auto [moments, factor] = free.misplaced_moments(free.resultants(r), accuracy);
  if (moments.empty() || factor < 1.)
    return false;
  Vector rest(r);
  free.subtract(moments, artificial_mass, rest);
  return rest.l2_norm() <= tolerance;
}

template <int dim>
void
Equilibrium<dim>::set_second_attempt(const bool is_second)
{
  is_second_attempt = is_second;
}

template <int dim>
double
Equilibrium<dim>::held_moment(const unsigned int body) const
{
  return held_moments[body];
}

template <int dim>
bool
Equilibrium<dim>::turns_infinitesimally() const
{
  return is_second_attempt && kinematics.rotations_are_finite() && !free_bodies().empty();
}

template <int dim>
void
Equilibrium<dim>::advance(const Vector &du, Vector &u) const
{
  if (turns_infinitesimally())
    u += du;
  else
    free.advance(du, artificial_mass, u);
}

template <int dim>
void
Equilibrium<dim>::turn(Vector &u) const
{
  if (!turns_infinitesimally())
    return;
  Vector du(u);
  du -= ledger.accepted_displacement();
  u = ledger.accepted_displacement();
  free.advance(du, artificial_mass, u);
}

#define SCREE_INSTANTIATE(dim)                                                                    \
  template void                     Equilibrium<dim>::shorten(Vector &, const double) const;      \
  template bool                     Equilibrium<dim>::adapt_holds(const Vector &, const double);  \
  template BodyHolds<dim>          &Equilibrium<dim>::body_holds();                               \
  template void                     Equilibrium<dim>::set_artificial_mass(const double);          \
  template void                     Equilibrium<dim>::set_second_attempt(const bool);             \
  template void                     Equilibrium<dim>::set_drag(const double);                     \
  template double                   Equilibrium<dim>::held_moment(const unsigned int) const;      \
  template bool                     Equilibrium<dim>::is_geometric(const Vector &, double) const; \
  template bool                     Equilibrium<dim>::turns_infinitesimally() const;              \
  template bool                     Equilibrium<dim>::set_moved(const double, Vector &);          \
  template void                     Equilibrium<dim>::set_up_artificial_mass();                   \
  template void                     Equilibrium<dim>::advance(const Vector &, Vector &) const;    \
  template void                     Equilibrium<dim>::turn(Vector &) const;                       \
  template Equilibrium<dim>::Vector Equilibrium<dim>::artificial_forces(const Vector &) const;    \
  template std::vector<double>      Equilibrium<dim>::loads_on_free_bodies() const;               \
  template std::vector<double>      Equilibrium<dim>::unbalanced_loads() const;                   \
  template std::optional<double>    Equilibrium<dim>::balance_rigid_motions(                      \
       Vector &, const ContactHistory<dim> &, const bool) const;

template void Equilibrium<2>::add_artificial_mass(Matrix &) const;
template void Equilibrium<3>::add_artificial_mass(Matrix &) const;
template void Equilibrium<2>::hold_moments(Vector &);
template void Equilibrium<3>::hold_moments(Vector &);
SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
