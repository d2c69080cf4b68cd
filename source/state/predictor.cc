#include <scree/state/predictor.h>

namespace scree
{
template <int dim>
dealii::Tensor<1, dim>
Predictor<dim>::expected_increment(const Body<dim> &body, const unsigned int b,
                                   const dealii::Point<dim> &x, const double next_step_size) const
{
  const double factor = next_step_size / step_size;
  if (!body.is_rigid())
    return factor * of_bodies[b](x - of_bodies[b](x));
  const RigidPose<dim> &now  = body.pose;
  auto                  next = now.unknowns();
  const auto            X    = now.initial_position(x);
  for (unsigned int m = 0; m < next.size(); ++m)
    next[m] += factor * of_rigid[b][m];
  return RigidPose<dim>(*body.rigid, next).displacement(X) - now.displacement(X);
}

template struct Predictor<2>;
template struct Predictor<3>;
} // namespace scree
