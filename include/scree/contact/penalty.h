#pragma once

#include <scree/contact/enforcement.h>

namespace scree
{
/**
 * Penalties eps_n, eps_t: springs between the bodies (theory.md section 8),
 *
 *     p_t = -eps_n g, of glued points p_n - eps_n n.([[u]] - [[u]]_n),
 *     tau_t = tau_n - eps_t f P ([[u]] - [[u]]_n),
 *
 * with the energy p^2/(2 eps_n) + |tau|^2/(2 eps_t). Bodies overlap by p/eps_n; that is final.
 */
template <int dim>
class Penalty : public Enforcement<dim>
{
public:
  using Enforcement<dim>::Enforcement;

  std::vector<TrialTraction<dim>>
  trial_tractions(const std::vector<unsigned int>       &numbers,
                  const std::vector<ContactMotion<dim>> &motions,
                  const ContactHistory<dim>             &history) const override;

  std::vector<double> stored_energy(const std::vector<double>                 &pressures,
                                    const std::vector<dealii::Tensor<1, dim>> &tau) const override;

  std::vector<dealii::Tensor<1, dim>>
  elastic_slides(const std::vector<dealii::Tensor<1, dim>> &old_tau,
                 const std::vector<dealii::Tensor<1, dim>> &tau) const override;

  void start_step(const ContactHistory<dim> &) override
  {
  }

  bool update(const std::vector<ContactResponse<dim>> &) override
  {
    return true;
  }

private:
  using Enforcement<dim>::penalties;
};
} // namespace scree
