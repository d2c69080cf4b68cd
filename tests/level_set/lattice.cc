#include <gtest/gtest.h>

#include <scree/level_set/lattice.h>

#include <cmath>

namespace scree
{
namespace
{
using namespace dealii;

template <int dim>
Lattice<dim>
make_lattice(const double spacing, const int n)
{
  LatticeFrame<dim> frame;
  frame.origin  = Point<dim>::unit_vector(0) * 0.3 + Point<dim>::unit_vector(1) * -0.7;
  frame.spacing = spacing;
  std::array<int, dim> lower, count;
  lower.fill(-n);
  count.fill(2 * n + 1);
  return Lattice<dim>(frame, lower, count);
}

template <int dim, typename F>
void
sample(Lattice<dim> &lattice, const F &f)
{
  for (std::size_t i = 0; i < lattice.values().size(); ++i)
    lattice.values()[i] = f(lattice.node(lattice.index(i)));
}

// A polynomial of degree k per coordinate with its derivatives.
template <int dim>
LevelSetExpansion<dim>
polynomial(const Point<dim> &x, const unsigned int k)
{
  std::array<double, 3> p, p1, p2;
  p.fill(1);
  for (unsigned int d = 0; d < dim; ++d)
    {
      const double a = 0.3 + 0.2 * d;
      p[d]           = std::pow(x[d], k) - a * x[d] + 1;
      p1[d]          = k * std::pow(x[d], k - 1.) - a;
      p2[d]          = k * (k - 1.) * (k > 1 ? std::pow(x[d], k - 2.) : 0.);
    }
  LevelSetExpansion<dim> result;
  result.value = p[0] * p[1] * p[2];
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = i; j < dim; ++j)
      {
        double h = 1;
        for (unsigned int d = 0; d < dim; ++d)
          h *= d == i && d == j ? p2[d] : d == i || d == j ? p1[d] : p[d];
        result.hessian[i][j] = h;
      }
  for (unsigned int i = 0; i < dim; ++i)
    {
      result.gradient[i] = 1;
      for (unsigned int d = 0; d < dim; ++d)
        result.gradient[i] *= d == i ? p1[d] : p[d];
    }
  return result;
}

template <int dim>
void
check_exactness(const unsigned int degree)
{
  Lattice<dim> lattice = make_lattice<dim>(0.25, 4);
  sample(lattice, [&](const Point<dim> &x) { return polynomial<dim>(x, degree).value; });
  for (unsigned int i = 0; i < 50; ++i)
    {
      Point<dim> x = lattice.frame().origin;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] += 0.99 * std::sin(1. + 3.7 * i + 2.1 * d * (i + 1));
      const auto exact = polynomial<dim>(x, degree), found = lattice.expansion(x, degree);
      EXPECT_NEAR(lattice.value(x, degree), exact.value, 1e-11);
      EXPECT_NEAR(found.value, exact.value, 1e-11);
      EXPECT_LT((found.gradient - exact.gradient).norm(), 1e-10);
      EXPECT_LT((found.hessian - exact.hessian).norm(), 1e-9);
      EXPECT_EQ(lattice.value_and_gradient(x, degree).second, found.gradient);
    }
}

TEST(Lattice, InterpolatesPolynomialsOfItsDegreeExactly)
{
  for (const unsigned int degree : {1, 2, 3})
    {
      check_exactness<2>(degree);
      check_exactness<3>(degree);
    }
}

TEST(Lattice, InterpolationErrorsFallWithOrderDegreePlusOne)
{
  const auto f = [](const Point<2> &x) { return std::sin(2 * x[0] + x[1]) * std::cos(x[1]); };
  for (const unsigned int degree : {1, 2, 3})
    {
      std::array<double, 2> error{};
      for (const int level : {0, 1})
        {
          Lattice<2> lattice = make_lattice<2>(0.1 / (1 << level), 10 << level);
          sample(lattice, f);
          for (unsigned int i = 0; i < 2000; ++i)
            {
              const Point<2> x = lattice.frame().origin
                                 + Point<2>(0.8 * std::sin(1. + 3.7 * i), 0.8 * std::sin(2.3 * i));
              error[level] = std::max(error[level], std::abs(lattice.value(x, degree) - f(x)));
            }
        }
      EXPECT_GT(std::log2(error[0] / error[1]), degree + 1 - 0.2) << "degree " << degree;
    }
}

