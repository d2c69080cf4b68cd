#include <scree/contact/contact_response.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <cmath>

namespace scree
{
const EnumNames<ContactStatus> contact_status_names
  = {{ContactStatus::open, "open"}, {ContactStatus::stick, "stick"}, {ContactStatus::slip, "slip"}};

template <int dim>
ContactMotion<dim>
ContactMotion<dim>::between(const double initial_gap, const dealii::Tensor<1, dim> &normal,
                            const dealii::Tensor<1, dim> &old_jump,
                            const dealii::Tensor<1, dim> &jump, const bool is_glued)
{
  const dealii::Tensor<1, dim> increment = jump - old_jump;
  ContactMotion                motion;
  motion.normal  = normal;
  motion.gap     = initial_gap + normal * jump;
  motion.opening = normal * increment;
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = 0; j < dim; ++j)
      motion.slide[i] += ((i == j ? 1. : 0.) - normal[i] * normal[j]) * increment[j];
  motion.is_glued  = is_glued;
  motion.start_gap = initial_gap + normal * old_jump;
  return motion;
}

template <int dim>
ClosedPart
ContactMotion<dim>::closed_part(const double depth) const
{
  if (!std::isnan(kept_closed_part))
    return {kept_closed_part, 0.};
  if (is_glued || !(start_gap > 0. && depth > 0.))
    return {};
  const double approach = start_gap + depth;
  return {depth / approach, -start_gap / (approach * approach)};
}

namespace
{
template <int dim>
dealii::Tensor<2, dim>
tangential_projection(const dealii::Tensor<1, dim> &n)
{
  return dealii::Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>()) - outer_product(n, n);
}

/** Adds tau and its part of the tangent to the response. */
template <int dim>
void
add_friction(const FrictionBound &bound, const ContactMotion<dim> &motion,
             const TrialTraction<dim> &trial, ContactResponse<dim> &response)
{
  const dealii::Tensor<1, dim> &n          = motion.normal;
  const dealii::Tensor<2, dim>  projection = tangential_projection(n);
  const auto [f, df_by_dg]                 = trial.closed_part;
  const dealii::Tensor<2, dim> elastic
    = trial.tangential_stiffness * (f * projection + df_by_dg * outer_product(motion.slide, n));
  const double length  = trial.tau.norm();
  response.closed_part = f;
  if (length <= bound.value)
    {
      response.status       = ContactStatus::stick;
      response.tau          = trial.tau;
      response.is_symmetric = df_by_dg == 0.;
      response.tangent += elastic;
      return;
    }
  const dealii::Tensor<1, dim> direction = trial.tau / length;
  response.status                        = ContactStatus::slip;
  response.tau                           = bound.value * direction;
  response.slip                          = (length - bound.value) / trial.tangential_stiffness;
  response.is_symmetric                  = bound.by_pressure == 0. && df_by_dg == 0.;
  response.tangent
    += bound.by_pressure * trial.normal_stiffness * outer_product(direction, n)
       + bound.value / length * (projection - outer_product(direction, direction)) * elastic;
}

template <int dim>
void
respond(const FrictionBound *bound, const ContactMotion<dim> &motion,
        const TrialTraction<dim> &trial, ContactResponse<dim> &response)
{
  const dealii::Tensor<1, dim> &n          = motion.normal;
  const bool                    is_pressed = motion.is_glued || !(trial.pressure <= 0.);
  const bool                    is_held    = is_pressed || (bound && bound->value > 0.);
  const bool touches = !is_held && trial.pressure >= -trial.normal_stiffness * motion.touching_gap;
  if (!is_held && !touches)
    return;
  if (is_pressed || touches)
    response.tangent = trial.normal_stiffness * outer_product(n, n);
  if (is_pressed)
    response.pressure = trial.pressure;
  response.status = bound ? ContactStatus::stick : ContactStatus::slip;
  if (bound && touches)
    response.tangent += trial.tangential_stiffness * tangential_projection(n);
  if (bound && !touches)
    add_friction(*bound, motion, trial, response);
}
} // namespace

template <int dim>
void
return_to_admissible(const ContactLaw                                  &law,
                     const dealii::ArrayView<const ContactMotion<dim>> &motions,
                     const dealii::ArrayView<const TrialTraction<dim>> &trials,
                     const dealii::ArrayView<const FrictionBound>      &bounds,
                     const dealii::ArrayView<ContactResponse<dim>>     &responses)
{
  for (std::size_t i = 0; i < motions.size(); ++i)
    if (law.acts && (motions[i].is_glued || !law.glues))
      respond(law.bound ? &bounds[i] : nullptr, motions[i], trials[i], responses[i]);
}

#define SCREE_INSTANTIATE(dim)                                                            \
  template struct ContactMotion<dim>;                                                     \
  template void return_to_admissible(const ContactLaw &,                                  \
                                     const dealii::ArrayView<const ContactMotion<dim>> &, \
                                     const dealii::ArrayView<const TrialTraction<dim>> &, \
                                     const dealii::ArrayView<const FrictionBound> &,      \
                                     const dealii::ArrayView<ContactResponse<dim>> &);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
