#include <scree/mechanics/quasi_static.h>

namespace scree
{
template <int dim>
std::optional<typename QuasiStatic<dim>::Vector>
QuasiStatic<dim>::predicted(const Kinematics<dim> &kinematics, const State<dim> &state,
                            const double time) const
{
  if (state.predictor.is_empty())
    return {};
  return kinematics.extrapolated(state, time);
}

template <int dim>
Inertia<dim>
QuasiStatic<dim>::inertia(const std::shared_ptr<const Mass<dim>> &, const State<dim> &,
                          const double) const
{
  return {};
}

template <int dim>
Rates
QuasiStatic<dim>::rates(const Mass<dim> *, const State<dim> &state, const Vector &u, const Vector &,
                        const std::vector<bool> &, const double time) const
{
  if (time == state.time) // The time has come there with an earlier displacement.
    return {};
  Vector velocity = u;
  velocity -= state.displacement;
  velocity *= 1. / (time - state.time);
  return {velocity, {}, {}};
}

template <int dim>
LocalErrorFormula
QuasiStatic<dim>::local_error(const double) const
{
  return {};
}

template class QuasiStatic<2>;
template class QuasiStatic<3>;
} // namespace scree