// Degree 2 uses cells between even nodes whatever the first node of the lattice is, as FE_Q(2) on
// the background cells.
TEST(Lattice, QuadraticCellsAreAlignedWithEvenNodes)
{
  LatticeFrame<2> frame;
  frame.spacing = 0.5;
  for (const int lower : {-4, -2, 0})
    {
      Lattice<2> lattice(frame, {{lower, lower}}, {{9, 9}});
      sample(lattice, [](const Point<2> &x) { return std::pow(x[0], 3); });
      // On the cell [1, 2] with nodes 1, 1.5, 2: x^3 - (x - 1) (x - 1.5) (x - 2).
      const double x = 1.2;
      EXPECT_NEAR(lattice.value({x, 0.3}, 2), x * x * x - (x - 1) * (x - 1.5) * (x - 2), 1e-13);
    }
}

template <int dim>
void
check_outside()
{
  Lattice<dim> lattice = make_lattice<dim>(0.25, 4);
  sample(lattice, [](const Point<dim> &x) { return 0.5 * x[0] + 2 * x[1]; });
  Point<dim> corner = lattice.box().get_boundary_points().second, x = corner;
  x[0] += 3;
  x[1] += 4;
  const double expected = lattice.value(corner, 1) + 5;
  for (const unsigned int degree : {1, 2, 3})
    EXPECT_NEAR(lattice.value(x, degree), expected, 1e-12);
  EXPECT_NEAR(lattice.nodal_value(x), expected, 1e-12);

  // The gradient is that of the extended function.
  for (unsigned int i = 0; i < 2; ++i)
    {
      const Tensor<1, dim> gradient = lattice.value_and_gradient(x, 3).second;
      for (unsigned int d = 0; d < dim; ++d)
        {
          Point<dim> forward = x, backward = x;
          forward[d] += 1e-6;
          backward[d] -= 1e-6;
          const double slope = (lattice.value(forward, 3) - lattice.value(backward, 3)) / 2e-6;
          if (x[d] != corner[d])
            {
              EXPECT_NEAR(gradient[d], slope, 1e-8);
            }
        }
      x[1] = corner[1] - 0.1; // beside the box, no longer beyond the corner
    }
}

TEST(Lattice, OutsideItAddsTheDistance)
{
  check_outside<2>();
  check_outside<3>();
}

TEST(Lattice, NumbersItsNodesBackAndForth)
{
  const Lattice<3> lattice = make_lattice<3>(0.5, 3);
  for (std::size_t i = 0; i < lattice.values().size(); ++i)
    {
      EXPECT_EQ(lattice.offset(lattice.index(i)), i);
      EXPECT_TRUE(lattice.contains(lattice.index(i)));
      EXPECT_TRUE(std::isnan(lattice(lattice.index(i))));
    }
  EXPECT_FALSE(lattice.contains({{4, 0, 0}}));
  EXPECT_FALSE(lattice.contains({{0, 0, -4}}));
  EXPECT_EQ(lattice.offset({{-2, -3, -3}}), 1u);
}

TEST(Lattice, NodalValuesAreRoundedToTheNode)
{
  Lattice<2> lattice = make_lattice<2>(0.1, 10);
  sample(lattice, [](const Point<2> &x) { return x[0] - 3 * x[1]; });
  const Point<2> node = lattice.node({{3, -7}});
  EXPECT_EQ(lattice.nodal_value(node + Point<2>(1e-12, -1e-12)), lattice({{3, -7}}));
}

TEST(Lattice, NumbersOfNodesAreToldFromOthers)
{
  EXPECT_TRUE(is_number_of_nodes<2>(20, {{4, 5}}, 4));
  EXPECT_FALSE(is_number_of_nodes<2>(20, {{2, 10}}, 4));
  EXPECT_FALSE(is_number_of_nodes<2>(15, {{-3, -5}}, 2));
  EXPECT_FALSE(is_number_of_nodes<2>(0, {{0, 4}}, 2));
  EXPECT_FALSE(is_number_of_nodes<3>(60, {{4, 5, 4}}, 2));
  // The product is 0 modulo 2^64.
  EXPECT_FALSE(is_number_of_nodes<3>(0, {{1 << 30, 1 << 30, 1 << 4}}, 2));
}
} // namespace
} // namespace scree
