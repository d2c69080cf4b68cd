#include <gtest/gtest.h>

#include <scree/geometry/random_shapes.h>
#include <scree/geometry/touching_scale.h>

#include <deal.II/base/symmetric_tensor.h>

#include <cmath>

namespace scree
{
namespace
{
using namespace dealii;

/** The root of the largest of l (1 - l) r.((1 - l) A + l B)^-1 r: Perram and Wertheim. */
template <int dim>
double
perram_wertheim(const Tensor<1, dim> &a, const Tensor<2, dim> &turn_a, const Tensor<1, dim> &b,
                const Tensor<2, dim> &turn_b, const Tensor<1, dim> &r)
{
  const auto form = [](const Tensor<1, dim> &axes, const Tensor<2, dim> &turn) {
    Tensor<2, dim> squares;
    for (unsigned int d = 0; d < dim; ++d)
      squares[d][d] = axes[d] * axes[d];
    return turn * squares * transpose(turn);
  };
  const auto value = [&](const double l) {
    return l * (1. - l) * (r * (invert((1. - l) * form(a, turn_a) + l * form(b, turn_b)) * r));
  };
  double low = 0., high = 1.;
  while (high - low > 1e-9)
    {
      const double third = (high - low) / 3.;
      (value(low + third) < value(high - third) ? low : high)
        += value(low + third) < value(high - third) ? third : -third;
    }
  return std::sqrt(value(low));
}

template <int dim>
void
compare_with_perram_wertheim()
{
  std::mt19937_64   random(11);
  RandomShapes<dim> shapes;
  shapes.type = RandomShapeType::ellipsoid;
  TouchGuess<dim> guess;
  for (unsigned int i = 0; i < 300; ++i)
    {
      Tensor<1, dim> a, b, arm;
      for (unsigned int d = 0; d < dim; ++d)
        {
          a[d]   = 0.5 + uniform(random);
          b[d]   = 0.5 + uniform(random);
          arm[d] = uniform(random) - 0.5;
        }
      const auto turn_a = shapes.draw_rotation(random), turn_b = shapes.draw_rotation(random);
      const ConvexSuperellipse<dim> first(a, 2.), second(b, 2.);
      const TurnedShape<dim>        A{first, turn_a}, B{second, turn_b};
      const Touch<dim>              touch = touching_scale(A, B, arm, 1e-13, 1e300, guess);
      const double                  exact = perram_wertheim(a, turn_a, b, turn_b, arm);
      EXPECT_NEAR(touch.scale, exact, 1e-12 * exact);
      // Both touch at one point.
      const Tensor<1, dim> apart = arm + touch.scale * (touch.on_b - touch.on_a);
      EXPECT_NEAR(apart.norm(), 0., 1e-5 * arm.norm());
      // From the guess, moved a little: less, if the portal has become too thin.
      const Tensor<1, dim> moved = arm + 1e-3 * a;
      const double         near  = perram_wertheim(a, turn_a, b, turn_b, moved);
      const double         scale = touching_scale(A, B, moved, 1e-5, 1e300, guess).scale;
      EXPECT_NEAR(scale, near, 2e-5 * near);
      EXPECT_LT(scale, near * (1. + 1e-14));
      guess = TouchGuess<dim>();
    }
}

TEST(TouchingScale, IsThatOfPerramAndWertheim)
{
  compare_with_perram_wertheim<2>();
  compare_with_perram_wertheim<3>();
}

TEST(TouchingScale, IsExactForPolygons)
{
  const std::vector<Point<2>> corners = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  const ConvexPolygon         square(corners, 0.), round_one(corners, 0.5);
  Tensor<2, 2>                straight = unit_symmetric_tensor<2>(), turned;
  turned[0][0] = turned[1][0] = turned[1][1] = std::sqrt(0.5);
  turned[0][1]                               = -std::sqrt(0.5);
  const auto scale
    = [&](const ConvexPolygon &a, const Tensor<2, 2> &turn, const Tensor<1, 2> &arm) {
        TouchGuess<2> guess;
        return touching_scale<2>({square, straight}, {a, turn}, arm, 1e-13, 1e300, guess).scale;
      };
  EXPECT_NEAR(scale(square, straight, Tensor<1, 2>({3., 1.})), 1.5, 1e-14);
  EXPECT_NEAR(scale(square, straight, Tensor<1, 2>({3., 0.})), 1.5, 1e-14);
  EXPECT_NEAR(scale(square, straight, Tensor<1, 2>({-3., 3.})), 1.5, 1e-14);
  EXPECT_NEAR(scale(square, turned, Tensor<1, 2>({0., -6.})), 6. / (1. + std::sqrt(2.)), 1e-14);
  EXPECT_NEAR(scale(round_one, straight, Tensor<1, 2>({5., -1.})), 2., 1e-14);
  // Corner to rounded corner: (6, 6) is sqrt(2) (2 s) + s/2 away.
  EXPECT_NEAR(scale(round_one, straight, Tensor<1, 2>({6., 6.})),
              6. * std::sqrt(2.) / (2. * std::sqrt(2.) + 0.5), 1e-12);
}
} // namespace
} // namespace scree
