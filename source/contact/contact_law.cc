#include <scree/contact/contact_law.h>

#include <algorithm>

namespace scree
{
const EnumNames<ContactLaw> contact_law_names = {{ContactLaw::none, "none"},
                                                 {ContactLaw::frictionless, "frictionless"},
                                                 {ContactLaw::coulomb, "coulomb"},
                                                 {ContactLaw::stick, "stick"},
                                                 {ContactLaw::tied, "tied"}};

const EnumNames<ContactStatus> contact_status_names
  = {{ContactStatus::open, "open"}, {ContactStatus::stick, "stick"}, {ContactStatus::slip, "slip"}};

template <int dim>
ContactResponse<dim>
contact_response(const ContactLaw law, const double friction_coefficient,
                 const ContactKinematics<dim> &kinematics)
{
  using Vector = dealii::Tensor<1, dim>;
  using Matrix = dealii::Tensor<2, dim>;
  ContactResponse<dim> response;
  if (law == ContactLaw::none)
    return response;

  const Vector &n      = kinematics.normal;
  const double  eps_n  = kinematics.eps_n;
  const double  eps_t  = kinematics.eps_t;
  const double  motion = n * kinematics.jump;
  const double  gap    = kinematics.initial_gap + motion;
  if (law != ContactLaw::tied && gap > kinematics.closing_gap)
    return response;

  const Matrix nn         = outer_product(n, n);
  const Matrix projection = dealii::unit_symmetric_tensor<dim>() - nn;
  response.pressure       = law == ContactLaw::tied ? -eps_n * motion : eps_n * std::max(0., -gap);
  response.status         = ContactStatus::stick;
  response.tangent        = eps_n * nn;
  if (law == ContactLaw::frictionless)
    {
      response.status = ContactStatus::slip;
      return response;
    }

  const Vector trial
    = kinematics.old_tau - eps_t * (projection * (kinematics.jump - kinematics.old_jump));
  const double length = trial.norm();
  const double limit  = friction_coefficient * response.pressure;
  if (law != ContactLaw::coulomb || length <= limit || gap >= 0.)
    {
      // A touching point without pressure holds in the tangent only.
      if (law == ContactLaw::tied || gap < 0.)
        response.tau = trial;
      response.tangent += eps_t * projection;
      return response;
    }
  const Vector direction = trial / length;
  response.status        = ContactStatus::slip;
  response.tau           = limit * direction;
  response.tangent
    += friction_coefficient * eps_n * outer_product(direction, n)
       + (limit / length * eps_t) * (projection - outer_product(direction, direction));
  return response;
}

template ContactResponse<2> contact_response(const ContactLaw, const double,
                                             const ContactKinematics<2> &);
template ContactResponse<3> contact_response(const ContactLaw, const double,
                                             const ContactKinematics<3> &);
} // namespace scree
