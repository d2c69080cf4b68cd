#pragma once

#include <scree/base/enum_names.h>
#include <scree/contact/contact_law.h>

#include <deal.II/base/tensor.h>

#include <limits>

namespace scree
{
/** State of a contact point. */
enum class ContactStatus : unsigned char
{
  open,
  stick,
  slip
};

extern const EnumNames<ContactStatus> contact_status_names;

/** The part f of a step during which a contact point is closed. */
struct ClosedPart
{
  double value = 1.; //!< f
  double rate  = 0.; //!< df/dg [1/L]
};

/** How the bodies move at a contact point. */
template <int dim>
struct ContactMotion
{
  dealii::Tensor<1, dim> normal;         //!< n, unit, from a to b
  double                 gap       = 0.; //!< g = g_0 + n.[[u]], negative: overlap [L]
  double                 start_gap = 0.; //!< g_n [L]
  double                 opening   = 0.; //!< n.([[u]] - [[u]]_n) [L]
  dealii::Tensor<1, dim> slide;          //!< P ([[u]] - [[u]]_n), P = I - n n^T [L]
  /** f, if something else keeps it; NaN: nothing does. */
  double kept_closed_part = std::numeric_limits<double>::quiet_NaN();
  /** Gaps from 0 up to this hold in the tangent, without traction; negative: none do [L]. */
  double touching_gap = 0.;
  bool   is_glued     = false;

  /** Of [[u]] from g_0, [[u]]_n; glued points are closed all the time. */
  static ContactMotion between(const double initial_gap, const dealii::Tensor<1, dim> &normal,
                               const dealii::Tensor<1, dim> &old_jump,
                               const dealii::Tensor<1, dim> &jump, const bool is_glued);

  /**
   * f = 1 if the point was closed at the start, d/(g_n + d) if it closes from the gap g_n to the
   * depth d = p_t/k_n: motion before the closing causes no friction, so that tau vanishes with p at
   * the edge of a growing contact.
   *
   * @param depth d [L], dd/dg = -1
   */
  ClosedPart closed_part(const double depth) const;
};

/** A traction on b that the law has not limited yet. */
template <int dim>
struct TrialTraction
{
  double                 pressure;             //!< p_t, negative: tension
  dealii::Tensor<1, dim> tau;                  //!< tau_t, tangential
  double                 normal_stiffness;     //!< k_n = -dp_t/dg [force/area/L]
  double                 tangential_stiffness; //!< k_t = -dtau_t/d(f P [[u]]) [force/area/L]
  ClosedPart             closed_part;          //!< f
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
 * Returns the trial tractions of points of one pair to what its law admits (theory.md section 8;
 * Kikuchi & Oden 1988): p = <p_t>, or p_t of glued points; stick if |tau_t| <= b, else tau = b s
 * with s = tau_t / |tau_t|, as perfect plasticity with the bound b(p). With k_n, k_t the
 * stiffnesses of the trial tractions the tangent is consistent:
 *
 *     stick: k_n n n^T + k_t T,    T = f P + df/dg slide n^T
 *     slip:  k_n n n^T + db/dp k_n s n^T + (b / |tau_t|) k_t (P - s s^T) T
 *
 * Touching points, whose p_t is as of gaps in [0, touching_gap], carry no traction but the tangent
 * of stick: a body that touches without load is held in the first iteration.
 *
 * @param bounds b of each point; not read for laws without friction
 * @param responses open ones, in which those of closed points are written
 */
template <int dim>
void return_to_admissible(const ContactLaw                                  &law,
                          const dealii::ArrayView<const ContactMotion<dim>> &motions,
                          const dealii::ArrayView<const TrialTraction<dim>> &trials,
                          const dealii::ArrayView<const FrictionBound>      &bounds,
                          const dealii::ArrayView<ContactResponse<dim>>     &responses);
} // namespace scree
