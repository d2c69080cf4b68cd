#include <gtest/gtest.h>

#include <deal.II/base/symmetric_tensor.h>

#include <ctime>
#include <iostream>

#include "point_clouds.h"

namespace scree
{
namespace
{
using namespace dealii;

// A full polynomial of the degree with coefficients of order one.
template <int dim>
double
polynomial(const Point<dim> &x, const unsigned int degree)
{
  double value = 0.7;
  if (degree > 0)
    for (unsigned int d = 0; d < dim; ++d)
      value += (0.9 - 0.5 * d) * x[d];
  if (degree > 1)
    for (unsigned int d = 0; d < dim; ++d)
      for (unsigned int e = 0; e <= d; ++e)
        value += (0.4 + 0.3 * d - 0.6 * e) * x[d] * x[e];
  return value;
}

// Body 0 carries the polynomial, all others garbage that must not be seen.
template <int dim>
std::vector<double>
sample(const PointCloud<dim> &cloud, const unsigned int degree)
{
  std::vector<double> field;
  for (std::size_t i = 0; i < cloud.position.size(); ++i)
    field.push_back(cloud.body[i] == 0 ? polynomial(cloud.position[i], degree) : 1e6);
  return field;
}

template <int dim>
double
largest_error(const PointWeights &weights, const PointCloud<dim> &cloud,
              const Targets<dim> &targets, const unsigned int degree)
{
  const auto values = weights.values(sample(cloud, degree));
  double     error  = 0.;
  for (std::size_t t = 0; t < values.size(); ++t)
    error = std::max(error, std::abs(values[t] - polynomial(targets.position[t], degree)));
  return error;
}

template <int dim>
void
check_exactness(const unsigned int n, const unsigned int n_targets)
{
  for (const auto placement :
       {Placement::regular, Placement::rotated, Placement::graded, Placement::irregular})
    for (unsigned int degree = 0; degree <= 2; ++degree)
      {
        const auto cloud   = make_cloud<dim>(n, placement);
        const auto targets = make_targets<dim>(n_targets, placement, 2. / n);
        const auto weights
          = MovingLeastSquares<dim>(cloud.position, cloud.body, cloud.spacing, {degree, 1.75})
              .weights(targets);
        const double error = largest_error(weights, cloud, targets, degree);
        std::cout << "  " << dim << "D, placement " << int(placement) << ", degree " << degree
                  << ": error " << error << ", neighbours "
                  << double(weights.points.size()) / weights.n_targets() << ", amplification "
                  << weights.report.largest_amplification << ", widened " << weights.report.widened
                  << std::endl;
        EXPECT_LT(error, 1e-12);
        EXPECT_EQ(weights.report.n_targets, targets.position.size());
        EXPECT_EQ(weights.report.lowered, 0u);
        EXPECT_EQ(weights.report.without_points, 0u);
        EXPECT_LT(weights.report.largest_amplification, 25.);
      }
}

TEST(MovingLeastSquares, reproduces_its_basis_2d)
{
  check_exactness<2>(20, 20);
}

TEST(MovingLeastSquares, reproduces_its_basis_3d)
{
  check_exactness<3>(10, 6);
}

// The error of a smooth field falls by 2^(degree + 1) when the points come twice as close; degree 0
// has order 1 at the surface.
TEST(MovingLeastSquares, order)
{
  for (unsigned int degree = 0; degree <= 2; ++degree)
    {
      double errors[2];
      for (const unsigned int level : {0, 1})
        {
          const unsigned int  n       = 20 << level;
          const auto          cloud   = make_cloud<2>(n, Placement::irregular, 1);
          const auto          targets = make_targets<2>(30, Placement::irregular, 2. / n);
          const auto          smooth  = [](const Point<2> &x) { return std::sin(2 * x[0] + x[1]); };
          std::vector<double> field;
          for (const auto &x : cloud.position)
            field.push_back(smooth(x));
          const auto values
            = MovingLeastSquares<2>(cloud.position, cloud.body, cloud.spacing, {degree, 1.75})
                .weights(targets)
                .values(field);
          errors[level] = 0.;
          for (std::size_t t = 0; t < values.size(); ++t)
            errors[level]
              = std::max(errors[level], std::abs(values[t] - smooth(targets.position[t])));
        }
      const double order = std::log2(errors[0] / errors[1]);
      std::cout << "  degree " << degree << ": errors " << errors[0] << ", " << errors[1]
                << ", order " << order << std::endl;
      EXPECT_GT(order, degree + 0.7);
    }
}

// Weights that interpolate keep the values at points, next to them too, and reproduce the basis.
TEST(MovingLeastSquares, interpolates)
{
  for (unsigned int degree = 0; degree <= 2; ++degree)
    {
      const auto                  cloud = make_cloud<2>(10, Placement::irregular, 1);
      const MovingLeastSquares<2> least_squares(cloud.position, cloud.body, cloud.spacing,
                                                {degree, 1.75, true});
      const auto                  targets = make_targets<2>(20, Placement::irregular, 0.2);
      EXPECT_LT(largest_error(least_squares.weights(targets), cloud, targets, degree), 1e-11);

      std::vector<double> field;
      for (std::size_t i = 0; i < cloud.position.size(); ++i)
        field.push_back(i % 3 - 1.);
      Targets<2> near{cloud.position, cloud.body, std::vector<double>(cloud.position.size(), 0.1)};
      for (auto &x : near.position)
        x[0] += 1e-5;
      const auto values = least_squares.weights(near).values(field);
      for (std::size_t i = 0; i < field.size(); ++i)
        EXPECT_NEAR(values[i], field[i], 1e-3);
    }
}

// All components by one set of weights: tensors and rows of numbers give what scalars give.
TEST(MovingLeastSquares, components)
{
  const auto cloud   = make_cloud<2>(8, Placement::irregular, 1);
  const auto targets = make_targets<2>(5, Placement::irregular, 0.25);
  const auto weights
    = MovingLeastSquares<2>(cloud.position, cloud.body, cloud.spacing, {1, 1.75}).weights(targets);
  std::vector<Tensor<2, 2>> tensors(cloud.position.size());
  std::vector<double>       rows;
  for (std::size_t i = 0; i < tensors.size(); ++i)
    for (unsigned int c = 0; c < 4; ++c)
      {
        tensors[i][c / 2][c % 2] = std::sin(3. * i + c);
        rows.push_back(tensors[i][c / 2][c % 2]);
      }
  const auto tensor_values = weights.values(tensors);
  const auto row_values    = weights.values(rows, 4);
  for (std::size_t t = 0; t < weights.n_targets(); ++t)
    for (unsigned int c = 0; c < 4; ++c)
      EXPECT_DOUBLE_EQ(tensor_values[t][c / 2][c % 2], row_values[4 * t + c]);
}

// Clouds that do not determine the polynomial: what is left is reproduced and counted.
TEST(MovingLeastSquares, fallbacks)
{
  const auto weights_for = [](const std::vector<Point<2>> &points, const unsigned int degree,
                              const Point<2> &target, const unsigned int target_body = 0) {
    const std::vector<unsigned int> body(points.size(), 0);
    const std::vector<double>       spacing(points.size(), 0.1);
    return MovingLeastSquares<2>(points, body, spacing, {degree, 1.75})
      .weights({{target}, {target_body}, {0.1}});
  };
  const auto sum = [](const PointWeights &w) {
    double result = 0.;
    for (const double weight : w.weights)
      result += weight;
    return result;
  };

  std::vector<Point<2>> line, circle;
  for (unsigned int i = 0; i < 20; ++i)
    {
      line.emplace_back(0.05 * i, 0.025 * i);
      circle.emplace_back(0.1 * std::cos(0.314 * i), 0.1 * std::sin(0.314 * i));
    }
  // points on a line carry no gradient across it
  auto w = weights_for(line, 1, line[9] + Point<2>(0.01, -0.02));
  EXPECT_EQ(w.report.constant, 1u);
  EXPECT_NEAR(sum(w), 1., 1e-14);
  // points on a circle do not determine a quadratic, but a linear polynomial
  w = weights_for(circle, 2, Point<2>(0.01, 0.02));
  EXPECT_EQ(w.report.lowered, 1u);
  EXPECT_EQ(w.report.constant, 0u);
  Point<2> centre;
  for (std::size_t i = 0; i < w.points.size(); ++i)
    centre += w.weights[i] * circle[w.points[i]];
  EXPECT_NEAR(centre.distance(Point<2>(0.01, 0.02)), 0., 1e-14);
  // a target beyond the radius is reached by widening it: here five points at a corner
  w = weights_for({{0, 0}, {0.1, 0}, {0, 0.1}, {0.1, 0.1}, {0.05, 0.15}}, 1, Point<2>(0.25, 0.25));
  EXPECT_EQ(w.report.widened, 1u);
  EXPECT_EQ(w.report.lowered, 0u);
  EXPECT_NEAR(sum(w), 1., 1e-13);
  // far away: the nearest point
  w = weights_for({{0, 0}, {0.1, 0}, {0, 0.1}}, 2, Point<2>(50, -3));
  EXPECT_EQ(w.report.constant, 1u);
  ASSERT_EQ(w.points.size(), 1u);
  EXPECT_EQ(w.points[0], 1u);
  EXPECT_EQ(w.weights[0], 1.);
  // a body without points
  w = weights_for({{0, 0}}, 1, Point<2>(0, 0), 3);
  EXPECT_EQ(w.report.without_points, 1u);
  EXPECT_EQ(w.n_targets(), 1u);
  EXPECT_TRUE(w.points.empty());
  // coinciding points
  w = weights_for(std::vector<Point<2>>(9, Point<2>(1, 1)), 2, Point<2>(1.01, 1));
  EXPECT_EQ(w.report.constant, 1u);
  EXPECT_NEAR(sum(w), 1., 1e-14);
}

// Units do not matter: the same cloud in metres and in millimetres has the same weights.
TEST(MovingLeastSquares, independent_of_units_and_position)
{
  auto       cloud   = make_cloud<3>(6, Placement::irregular, 1);
  auto       targets = make_targets<3>(3, Placement::irregular, 1. / 3);
  const auto weights
    = MovingLeastSquares<3>(cloud.position, cloud.body, cloud.spacing, {2, 1.75}).weights(targets);
  for (auto &x : cloud.position)
    x = Point<3>(1e-6 * (x + Point<3>(10., -10., 10.)));
  for (auto &x : targets.position)
    x = Point<3>(1e-6 * (x + Point<3>(10., -10., 10.)));
  for (auto &s : cloud.spacing)
    s *= 1e-6;
  for (auto &s : targets.cell_size)
    s *= 1e-6;
  const auto scaled
    = MovingLeastSquares<3>(cloud.position, cloud.body, cloud.spacing, {2, 1.75}).weights(targets);
  std::vector<double> field;
  for (std::size_t i = 0; i < cloud.position.size(); ++i)
    field.push_back(std::sin(1. * i));
  const auto a = weights.values(field), b = scaled.values(field);
  for (std::size_t t = 0; t < a.size(); ++t)
    EXPECT_NEAR(a[t], b[t], 1e-10);
}

// Isochoric gradients that vary much from point to point, a shear that grows and turns: det of the
// interpolated gradient is far from one, that of interpolated_gradients() is one.
template <int dim>
void
check_volume_ratios()
{
  const auto                  cloud   = make_cloud<dim>(8, Placement::irregular, 1);
  const auto                  targets = make_targets<dim>(5, Placement::irregular, 0.25);
  std::vector<Tensor<2, dim>> field;
  for (const Point<dim> &x : cloud.position)
    {
      Tensor<2, dim> shear(unit_symmetric_tensor<dim>()), turn = shear;
      shear[0][1] = 40. * x[1];
      turn[0][0]  = std::cos(3. * x[0]);
      turn[1][1]  = turn[0][0];
      turn[0][1]  = -std::sin(3. * x[0]);
      turn[1][0]  = -turn[0][1];
      field.push_back(turn * shear);
    }
  const auto weights = MovingLeastSquares<dim>(cloud.position, cloud.body, cloud.spacing, {1, 1.75})
                         .weights(targets);
  const auto plain = weights.values(field), scaled = interpolated_gradients(weights, field);
  double     error = 0.;
  for (std::size_t t = 0; t < plain.size(); ++t)
    {
      error = std::max(error, std::abs(determinant(plain[t]) - 1.));
      EXPECT_NEAR(determinant(scaled[t]), 1., 1e-10);
    }
  EXPECT_GT(error, 0.5);
}

TEST(InterpolatedGradients, VolumeRatio)
{
  check_volume_ratios<2>();
  check_volume_ratios<3>();
}

// The mean of two opposite shears turns material inside out: the point with the larger weight
// counts. A target without points stays at zero.
TEST(InterpolatedGradients, InsideOut)
{
  std::vector<Tensor<2, 2>> field(2, Tensor<2, 2>(unit_symmetric_tensor<2>()));
  field[0][0][1] = 10.;
  field[1][1][0] = 10.; // det of the last mean: 1 - 0.99 x 0.01 x 100 = 0.01
  PointWeights weights;
  weights.begin   = {0, 2, 4, 4, 6};
  weights.points  = {0, 1, 0, 1, 0, 1};
  weights.weights = {0.4, 0.6, 1., 0., 0.99, 0.01};
  EXPECT_LT(determinant(weights.value(field, 0)), 0.);
  const auto result = interpolated_gradients(weights, field);
  EXPECT_EQ(result[0], field[1]);
  EXPECT_NEAR((result[1] - field[0]).norm(), 0., 1e-14);
  EXPECT_EQ(result[2].norm(), 0.);
  EXPECT_GT(determinant(weights.value(field, 3)), 0.);
  EXPECT_EQ(result[3], field[0]);
}

template <int dim>
void
print_speed(const unsigned int n, const unsigned int n_targets, const unsigned int degree,
            const unsigned int per_cell)
{
  const auto cloud   = make_cloud<dim>(n, Placement::irregular, 1);
  const auto targets = make_targets<dim>(n_targets, Placement::irregular, double(per_cell) / n);
  const auto begin   = std::clock();
  const MovingLeastSquares<dim> squares(cloud.position, cloud.body, cloud.spacing, {degree, 1.75});
  const auto                    sorted  = std::clock();
  const auto                    weights = squares.weights(targets);
  const auto                    end     = std::clock();
  std::cout << "  " << dim << "D, degree " << degree << ", " << per_cell
            << " points per direction: "
            << 1e-6 * targets.position.size() * CLOCKS_PER_SEC / (end - sorted)
            << " million targets per second with "
            << double(weights.points.size()) / weights.n_targets() << " neighbours; sorting "
            << 1e9 * (sorted - begin) / CLOCKS_PER_SEC / cloud.position.size() << " ns per point"
            << std::endl;
  EXPECT_EQ(weights.report.lowered, 0u);
}

// Measured, not asserted: targets in random order, which is the worst for the cache.
TEST(ReleaseMovingLeastSquares, speed)
{
  for (unsigned int degree = 0; degree <= 2; ++degree)
    print_speed<2>(400, 300, degree, 2);
  print_speed<2>(400, 300, 2, 3);
  for (unsigned int degree = 1; degree <= 2; ++degree)
    print_speed<3>(50, 30, degree, 2);
}
} // namespace
} // namespace scree
