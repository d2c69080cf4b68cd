#include <gtest/gtest.h>

#include <scree/mechanics/rigid_motion.h>

using namespace scree;

namespace
{
template <int dim>
dealii::Point<dim>
some_point(const double first, const double step)
{
  dealii::Point<dim> result;
  for (unsigned int d = 0; d < dim; ++d)
    result[d] = first + step * d;
  return result;
}

template <int dim>
void
test_finite_motion()
{
  const auto motions = RigidMotions<dim>(some_point<dim>(2., 0.5), 1.5);
  std::array<double, RigidMotions<dim>::n_motions> q;
  for (unsigned int m = 0; m < q.size(); ++m)
    q[m] = 0.3 + 0.2 * m;
  const auto x = some_point<dim>(1.5, 1.), y = some_point<dim>(2.5, -0.7);
  // distances stay
  const auto moved = [&](const dealii::Point<dim> &p) { return p + motions.finite_motion(q, p); };
  EXPECT_NEAR(moved(x).distance(moved(y)), x.distance(y), 1e-14);
  // twice the half is the whole
  auto half = q;
  for (double &part : half)
    part *= 0.5;
  const auto once = x + motions.finite_motion(half, x);
  EXPECT_NEAR((once + motions.finite_motion(half, once)).distance(moved(x)), 0., 1e-14);
  // small ones are the infinitesimal ones, without loss of digits
  const double           factor = 1e-9;
  dealii::Tensor<1, dim> small;
  auto                   tiny = q;
  for (unsigned int m = 0; m < q.size(); ++m)
    {
      tiny[m] *= factor;
      small += tiny[m] * motions.motion(m, x);
    }
  EXPECT_NEAR((motions.finite_motion(tiny, x) - small).norm(), 0., 1e-8 * small.norm());
}
} // namespace

TEST(RigidMotions, FiniteMotion2D)
{
  test_finite_motion<2>();
}

TEST(RigidMotions, FiniteMotion3D)
{
  test_finite_motion<3>();
}
