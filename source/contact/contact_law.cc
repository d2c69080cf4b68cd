#include <scree/contact/contact_law.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <limits>

namespace scree
{
const EnumNames<ContactLaw> contact_law_names = {{ContactLaw::none, "none"},
                                                 {ContactLaw::frictionless, "frictionless"},
                                                 {ContactLaw::coulomb, "coulomb"},
                                                 {ContactLaw::stick, "stick"},
                                                 {ContactLaw::tied, "tied"}};

const EnumNames<ContactStatus> contact_status_names
  = {{ContactStatus::open, "open"}, {ContactStatus::stick, "stick"}, {ContactStatus::slip, "slip"}};

namespace
{
/**
 * The part of the step's tangential motion during which the point is closed, and its derivative
 * with respect to the gap at the end.
 */
struct ClosedFraction
{
  double value      = 1.;
  double derivative = 0.;
};

ClosedFraction
closed_fraction(const double old_gap, const double gap)
{
  if (old_gap <= 0. || gap >= 0.)
    return {};
  const double approach = old_gap - gap;
  return {-gap / approach, -old_gap / (approach * approach)};
}

/** Friction of a closed point: adds tau and its part of the tangent to the response. */
template <int dim>
void
add_friction(const double limit, const double friction_coefficient,
             const ContactKinematics<dim> &kinematics, const ClosedFraction &closed,
             ContactResponse<dim> &response)
{
  using Vector             = dealii::Tensor<1, dim>;
  using Matrix             = dealii::Tensor<2, dim>;
  const Vector &n          = kinematics.normal;
  const Matrix  projection = Matrix(dealii::unit_symmetric_tensor<dim>()) - outer_product(n, n);
  const Vector  motion     = projection * (kinematics.jump - kinematics.old_jump);
  const Vector  trial      = kinematics.old_tau - kinematics.eps_t * closed.value * motion;
  const Matrix  elastic
    = kinematics.eps_t * (closed.value * projection + closed.derivative * outer_product(motion, n));
  const double length = trial.norm();
  if (length <= limit)
    {
      response.tau = trial;
      response.tangent += elastic;
      response.is_symmetric = closed.derivative == 0.;
      return;
    }
  const Vector direction = trial / length;
  response.status        = ContactStatus::slip;
  response.is_symmetric  = friction_coefficient == 0. && closed.derivative == 0.;
  response.tau           = limit * direction;
  response.slip          = (length - limit) / kinematics.eps_t;
  response.tangent
    += friction_coefficient * kinematics.eps_n * outer_product(direction, n)
       + limit / length * (projection - outer_product(direction, direction)) * elastic;
}
} // namespace

template <int dim>
ContactResponse<dim>
contact_response(const ContactLaw law, const double friction_coefficient,
                 const ContactKinematics<dim> &kinematics)
{
  constexpr double     unlimited = std::numeric_limits<double>::infinity();
  ContactResponse<dim> response;
  if (law == ContactLaw::none)
    return response;

  const dealii::Tensor<1, dim> &n       = kinematics.normal;
  const double                  gap     = kinematics.initial_gap + n * kinematics.jump;
  const double                  old_gap = kinematics.initial_gap + n * kinematics.old_jump;
  if (law == ContactLaw::tied)
    {
      response.pressure = kinematics.old_pressure
                          - kinematics.eps_n * (n * (kinematics.jump - kinematics.old_jump));
      response.status  = ContactStatus::stick;
      response.tangent = kinematics.eps_n * outer_product(n, n);
      add_friction(unlimited, 0., kinematics, {}, response);
      return response;
    }
  if (kinematics.frozen_limit >= 0. && law != ContactLaw::frictionless)
    {
      if (gap >= 0. && kinematics.frozen_limit == 0.)
        return response;
      response.pressure = kinematics.eps_n * std::max(0., -gap);
      response.status   = ContactStatus::stick;
      if (gap < 0.)
        response.tangent = kinematics.eps_n * outer_product(n, n);
      add_friction(kinematics.frozen_limit, 0., kinematics, {kinematics.frozen_closed_part, 0.},
                   response);
      return response;
    }
  if (gap > kinematics.closing_gap)
    return response;

  response.pressure = kinematics.eps_n * std::max(0., -gap);
  response.status   = ContactStatus::stick;
  response.tangent  = kinematics.eps_n * outer_product(n, n);
  if (law == ContactLaw::frictionless)
    response.status = ContactStatus::slip;
  else if (gap >= 0.)
    // A touching point without pressure holds in the tangent only.
    response.tangent
      = kinematics.eps_n * outer_product(n, n)
        + kinematics.eps_t
            * (dealii::Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>()) - outer_product(n, n));
  else
    {
      const ClosedFraction closed = closed_fraction(old_gap, gap);
      response.closed_part        = closed.value;
      add_friction(law == ContactLaw::stick ? unlimited : friction_coefficient * response.pressure,
                   friction_coefficient, kinematics, closed, response);
    }
  return response;
}

template ContactResponse<2> contact_response(const ContactLaw, const double,
                                             const ContactKinematics<2> &);
template ContactResponse<3> contact_response(const ContactLaw, const double,
                                             const ContactKinematics<3> &);
} // namespace scree
