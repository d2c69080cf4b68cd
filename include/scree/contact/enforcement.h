#pragma once

#include <scree/contact/contact_history.h>
#include <scree/contact/contact_response.h>

#include <vector>

namespace scree
{
/** Stiffnesses of a contact point [force/area/L]. */
struct ContactStiffness
{
  double normal, tangential;
};

/**
 * How contact is enforced: which trial tractions gaps and slides cause, what of it is elastic, and
 * whether an equilibrium found with them is the wanted one. Laws limit the tractions, whatever the
 * enforcement. All questions are for many points at once; arrays without numbers are for all of
 * them.
 */
template <int dim>
class Enforcement
{
public:
  /** @param penalties stiffness of the points */
  explicit Enforcement(const std::vector<ContactStiffness> &penalties)
      : penalties(penalties)
  {
  }

  virtual ~Enforcement() = default;

  /** Of closed points that stick. */
  const std::vector<ContactStiffness> &stiffness() const
  {
    return penalties;
  }

  /** p_t and tau_t of the points of these numbers; `history` is that of all points. */
  virtual std::vector<TrialTraction<dim>>
  trial_tractions(const std::vector<unsigned int>       &numbers,
                  const std::vector<ContactMotion<dim>> &motions,
                  const ContactHistory<dim>             &history) const = 0;

  /** The energy that tractions store [force/L per area]. */
  virtual std::vector<double>
  stored_energy(const std::vector<double>                 &pressures,
                const std::vector<dealii::Tensor<1, dim>> &tau) const = 0;

  /** The part of the slides of a step from tau_n to tau that is elastic: no dissipation [L]. */
  virtual std::vector<dealii::Tensor<1, dim>>
  elastic_slides(const std::vector<dealii::Tensor<1, dim>> &old_tau,
                 const std::vector<dealii::Tensor<1, dim>> &tau) const = 0;

  /** Whether an open point, g > 0, may press. */
  virtual bool may_press_apart(const unsigned int) const
  {
    return false;
  }

  /** A step begins, or begins again, from `history` (collective). */
  virtual void start_step(const ContactHistory<dim> &history) = 0;

  /**
   * Updates multipliers in an equilibrium with these responses (collective).
   *
   * @return true if contact is enforced and nothing was changed, else equilibrium is to be found
   * again
   */
  virtual bool update(const std::vector<ContactResponse<dim>> &responses) = 0;

protected:
  std::vector<ContactStiffness> penalties;
};
} // namespace scree
