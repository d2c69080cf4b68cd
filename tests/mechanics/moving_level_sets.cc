// Level sets that follow finite element increments: contours against exact maps, box faces,
// islands.
#include <gtest/gtest.h>

#include <scree/level_set/extension.h>
#include <scree/level_set/reinitialisation.h>

#include <ctime>
#include <iostream>

#include "moving_bodies.h"

namespace scree
{
namespace
{
using namespace dealii;
using Vector = TrilinosWrappers::MPI::Vector;

const Point<2> middle(2., 2.);

/** An ellipse of semi-axes 1 and 0.6. */
std::string
ellipse_text(const unsigned int degree, const std::string &grid)
{
  return grid + degree_text(degree)
         + bodies_text(
           {{"it", shape_text("ellipse", "set Centre = 2, 2\nset Semi-axes = 1, 0.6")}});
}

/** The distance of the ellipse, to first order: exact zero. */
double
ellipse(const Point<2> &x)
{
  const double a = (x[0] - 2.), b = (x[1] - 2.) / 0.6;
  const double f = std::sqrt(a * a + b * b);
  return (f - 1.) * f / std::sqrt(a * a + b * b / 0.36);
}

const std::string uniform_grid = grid_text("0.5, 0.75", "3.5, 3.25", "6, 5", 4); // h = 1/32
const std::string graded_grid  = grid_text(
   "0.5, 0.75", "3.5, 3.25", "6, 5", 4,
   graded_text(2, " set Cell size limit = if(x < 2, 0.03125, if(x < 2.4, 0.0625, 0.125))"));

/** Moves the ellipse and bounds what changes. */
void
check_ellipse(const std::string &name, const std::string &text, const unsigned int n_steps,
              const Tensor<2, 2> &A, const Tensor<1, 2> &shift, const double contour_bound,
              const double area_bound)
{
  MovingBodies<2> it(text);
  const double    area = it.volume();
  for (unsigned int i = 0; i < n_steps; ++i)
    it.step(affine<2>(A, middle + double(i) * shift, shift));
  const double growth  = std::pow(determinant(unit_symmetric_tensor<2>() + A), n_steps);
  const double error   = it.contour_error(ellipse);
  const double of_area = it.volume() / (area * growth) - 1.;
  std::cout << name << ": contour error/h " << error << ", area error " << of_area << '\n';
  EXPECT_LT(error, contour_bound);
  EXPECT_LT(std::abs(of_area), area_bound);
}

TEST(ReleaseMovingLevelSets, FollowAffineMaps)
{
  const double       h = 1. / 32.;
  const Tensor<2, 2> none, rotation = turn<2>(numbers::PI / 25.); // 7.2 degrees
  const Tensor<1, 2> zero, shift({0.37 * h * 0.8, -0.37 * h * 0.6});
  Tensor<2, 2>       compression;
  compression[0][0] = 0.004;
  compression[1][1] = std::pow(0.9, 0.1) - 1.;
  for (const unsigned int degree : {1, 2})
    for (const auto &grid : {uniform_grid, graded_grid})
      {
        const std::string text = ellipse_text(degree, grid);
        const std::string name = "degree " + std::to_string(degree)
                                 + (grid == graded_grid ? ", graded, " : ", uniform, ");
        const double bound = degree == 1 ? 1e-3 : 1e-4, of_area = 2e-5;
        check_ellipse(name + "translation by 3.7 h in 10 steps", text, 10, none, shift, bound,
                      of_area);
        check_ellipse(name + "36 degrees in 5 steps", text, 5, rotation, zero, bound, of_area);
        check_ellipse(name + "compression by 10 % in 10 steps", text, 10, compression, zero, bound,
                      of_area);
      }
}

TEST(MovingLevelSets, ReferenceMapTakesTheInitialContourAlong)
{
  for (const unsigned int degree : {1, 2})
    {
      MovingBodies<2> it(ellipse_text(degree, uniform_grid));
      it.cut.bodies.front().initial_level_set = std::make_shared<const Lattice<2>>(it.lattice());
      it.options.motion                       = IncrementMotion::reference_map;
      const Tensor<1, 2> shift({0.01, -0.007});
      for (unsigned int i = 0; i < 10; ++i)
        it.step(affine<2>(turn<2>(numbers::PI / 25.), middle + double(i) * shift, shift));
      const double error = it.contour_error(ellipse);
      std::cout << "degree " << degree << ": contour error/h " << error << '\n';
      EXPECT_LT(error, degree == 1 ? 1e-3 : 1e-4);
    }
}

// Quadratic increments are in the space of degree 2, with hanging nodes too.
TEST(MovingLevelSets, FollowQuadraticMapsOnAGradedGrid)
{
  MovingBodies<2> it(ellipse_text(2, graded_grid));
  EXPECT_TRUE(it.cut.grid.triangulation().has_hanging_nodes());
  it.run(10, [](const Point<2> &x) {
    const double a = x[0] - 2., b = x[1] - 2.;
    return Tensor<1, 2>({0.01 * a * b - 0.008 * b * b, 0.01 * a * a + 0.005 * b});
  });
  const double error = it.contour_error(ellipse);
  std::cout << "contour error/h " << error << '\n';
  EXPECT_LT(error, 1e-3);
}

/** Contour error and area of a ball of radius 1 under increments that keep x = 0 and y = 0. */
std::pair<double, double>
errors_at_planes(const unsigned int degree, const Point<2> &centre, const Increment<2> &increment)
{
  std::ostringstream where;
  where << centre;
  std::string at = where.str();
  at.replace(at.find(' '), 1, ", ");
  MovingBodies<2> it(grid_text("0, 0", "1.5, 1.5", "3, 3", 4) + degree_text(degree)
                     + bodies_text({{"it", ball_text(at, 1.)}}));
  for (unsigned int i = 0; i < 10; ++i)
    EXPECT_LE(it.step(increment).face_increment, 1e-12);
  return {it.contour_error([&](const Point<2> &x) { return x.distance(centre) - 1.; }),
          it.volume()};
}

TEST(MovingLevelSets, SlideAlongBoxFaces)
{
  Tensor<2, 2> A;
  A[0][0]                 = 0.012;
  A[1][1]                 = -0.01;
  const Increment<2> bent = [](const Point<2> &x) {
    return Tensor<1, 2>({0.01 * x[0] * (1. + 0.5 * x[1]), -0.01 * x[1] * (1. - 0.4 * x[0] * x[0])});
  };
  struct Case
  {
    std::string  name;
    Point<2>     centre;
    Increment<2> increment;
  };
  for (const auto &[name, centre, increment] :
       {Case{"quarter disc, affine", Point<2>(), affine<2>(A, Point<2>())},
        Case{"oblique at the face, affine", Point<2>(-0.4, 0.3), affine<2>(A, Point<2>())},
        Case{"quarter disc, bent", Point<2>(), bent},
        Case{"oblique at the face, bent", Point<2>(-0.4, 0.3), bent}})
    for (const unsigned int degree : {1, 2})
      {
        const auto [error, area] = errors_at_planes(degree, centre, increment);
        std::cout << name << ", degree " << degree << ": contour error/h " << error << ", area "
                  << area;
        if (name == "quarter disc, affine")
          {
            const double of_area = area / (numbers::PI / 4. * std::pow(1.012 * 0.99, 10)) - 1.;
            std::cout << ", area error " << of_area;
            EXPECT_LT(std::abs(of_area), 1e-5);
          }
        std::cout << '\n';
        EXPECT_LT(error, 5e-4);
      }
}

// What moves through a face is told: here 0.02 through the upper one.
TEST(MovingLevelSets, MotionThroughAFaceIsReported)
{
  MovingBodies<2>     it(grid_text("0, 0", "2, 2", "1, 1", 5) + degree_text(1)
                         + bodies_text({{"it", box_text("0.5, 1", "1.2, 3")}}));
  const BodyMotion<2> motion = it.step([](const Point<2> &x) {
    return Tensor<1, 2>({0.05, -0.01 * x[1]});
  });
  EXPECT_NEAR(motion.face_increment, 0.02, 1e-12);
}

// Corners: what a turn of a square by 36 degrees costs, with rough increments.
TEST(MovingLevelSets, ATurningSquareStaysInOnePiece)
{
  MovingBodies<2> it(uniform_grid + degree_text(1)
                     + bodies_text({{"it", box_text("1.3, 1.4", "2.7, 2.6")}}));
  const double    area = it.volume(), h = 1. / 32.;
  const auto      map = affine<2>(turn<2>(numbers::PI / 25.), middle);
  it.run(5, map);
  const auto square = [](const Point<2> &x) {
    const double a = std::abs(x[0] - 2.) - 0.7, b = std::abs(x[1] - 2.) - 0.6;
    return std::hypot(std::max(a, 0.), std::max(b, 0.)) + std::min(std::max(a, b), 0.);
  };
  const double error = it.contour_error(square), of_area = it.volume() / area - 1.;
  std::cout << "contour error/h " << error << ", area error " << of_area << '\n';
  EXPECT_LT(error, 0.5);
  EXPECT_LT(std::abs(of_area), 2e-3);
  for (unsigned int i = 0; i < 5; ++i)
    it.step([&](const Point<2> &x) {
      const double wave = 0.05 * h * std::sin(40. * x[0] / h + i) * std::sin(31. * x[1] / h);
      return map(x) + Tensor<1, 2>({wave, -wave});
    });
  EXPECT_LT(std::abs(it.volume() / area - 1.), 5e-3);
}

TEST(MovingLevelSets, ABallIn3D)
{
  MovingBodies<3> it(grid_text("0.25, 0.25, 0.25", "1.75, 1.75, 1.75", "3, 3, 3", 3)
                     + degree_text(1) + bodies_text({{"it", ball_text("1, 1, 1", 0.6)}}));
  const double    volume = it.volume();
  const Point<3>  centre(1., 1., 1.);
  Tensor<2, 3>    A = turn<3>(0.1);
  A[2][2]           = -0.02;
  const Tensor<1, 3> shift({0.01, 0.02, 0.015});
  for (unsigned int i = 0; i < 3; ++i)
    it.step(affine<3>(A, centre + i * shift, shift));
  const double error
    = it.contour_error([&](const Point<3> &x) { return x.distance(centre) - 0.6; });
  const double of_volume = it.volume() / (volume * std::pow(0.98, 3)) - 1.;
  std::cout << "contour error/h " << error << ", volume error " << of_volume << '\n';
  EXPECT_LT(error, 2e-3);
  EXPECT_LT(std::abs(of_volume), 2e-5);
}

TEST(MovingLevelSets, TheLatticeFollowsTheBody)
{
  MovingBodies<2> it(grid_text("0, 0", "3, 3", "3, 3", 5) + degree_text(1)
                     + bodies_text({{"it", ball_text("1, 1", 0.5)}}));
  unsigned int    n_boxes = 0;
  // the second step is longer than the margin of 6 cells
  for (const double distance : {0.05, 0.3, 0.15, 0.5})
    n_boxes += it.step([=](const Point<2> &) {
                   return Tensor<1, 2>({distance, distance});
                 })
                 .is_reboxed;
  EXPECT_GE(n_boxes, 2u);
  EXPECT_LT(it.contour_error([](const Point<2> &x) { return x.distance(Point<2>(1., 1.)) - 0.5; }),
            3e-3);
  const auto &body = it.cut.bodies.front();
  for (unsigned int d = 0; d < 2; ++d)
    {
      EXPECT_NEAR(body.box.lower_bound(d), 1.5, 2.1 / 32.);
      EXPECT_NEAR(body.box.upper_bound(d), 2.5, 2.1 / 32.);
      EXPECT_LE(body.level_set.box().lower_bound(d), 1.5 - it.options.margin);
      EXPECT_LE(body.level_set.n_nodes()[d], 32 + 2 * 2 * 6 + 12);
    }
}

TEST(MovingLevelSets, KeepPiecesAndRemoveIslands)
{
  const std::string discs = shape_text(
    "expression", "set Expression = min(sqrt((x-1.5)^2+(y-2)^2)-0.4, sqrt((x-2.6)^2+(y-2)^2)-0.3)");
  MovingBodies<2> it(uniform_grid + degree_text(1) + bodies_text({{"it", discs}}));
  const auto      shift = [](const Point<2> &) { return Tensor<1, 2>({0.02, 0.01}); };
  it.step(shift);
  EXPECT_LT(it.lattice().value(Point<2>(1.52, 2.01), 1), -0.3);
  EXPECT_LT(it.lattice().value(Point<2>(2.62, 2.01), 1), -0.2);

  // A spot that no cell knows of.
  Lattice<2>       &phi    = it.cut.bodies.front().level_set;
  Lattice<2>::Index corner = phi.lower();
  for (int i = 2; i < 6; ++i)
    for (int j = 2; j < 6; ++j)
      phi({{corner[0] + i, corner[1] + j}}) = -0.3;
  const auto motions
    = move_level_sets(it.cut.bodies, *it.cut.space, it.nodal(shift), it.nodal(shift), it.options);
  EXPECT_EQ(motions.front().n_islands, 1u);
  std::size_t n_far = 0;
  for (std::size_t i = 0; i < phi.values().size(); ++i)
    {
      const Point<2> x = phi.node(phi.index(i));
      n_far
        += phi.values()[i] < 0.
           && std::min(x.distance(Point<2>(1.54, 2.02)), x.distance(Point<2>(2.64, 2.02))) > 0.5;
    }
  EXPECT_EQ(n_far, 0u);
  EXPECT_LT(phi.value(Point<2>(2.64, 2.02), 1), -0.2);
}

TEST(MovingLevelSets, TheExtendedIncrementIsAField)
{
  MovingBodies<2> it(ellipse_text(2, graded_grid));
  Tensor<2, 2>    A           = turn<2>(0.1);
  A[0][0]                     = 0.05;
  const auto           map    = affine<2>(A, middle);
  const BodyMotion<2>  motion = it.step(map);
  ExtendedIncrement<2> copy
    = Utilities::unpack<ExtendedIncrement<2>>(Utilities::pack(motion.increment));
  for (const Point<2> &x : {Point<2>(2.01, 2.33), Point<2>(1.013, 1.977), Point<2>(3.05, 2.7)})
    {
      EXPECT_LE((motion.increment(x) - map(x)).norm(), 1e-12) << x;
      EXPECT_EQ((motion.increment(x) - copy(x)).norm(), 0.);
    }
  EXPECT_EQ((motion.increment(Point<2>(9., 2.01)) - motion.increment(Point<2>(10., 2.01))).norm(),
            0.);
  EXPECT_GT(motion.largest_increment, 0.1);
}

TEST(MovingLevelSetsMPI, TheSameOnOneProcess)
{
  for (const unsigned int degree : {1, 2})
    {
      const std::string text = ellipse_text(degree, graded_grid);
      MovingBodies<2>   together(text), alone(text, MPI_COMM_SELF);
      const auto        map = affine<2>(turn<2>(0.1), middle, Tensor<1, 2>({0.01, 0.02}));
      for (unsigned int i = 0; i < 3; ++i)
        {
          const BodyMotion<2> motion = together.step(map), expected = alone.step(map);
          EXPECT_EQ(motion.largest_increment, expected.largest_increment);
          EXPECT_EQ(motion.contour_motion, expected.contour_motion);
        }
      ASSERT_EQ(together.lattice().values().size(), alone.lattice().values().size());
      for (std::size_t i = 0; i < alone.lattice().values().size(); ++i)
        ASSERT_EQ(together.lattice().values()[i], alone.lattice().values()[i]);
    }
}

double
seconds_since(const std::clock_t start)
{
  return double(std::clock() - start) / CLOCKS_PER_SEC;
}

TEST(ReleaseMovingLevelSets, FullTurnIn50Steps)
{
  check_ellipse("360 degrees in 50 steps", ellipse_text(1, uniform_grid), 50,
                turn<2>(numbers::PI / 25.), Tensor<1, 2>(), 5e-3, 5e-5);
}

TEST(ReleaseMovingLevelSets, CostLessThanALinearSolve)
{
  MovingBodies<2>     it(grid_text("0, 0", "4, 4", "1, 1", 8) + degree_text(1)
                         + bodies_text({{"it", ball_text("2, 2", 1.5625)}})); // 200 cells across
  const auto          map   = affine<2>(turn<2>(0.02), middle);
  const Vector        du    = it.nodal(map);
  const std::clock_t  start = std::clock();
  Lattice<2>          phi   = it.lattice();
  const BodyMotion<2> motion
    = move_level_sets(it.cut.bodies, *it.cut.space, du, du, it.options).front();
  const double all = seconds_since(start);

  NodalVectors<2>   v = motion.increment.values();
  std::vector<char> known;
  for (const double value : phi.values())
    known.push_back(value < 1.5 * phi.spacing());
  const std::clock_t at_extension = std::clock();
  extend(phi, known, ExtensionOptions(), v);
  const double       extension    = seconds_since(at_extension);
  const std::clock_t at_advection = std::clock();
  advect_increment<2>(phi, v);
  const double       advection = seconds_since(at_advection);
  const std::clock_t at_end    = std::clock();
  reinitialise(phi);
  const double   reinitialisation = seconds_since(at_end);
  const DofIndex n                = it.cut.space->n_dofs();
  std::cout << n << " unknowns, " << phi.values().size() << " lattice nodes: " << 1e3 * all
            << " ms, of which extension " << 1e3 * extension << ", advection " << 1e3 * advection
            << ", reinitialisation " << 1e3 * reinitialisation << '\n';
  EXPECT_LT(all, 1e-5 * n);
}

TEST(ReleaseMovingLevelSets, CostLessThanALinearSolveIn3D)
{
  MovingBodies<3>    it(grid_text("0, 0, 0", "2, 2, 2", "1, 1, 1", 6) + degree_text(1)
                        + bodies_text({{"it", ball_text("1, 1, 1", 0.625)}})); // 40 cells across
  const Vector       du    = it.nodal(affine<3>(turn<3>(0.02), Point<3>(1., 1., 1.)));
  const std::clock_t start = std::clock();
  move_level_sets(it.cut.bodies, *it.cut.space, du, du, it.options);
  const double   all = seconds_since(start);
  const DofIndex n   = it.cut.space->n_dofs();
  std::cout << n << " unknowns, " << it.lattice().values().size() << " lattice nodes: " << 1e3 * all
            << " ms\n";
  EXPECT_LT(all, 1e-5 * n);
}
} // namespace
} // namespace scree
