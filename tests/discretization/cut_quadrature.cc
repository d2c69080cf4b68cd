// Rules on cut cells: orders on discs and balls, boundaries on grid lines, faces, closed contours.
#include <gtest/gtest.h>

#include <scree/discretization/cut_quadrature.h>

#include <cmath>
#include <iostream>
#include <random>

#include "cut_bodies.h"

namespace scree
{
namespace
{
using namespace dealii;

/** Volume and surface of body 0. */
struct Measure
{
  double volume = 0., surface = 0.;
};

template <int dim>
Measure
measure(const CutBodies<dim> &model)
{
  const CutQuadrature<dim> quadrature(*model.space, *model.level_set_nodes, model.bodies);
  Measure                  result;
  for (unsigned int a = 0; a < model.space->n_owned_cells(); ++a)
    {
      const auto  &cell = model.space->cells()[a];
      const double size = model.grid.cells()[cell.grid_cell].size;
      if (!cell.is_cut)
        result.volume += std::pow(size, dim);
      for (unsigned int q = quadrature.bulk.begin[a]; q < quadrature.bulk.begin[a + 1]; ++q)
        {
          EXPECT_GT(quadrature.bulk.weights[q], 0.);
          result.volume += quadrature.bulk.weights[q];
        }
      for (unsigned int q = quadrature.surface.begin[a]; q < quadrature.surface.begin[a + 1]; ++q)
        {
          EXPECT_NEAR(quadrature.surface.normals[q].norm(), 1., 1e-12);
          result.surface += quadrature.surface.weights[q];
        }
    }
  return result;
}

/** Mean order of the errors over the levels, of which level 0 has cells of 1/2; with a table. */
template <int dim>
Measure
orders(const std::string &centre, const double radius, const unsigned int degree,
       const unsigned int first_level, const unsigned int n_levels)
{
  const double volume  = dim == 2 ? M_PI * radius * radius : 4. / 3. * M_PI * std::pow(radius, 3);
  const double surface = dim == 2 ? 2. * M_PI * radius : 4. * M_PI * radius * radius;
  const auto   all
    = [](const std::string &x) { return dim == 2 ? x + ", " + x : x + ", " + x + ", " + x; };
  const std::string    cells = all("3");
  std::vector<Measure> errors;
  for (unsigned int level = first_level; level < first_level + n_levels; ++level)
    {
      const CutBodies<dim> model(grid_text(all("-0.75"), all("0.75"), cells, level)
                                 + degree_text(degree)
                                 + bodies_text({{"ball", ball_text(centre, radius)}}));
      const Measure        found = measure(model);
      errors.push_back(
        {std::abs(found.volume / volume - 1.), std::abs(found.surface / surface - 1.)});
      std::cout << "  dim " << dim << ", degree " << degree << ", h " << model.grid.finest_size()
                << ": volume " << errors.back().volume << ", surface " << errors.back().surface
                << "\n";
    }
  const double n = n_levels - 1.;
  return {std::log2(errors.front().volume / errors.back().volume) / n,
          std::log2(errors.front().surface / errors.back().surface) / n};
}

TEST(CutQuadrature, DiscOfDegreeOneIsSecondOrder)
{
  const Measure order = orders<2>("0.013, -0.021", 0.61, 1, 2, 4);
  EXPECT_GT(order.volume, 1.9);
  EXPECT_GT(order.surface, 1.9);
}

TEST(CutQuadrature, DiscOfDegreeTwoIsFourthOrder)
{
  const Measure order = orders<2>("0.013, -0.021", 0.61, 2, 2, 4);
  EXPECT_GT(order.volume, 3.7);
  EXPECT_GT(order.surface, 3.7);
}

TEST(CutQuadrature, BallOfDegreeOneIsSecondOrder)
{
  const Measure order = orders<3>("0.013, -0.021, 0.017", 0.61, 1, 1, 3);
  EXPECT_GT(order.volume, 1.9);
  EXPECT_GT(order.surface, 1.9);
}

TEST(CutQuadrature, BallOfDegreeTwoIsFourthOrder)
{
  const Measure order = orders<3>("0.013, -0.021, 0.017", 0.61, 2, 1, 2);
  EXPECT_GT(order.volume, 3.5);
  EXPECT_GT(order.surface, 3.5);
}

TEST(CutQuadrature, PlanesOnGridLinesAreCountedOnce)
{
  for (const unsigned int degree : {1, 2})
    for (const std::string normal : {"0, 1", "0, -1", "1, 0", "-1, 0"})
      {
        const CutBodies<2> model(grid_text("-1, -1", "1, 1", "2, 2", 3) + degree_text(degree)
                                 + bodies_text({{"half", half_space_text("0.25, 0.25", normal)}}));
        const Measure      found = measure(model);
        EXPECT_NEAR(found.surface, 2., 1e-12);
        EXPECT_NEAR(found.volume, normal.find('-') == std::string::npos ? 2.5 : 1.5, 1e-8);
      }
  const CutBodies<3> model(
    grid_text("-1, -1, -1", "1, 1, 1", "2, 2, 2", 2) + degree_text(1)
    + bodies_text({{"half", half_space_text("0.25, 0.25, 0.25", "0, 0, 1")}}));
  EXPECT_NEAR(measure(model).surface, 4., 1e-12);
}

TEST(CutQuadrature, SquareOnGridLines)
{
  for (const unsigned int degree : {1, 2})
    {
      const CutBodies<2>     model(grid_text("-1, -1", "1, 1", "2, 2", 3) + degree_text(degree)
                                   + bodies_text({{"square", box_text("-0.5, -0.25", "0.5, 0.75")}}));
      const Point<2>         middle(0., 0.25);
      const double           h = model.grid.finest_size();
      const CutQuadrature<2> quadrature(*model.space, *model.level_set_nodes, model.bodies);
      double                 sides = 0., corners = 0.;
      for (unsigned int a = 0; a < model.space->n_owned_cells(); ++a)
        {
          const auto &cell      = model.grid.cells()[model.space->cells()[a].grid_cell];
          const bool  is_corner = std::min(std::abs(cell.lower[0] + 0.5 * h - middle[0]),
                                           std::abs(cell.lower[1] + 0.5 * h - middle[1]))
                                 > 0.5 - 0.6 * h;
          for (unsigned int q = quadrature.surface.begin[a]; q < quadrature.surface.begin[a + 1];
               ++q)
            (is_corner ? corners : sides) += quadrature.surface.weights[q];
        }
      EXPECT_NEAR(sides, 4. - 8. * h, 1e-12);
      EXPECT_NEAR(corners, 8. * h, 1e-12);
      EXPECT_NEAR(measure(model).volume, 1., 1e-8);
    }
}

/** Volume, surface and first moments of the part of the unit cell where phi < 0. */
template <int dim>
void
check_inside_and_outside(const unsigned int degree)
{
  const LagrangeBasis<dim>               basis(degree);
  CutCellRules<dim>                      rules(basis, {degree + 1, degree + 1});
  std::mt19937                           engine(3);
  std::uniform_real_distribution<double> number(-1., 1.);
  for (unsigned int trial = 0; trial < 50; ++trial)
    {
      // A sphere through the cell: curved, smooth, cut in all ways.
      Point<dim> centre, middle;
      for (unsigned int d = 0; d < dim; ++d)
        {
          centre[d] = 3. * number(engine);
          middle[d] = 0.5 + 0.4 * number(engine);
        }
      std::vector<double> phi(basis.n_nodes), opposite(basis.n_nodes);
      unsigned int        n_negative = 0;
      for (unsigned int i = 0; i < basis.n_nodes; ++i)
        {
          phi[i]      = basis.node(i).distance(centre) - middle.distance(centre);
          opposite[i] = -phi[i];
          n_negative += phi[i] < 0.;
        }
      if (n_negative == 0 || n_negative == basis.n_nodes)
        continue;
      const double size    = 0.5;
      const auto   inside  = rules.rules(phi.data(), size);
      const auto   outside = rules.rules(opposite.data(), size);
      double       volume = 0., surface = 0.;
      for (const double weight : inside.inside.weights)
        volume += weight;
      for (const double weight : outside.inside.weights)
        volume += weight;
      for (const double weight : inside.surface.weights)
        surface += weight;
      for (const double weight : outside.surface.weights)
        surface -= weight;
      EXPECT_NEAR(volume, std::pow(size, dim), 1e-12);
      EXPECT_NEAR(surface, 0., 1e-12);
      for (const auto &point : inside.inside.points)
        for (unsigned int d = 0; d < dim; ++d)
          EXPECT_TRUE(point[d] >= 0. && point[d] <= 1.);
    }
}

TEST(CutQuadrature, InsideAndOutsideFillTheCell)
{
  check_inside_and_outside<2>(1);
  check_inside_and_outside<2>(2);
  check_inside_and_outside<3>(1);
  check_inside_and_outside<3>(2);
}

/** The square clipped by a linear function: area and centroid times area (Sutherland, Hodgman). */
struct Clipped
{
  double   area = 0.;
  Point<2> moment;
};

Clipped
clip_square(const std::function<double(const Point<2> &)> &phi)
{
  const std::vector<Point<2>> square = {{0., 0.}, {1., 0.}, {1., 1.}, {0., 1.}};
  std::vector<Point<2>>       part;
  for (unsigned int i = 0; i < 4; ++i)
    {
      const Point<2> a = square[i], b = square[(i + 1) % 4];
      if (phi(a) < 0.)
        part.push_back(a);
      if ((phi(a) < 0.) != (phi(b) < 0.))
        part.push_back(a + phi(a) / (phi(a) - phi(b)) * (b - a));
    }
  Clipped result;
  for (unsigned int i = 0; i < part.size(); ++i)
    {
      const Point<2> a = part[i], b = part[(i + 1) % part.size()];
      const double   cross = 0.5 * (a[0] * b[1] - a[1] * b[0]);
      result.area += cross;
      result.moment += cross / 3. * Tensor<1, 2>(a + b);
    }
  return result;
}

TEST(CutQuadrature, FaceRulesIntegrateLinearFunctions3D)
{
  std::mt19937                           engine(5);
  std::uniform_real_distribution<double> number(-1., 1.);
  for (const unsigned int degree : {1, 2})
    {
      const LagrangeBasis<3> basis(degree);
      CutCellRules<3>        rules(basis, {degree + 1, degree + 1});
      unsigned int           n_cut = 0;
      for (unsigned int trial = 0; trial < 60; ++trial)
        {
          const Tensor<1, 3>  normal({number(engine), number(engine), number(engine)});
          const double        offset = 0.5 * (normal[0] + normal[1] + normal[2] + number(engine));
          const auto          phi    = [&](const Point<3> &x) { return normal * x - offset; };
          std::vector<double> nodal(basis.n_nodes);
          for (unsigned int i = 0; i < basis.n_nodes; ++i)
            nodal[i] = phi(basis.node(i));
          for (unsigned int face = 0; face < 6; ++face)
            {
              const unsigned int normal_axis = face / 2, u = normal_axis == 0 ? 1 : 0,
                                 v = normal_axis == 2 ? 1 : 2;
              const auto embed     = [&](const Point<2> &x) {
                Point<3> result;
                result[normal_axis] = face % 2;
                result[u]           = x[0];
                result[v]           = x[1];
                return result;
              };
              const Clipped exact = clip_square([&](const auto &x) { return phi(embed(x)); });
              n_cut += exact.area > 0.01 && exact.area < 0.99;
              constexpr double size  = 0.25;
              const auto       found = rules.face_rule(nodal.data(), size, face);
              double           area  = 0.;
              Tensor<1, 3>     moment, outward;
              outward[normal_axis] = face % 2 == 0 ? -1. : 1.;
              for (unsigned int q = 0; q < found.points.size(); ++q)
                {
                  area += found.weights[q];
                  moment += found.weights[q] * found.points[q];
                  EXPECT_LE((found.normals[q] - outward).norm(), 1e-14);
                }
              EXPECT_NEAR(area, size * size * exact.area, 1e-12);
              EXPECT_NEAR(moment[u], size * size * exact.moment[0], 1e-12);
              EXPECT_NEAR(moment[v], size * size * exact.moment[1], 1e-12);
              EXPECT_NEAR(moment[normal_axis], size * size * exact.area * (face % 2), 1e-12);
            }
        }
      EXPECT_GT(n_cut, 60u);
    }
}

TEST(CutQuadrature, FaceRulesIntegrateLinearFunctions2D)
{
  const LagrangeBasis<2> basis(1);
  CutCellRules<2>        rules(basis, {2, 2});
  // phi = x + 2 y - 1.4: the face x = 1 is inside below y = 0.2, the face y = 0 everywhere.
  std::vector<double> nodal(4);
  for (unsigned int i = 0; i < 4; ++i)
    nodal[i] = basis.node(i)[0] + 2. * basis.node(i)[1] - 1.4;
  const std::vector<double> length = {0.7, 0.2, 1., 0.};
  for (unsigned int face = 0; face < 4; ++face)
    {
      const auto   found = rules.face_rule(nodal.data(), 0.5, face);
      double       sum   = 0.;
      Tensor<1, 2> moment;
      for (unsigned int q = 0; q < found.points.size(); ++q)
        {
          sum += found.weights[q];
          moment += found.weights[q] * found.points[q];
        }
      EXPECT_NEAR(sum, 0.5 * length[face], 1e-14);
      EXPECT_NEAR(moment[1 - face / 2], 0.25 * length[face] * length[face], 1e-14);
      EXPECT_NEAR(moment[face / 2], 0.5 * length[face] * (face % 2), 1e-14);
    }
}

/** The area of a disc or volume of a ball, with degrees of their own for displacement and phi. */
template <int dim>
double
measured_volume(const std::string &degree, const std::string &level_set_degree,
                const unsigned int level)
{
  const auto all
    = [](const std::string &x) { return dim == 2 ? x + ", " + x : x + ", " + x + ", " + x; };
  const CutBodies<dim> model(
    grid_text(all("-1"), all("1"), all("2"), level) + "subsection Discretization\n set Degree = "
    + degree + "\n set Level set degree = " + level_set_degree + "\nend\n"
    + bodies_text({{"ball", ball_text(dim == 2 ? "0.013, 0.021" : "0.013, 0.021, 0.008", 0.7)}}));
  EXPECT_EQ(model.space->basis.degree, std::stoul(degree));
  return measure(model).volume;
}

template <int dim>
void
check_order_of_level_sets(const unsigned int level)
{
  const double exact = dim == 2 ? M_PI * 0.49 : 4. / 3. * M_PI * 0.343;
  const auto   error
    = [&](const std::string &degree, const std::string &of_level_sets, const unsigned int level) {
        return std::abs(measured_volume<dim>(degree, of_level_sets, level) - exact);
      };
  const double coarse = error("1", "2", level), fine = error("1", "2", level + 2);
  std::cout << "  " << dim << "D: " << coarse << ", " << fine << "\n";
  EXPECT_GT(std::log2(coarse / fine) / 2., 2.8);
  EXPECT_LT(fine, 0.05 * error("1", "as displacement", level + 2));
  const double linear = error("2", "1", level + 1), of_degree_1 = error("1", "1", level + 1);
  EXPECT_NEAR(linear, of_degree_1, 0.02 * of_degree_1);
}

TEST(CutQuadrature, VolumeIsOfTheDegreeOfLevelSets)
{
  check_order_of_level_sets<2>(2);
  check_order_of_level_sets<3>(1);
}

TEST(CutQuadrature, BulkAndSurfaceHaveTheirOwnGaussPoints)
{
  const LagrangeBasis<2> basis(2);
  std::vector<double>    phi(basis.n_nodes);
  for (unsigned int i = 0; i < basis.n_nodes; ++i)
    phi[i] = basis.node(i).distance(Point<2>(-0.3, -0.2)) - 0.8;
  const auto mixed = CutCellRules<2>(basis, {2, 3}).rules(phi.data(), 0.5),
             two   = CutCellRules<2>(basis, {2, 2}).rules(phi.data(), 0.5),
             three = CutCellRules<2>(basis, {3, 3}).rules(phi.data(), 0.5);
  EXPECT_EQ(mixed.inside.points, two.inside.points);
  EXPECT_EQ(mixed.inside.weights, two.inside.weights);
  EXPECT_EQ(mixed.surface.points, three.surface.points);
  EXPECT_EQ(mixed.surface.normals, three.surface.normals);
  EXPECT_LT(two.surface.points.size(), three.surface.points.size());

  const CutBodies<2>     model(grid_text("-1, -1", "1, 1", "4, 4", 1)
                               + "subsection Discretization\n set Bulk Gauss points = 4\nend\n"
                               + bodies_text({{"disc", ball_text("0.013, 0.021", 0.7)}}));
  const CutQuadrature<2> quadrature(*model.space, *model.level_set_nodes, model.bodies);
  EXPECT_EQ(quadrature.whole_cell.points.size(), 16u);
  EXPECT_EQ(model.level_set_nodes->gauss().surface, 2u);
}
} // namespace
} // namespace scree
