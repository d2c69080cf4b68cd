#include <scree/output/grain_states.h>

#include <limits>
#include <tuple>

namespace scree
{
template <int dim>
std::array<dealii::Tensor<1, 3>, 2>
contact_moments(const ContactPair &pair, const ContactSummary<dim> &summary,
                const std::vector<GrainState<dim>> &grains)
{
  return {
    {moment_of<dim>(grains[pair.a].centroid, summary.force) - moment_of<dim>(summary.virial_a),
     moment_of<dim>(summary.virial_b) - moment_of<dim>(grains[pair.b].centroid, summary.force)}};
}

template <int dim>
dealii::Tensor<1, dim>
branch_vector(const std::vector<Body<dim>> &bodies, const ContactPair &pair,
              const ContactSummary<dim> &summary, const std::vector<GrainState<dim>> &grains)
{
  const auto end = [&](const unsigned int body, const unsigned int other) {
    return bodies[body].is_rigid() && !bodies[other].is_rigid() ? summary.place()
                                                                : grains[body].centroid;
  };
  return end(pair.b, pair.a) - end(pair.a, pair.b);
}

namespace
{
/** Adds a contact to the state of a body, with the forces on it. */
template <int dim>
void
add_contact(const ContactSummary<dim> &summary, const double sign,
            const dealii::Tensor<1, 3> &moment, const dealii::Tensor<2, dim> &virial,
            GrainState<dim> &state, BodyStress<dim> &stress)
{
  state.contact.force += sign * summary.force;
  state.contact.moment += moment;
  state.n_contacts += summary.is_closed();
  stress.force += sign * summary.force;
  stress.virial += sign * virial;
}

template <int dim>
void
set_stresses(const Body<dim> &body, const BodyStress<dim> &stress, GrainState<dim> &state)
{
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  double           volume; // of the configuration of the equations
  if (body.is_rigid())
    {
      state.volume = volume = body.rigid->density > 0. ? body.rigid->moments.volume : none;
      state.stress          = none * dealii::unit_symmetric_tensor<dim>();
    }
  else
    {
      volume                = stress.integral.volume;
      state.volume          = stress.integral.moved_volume;
      state.stress_integral = stress.integral.stress;
      state.stress          = stress.integral.stress / volume;
    }
  state.force_stress
    = symmetrize(stress.virial
                 - outer_product(stress.force, dealii::Tensor<1, dim>(state.centroid)))
      / volume;
}
} // namespace

template <int dim>
std::vector<GrainState<dim>>
grain_states(const std::vector<Body<dim>> &bodies, const std::vector<ContactPair> &pairs,
             const std::vector<ContactSummary<dim>> &summaries,
             const std::vector<MeanMotion<dim>>     &motions,
             const std::vector<BodyStress<dim>> &stresses, const bool geometry_is_moving)
{
  std::vector<GrainState<dim>> result(bodies.size());
  for (unsigned int b = 0; b < bodies.size(); ++b)
    {
      result[b].motion = motions[b];
      result[b].centroid
        = geometry_is_moving ? motions[b].position : motions[b].position - motions[b].displacement;
    }
  auto all = stresses;
  for (unsigned int p = 0; p < pairs.size(); ++p)
    {
      const auto &[a, b]  = std::tie(pairs[p].a, pairs[p].b);
      const auto &summary = summaries[p];
      const auto  moments = contact_moments(pairs[p], summary, result);
      add_contact(summary, -1., moments[0], summary.virial_a, result[a], all[a]);
      add_contact(summary, 1., moments[1], summary.virial_b, result[b], all[b]);
    }
  for (unsigned int b = 0; b < bodies.size(); ++b)
    set_stresses(bodies[b], all[b], result[b]);
  return result;
}

#define SCREE_INSTANTIATE(dim)                                                                                 \
  template struct GrainState<dim>;                                                                             \
  template dealii::Tensor<1, dim>              branch_vector(const std::vector<Body<dim>> &,                   \
                                                             const ContactPair &, const ContactSummary<dim> &, \
                                                             const std::vector<GrainState<dim>> &);            \
  template std::array<dealii::Tensor<1, 3>, 2> contact_moments(                                                \
    const ContactPair &, const ContactSummary<dim> &, const std::vector<GrainState<dim>> &);                   \
  template std::vector<GrainState<dim>> grain_states(                                                          \
    const std::vector<Body<dim>> &, const std::vector<ContactPair> &,                                          \
    const std::vector<ContactSummary<dim>> &, const std::vector<MeanMotion<dim>> &,                            \
    const std::vector<BodyStress<dim>> &, const bool);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
