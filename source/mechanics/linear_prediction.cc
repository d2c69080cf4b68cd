#include <scree/mechanics/linear_prediction.h>

namespace scree
{
template <int dim>
typename Equilibrium<dim>::Vector
linear_prediction(Equilibrium<dim> &equilibrium, const ContactHistory<dim> &history,
                  const typename Equilibrium<dim>::Vector                         &old_u,
                  const typename Equilibrium<dim>::Vector                         &u,
                  const std::function<void(const typename Equilibrium<dim>::Vector &b,
                                           typename Equilibrium<dim>::Vector       &x)> &solve)
{
  using Vector          = typename Equilibrium<dim>::Vector;
  constexpr double step = 1e-6;
  Vector           jump(u), moved(old_u), r(u), right(u), du(u);
  jump -= old_u;
  moved.add(step, jump);
  equilibrium.residual(moved, history, right);
  equilibrium.residual(old_u, history, r);
  right -= r;
  right *= 1. / step;
  right += r;
  solve(right, du);
  du += u;
  return du;
}

#define SCREE_INSTANTIATE(dim)                                                         \
  template typename Equilibrium<dim>::Vector linear_prediction(                        \
    Equilibrium<dim> &, const ContactHistory<dim> &, const Equilibrium<dim>::Vector &, \
    const Equilibrium<dim>::Vector &,                                                  \
    const std::function<void(const Equilibrium<dim>::Vector &, Equilibrium<dim>::Vector &)> &);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
