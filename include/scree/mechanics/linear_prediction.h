#pragma once

#include <scree/mechanics/equilibrium.h>

#include <functional>

namespace scree
{
/**
 * First guess of a step, from the tangent at the old state: u_0 + d + du with the jump d of the
 * prescribed unknowns and K du = r(u_0) + dr/du d at the new loads. A rigid body that jumps would
 * otherwise change the state of all its contact points before the first tangent is computed: all
 * of them slip. dr/du d is a difference quotient with a step that changes no state.
 *
 * @param old_u the accepted state u_0
 * @param u     the same with the prescribed unknowns of the new time, after set_time()
 * @param solve solves K x = b at the u of the last residual
 */
template <int dim>
typename Equilibrium<dim>::Vector
linear_prediction(Equilibrium<dim> &equilibrium, const ContactHistory<dim> &history,
                  const typename Equilibrium<dim>::Vector                         &old_u,
                  const typename Equilibrium<dim>::Vector                         &u,
                  const std::function<void(const typename Equilibrium<dim>::Vector &b,
                                           typename Equilibrium<dim>::Vector       &x)> &solve);
} // namespace scree
