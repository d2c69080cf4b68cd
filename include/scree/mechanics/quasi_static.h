#pragma once

#include <scree/mechanics/time_scheme.h>

namespace scree
{
/** No inertia: time is what orders the loads, the velocity v = (u - u_n)/dt predicts the next step.
 */
template <int dim>
class QuasiStatic : public TimeScheme<dim>
{
public:
  using typename TimeScheme<dim>::Vector;

  std::optional<Vector> predicted(const Kinematics<dim> &kinematics, const State<dim> &state,
                                  const double time) const override;
  Inertia<dim> inertia(const std::shared_ptr<const Mass<dim>> &mass, const State<dim> &state,
                       const double time) const override;
  /** Without an acceleration. */
  Rates             rates(const Mass<dim> *mass, const State<dim> &state, const Vector &u,
                          const Vector &by_contact, const std::vector<bool> &turns_freely,
                          const double time) const override;
  LocalErrorFormula local_error(const double step_size) const override;
};
} // namespace scree
