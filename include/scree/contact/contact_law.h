#pragma once

#include <scree/base/enum_names.h>

#include <deal.II/base/tensor.h>

namespace scree
{
/** How two bodies resist each other. */
enum class ContactLaw
{
  /** no interaction */
  none,
  /** pressure only */
  frictionless,
  /** Coulomb friction */
  coulomb,
  /** no sliding as long as there is pressure */
  stick,
  /** glued: resists opening and sliding */
  tied
};

/** State of a contact point. */
enum class ContactStatus : unsigned char
{
  open,
  stick,
  slip
};

extern const EnumNames<ContactLaw>    contact_law_names;
extern const EnumNames<ContactStatus> contact_status_names;

/** What a contact law needs to know at a point. */
template <int dim>
struct ContactKinematics
{
  double                 initial_gap;  //!< g_0 [L], negative: overlap
  dealii::Tensor<1, dim> normal;       //!< unit, from a to b
  dealii::Tensor<1, dim> jump;         //!< [[u]] = u_b(x_b) - u_a(x_a) [L]
  dealii::Tensor<1, dim> old_jump;     //!< [[u]] at the start of the step [L]
  dealii::Tensor<1, dim> old_tau;      //!< tangential traction at the start of the step
  double                 old_pressure; //!< pressure at the start of the step, of tied points
  double                 eps_n;        //!< normal penalty [force/area/L]
  double                 eps_t;        //!< tangential penalty [force/area/L]
  double                 closing_gap;  //!< gaps up to this count as closed in the tangent [L]
  /** Bound of the friction in place of mu p if not negative, and f, whatever the gap is. */
  double frozen_limit       = -1.;
  double frozen_closed_part = 1.;
};

/** Tractions of body a on body b and their derivative. */
template <int dim>
struct ContactResponse
{
  double                 pressure = 0.; //!< p, positive in compression
  dealii::Tensor<1, dim> tau;           //!< tangential traction on b
  dealii::Tensor<2, dim> tangent;       //!< -d(p n + tau)/d[[u]] [force/area/L]
  ContactStatus          status       = ContactStatus::open;
  double                 slip         = 0.;   //!< sliding in this step [L]
  bool                   is_symmetric = true; //!< the tangent
  double                 closed_part  = 1.;   //!< f

  /** p n + tau, the traction on b. */
  dealii::Tensor<1, dim> traction(const dealii::Tensor<1, dim> &normal) const
  {
    return pressure * normal + tau;
  }
};

/**
 * Penalty contact with Coulomb friction as perfect plasticity (theory.md section 8; Kikuchi & Oden
 * 1988). With g = g_0 + n.[[u]], p = eps_n <-g>, P = I - n n^T and the trial traction
 * tau_t = tau_n - eps_t f P ([[u]] - [[u]]_n): stick if |tau_t| <= mu p, else tau = mu p s with
 * s = tau_t / |tau_t|. The tangent is consistent:
 *
 *     stick: eps_n n n^T + eps_t P
 *     slip:  eps_n n n^T + mu eps_n s n^T + (mu p / |tau_t|) eps_t (P - s s^T)
 *
 * f is the part of the step during which the point is closed, 1 if it was closed at the start and
 * -g/(g_n - g) if it closes from the gap g_n: motion before the closing causes no friction, so that
 * tau vanishes with p at the edge of a growing contact (its derivative enters the tangent). Tied: p
 * = p_n - eps_n n.([[u]] - [[u]]_n) of either sign and tau = tau_t. Gaps in [0, closing_gap] carry
 * no traction but the tangent of stick: a body that touches without load is held in the first
 * iteration. With a frozen bound and f the tractions have a potential, convex in the jump.
 */
template <int dim>
ContactResponse<dim> contact_response(const ContactLaw law, const double friction_coefficient,
                                      const ContactKinematics<dim> &kinematics);
} // namespace scree
