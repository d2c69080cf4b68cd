#include <gtest/gtest.h>

#include <scree/points/moving_least_squares.h>
#include <scree/points/seeding.h>
#include <scree/points/splitting.h>

#include <deal.II/base/numbers.h>

#include <cmath>
#include <iostream>

#include "../discretization/cut_bodies.h"

namespace scree
{
namespace
{
using namespace dealii;

// Two discs or balls of radius 0.83, off-centre to the grid; text after the tests of other modules.
template <int dim>
std::string
two_balls(const unsigned int degree, const std::string &grid)
{
  const std::string z     = dim == 3 ? ", 0.013" : "";
  const std::string shape = dim == 2 ? "disc" : "ball";
  const auto        body  = [&](const std::string &name, const std::string &x) {
    return " subsection " + name + "\n set Material = m\n subsection Shape\n set Type = " + shape
           + "\n set Centre = " + x + ", 0.031" + z + "\n set Radius = 0.83\n end\n end\n";
  };
  return grid + "subsection Discretization\n set Degree = " + std::to_string(degree)
         + "\nend\nsubsection Materials\n set Names = m\n subsection m\n set Young's modulus = 1\n"
           " set Poisson's ratio = 0.3\n end\nend\nsubsection Bodies\n set Names = a, b\n"
         + body("a", "-0.87") + body("b", "0.84") + "end\n";
}

// Volumes of each cell and body against the cut quadrature, masses against the exact volume; all
// points in the body and in their cell; enough of them.
template <int dim>
void
check_seeding(const unsigned int degree, const std::string &grid)
{
  const CutBodies<dim>      model(two_balls<dim>(degree, grid));
  const CutQuadrature<dim>  quadrature(*model.space, *model.level_set_nodes, model.bodies);
  const std::vector<double> density = {2., 3.};
  const PointSeeding<dim>   seeding(*model.space, *model.level_set_nodes, model.bodies, quadrature,
                                    density);
  std::vector<double>       exact(model.space->n_owned_cells());
  for (unsigned int a = 0; a < exact.size(); ++a)
    {
      const auto &cell = model.space->cells()[a];
      if (!cell.is_cut)
        exact[a] = std::pow(model.grid.cells()[cell.grid_cell].size, dim);
      for (unsigned int q = quadrature.bulk.begin[a]; q < quadrature.bulk.begin[a + 1]; ++q)
        exact[a] += quadrature.bulk.weights[q];
    }

  for (unsigned int m = 0; m <= 3; ++m) // 0: at the quadrature points
    {
      const auto points = m == 0 ? seeding.at_quadrature_points(2) : seeding.on_sub_grid(m, 2);
      std::vector<double> volume(exact.size());
      double              outside = -1.;
      for (std::size_t i = 0; i < points.size(); ++i)
        {
          const int a = model.space->nearest_active_cell(points.position[i], points.body[i]);
          ASSERT_GE(a, 0);
          EXPECT_GT(points.initial_volume[i], 0.);
          if (!model.space->cells()[a].is_cut)
            EXPECT_EQ(points.mass[i], density[points.body[i]] * points.initial_volume[i]);
          volume[a] += points.initial_volume[i];
          const double h = model.grid.cells()[model.space->cells()[a].grid_cell].size;
          const double phi
            = model.bodies[points.body[i]].level_set.value(points.position[i], degree);
          outside = std::max(outside, phi / h);
        }
      double error = 0., total[2] = {};
      for (unsigned int a = 0; a < exact.size(); ++a)
        {
          const double h = model.grid.cells()[model.space->cells()[a].grid_cell].size;
          error          = std::max(error, std::abs(volume[a] - exact[a]) / std::pow(h, dim));
          total[model.space->cells()[a].body] += exact[a];
        }
      const auto totals = points.totals(2);
      std::cout << "  " << dim << "D, degree " << degree << ", m = " << m << ": " << points.size()
                << " points in " << exact.size() << " cells, volume error of a cell " << error
                << " h^dim, largest phi " << outside << " h" << std::endl;
      EXPECT_LT(error, 1e-14);
      EXPECT_LT(outside, 0.01);
      for (unsigned int b = 0; b < 2; ++b)
        {
          EXPECT_NEAR(totals[b].volume, total[b], 1e-12);
          const double whole
            = dim == 2 ? numbers::PI * 0.83 * 0.83 : 4. / 3. * numbers::PI * std::pow(0.83, 3);
          std::cout << "    mass " << totals[b].mass / (density[b] * whole) - 1. << ", volume "
                    << total[b] / whole - 1. << std::endl;
          EXPECT_NEAR(totals[b].mass, density[b] * whole, (dim == 2 ? 1e-3 : 4e-3) * whole);
        }
    }
}

TEST(PointSeeding, volumes_of_cells)
{
  for (const unsigned int degree : {1, 2})
    check_seeding<2>(degree, grid_text("-2, -1", "2, 1", "4, 2", 3));
  check_seeding<2>(1, grid_text("-2, -1", "2, 1", "4, 2", 4, graded_text(2)));
  check_seeding<3>(1, grid_text("-2, -1, -1", "2, 1, 1", "4, 2, 2", 2));
}

// From seeded points to what the mechanics asks for: quadrature points of cut and whole cells and
// the surface. Fields of the basis are exact, on uniform and graded grids.
template <int dim>
void
check_transfer(const unsigned int degree, const std::string &grid)
{
  const CutBodies<dim>      model(two_balls<dim>(degree, grid));
  const CutQuadrature<dim>  quadrature(*model.space, *model.level_set_nodes, model.bodies);
  const std::vector<double> density = {1., 1.};
  const PointSeeding<dim>   seeding(*model.space, *model.level_set_nodes, model.bodies, quadrature,
                                    density);
  Targets<dim>              targets;
  for (unsigned int a = 0; a < model.space->n_owned_cells(); ++a)
    {
      const auto &active = model.space->cells()[a];
      const auto &cell   = model.grid.cells()[active.grid_cell];
      const auto  add    = [&](const Point<dim> &unit) {
        targets.position.push_back(cell.lower + cell.size * Tensor<1, dim>(unit));
        targets.body.push_back(active.body);
        targets.cell_size.push_back(cell.size);
      };
      for (const auto *cache : {&quadrature.bulk, &quadrature.surface})
        for (unsigned int q = cache->begin[a]; q < cache->begin[a + 1]; ++q)
          add(cache->points[q]);
      if (!active.is_cut)
        for (const auto &unit : quadrature.whole_cell.points)
          add(unit);
    }
  const std::vector<unsigned int> seedings
    = dim == 2 ? std::vector<unsigned int>{0, 2, 3} : std::vector<unsigned int>{2};
  for (const unsigned int m : seedings) // 0: at the quadrature points
    {
      const auto points = m == 0 ? seeding.at_quadrature_points(0) : seeding.on_sub_grid(m, 0);
      const auto weights
        = moving_least_squares(points, MovingLeastSquaresOptions{degree, 1.75}).weights(targets);
      const auto field = [&](const Point<dim> &x, const unsigned int body) {
        const double linear = 1. + x[0] - 0.5 * x[dim - 1];
        return body + (degree == 1 ? linear : linear * (0.3 - x[1]));
      };
      std::vector<double> values;
      for (std::size_t i = 0; i < points.size(); ++i)
        values.push_back(field(points.position[i], points.body[i]));
      const auto transferred = weights.values(values);
      double     error       = 0.;
      for (std::size_t t = 0; t < targets.position.size(); ++t)
        error
          = std::max(error, std::abs(transferred[t] - field(targets.position[t], targets.body[t])));
      std::cout << "  " << dim << "D, degree " << degree << ", m = " << m << ": "
                << targets.position.size() << " targets, "
                << double(weights.points.size()) / weights.n_targets() << " neighbours, error "
                << error << ", amplification " << weights.report.largest_amplification
                << ", widened " << weights.report.widened << std::endl;
      EXPECT_LT(error, 1e-12);
      EXPECT_EQ(weights.report.lowered, 0u);
    }
}

TEST(PointSeeding, transfer_to_cut_cells_and_surfaces)
{
  for (const unsigned int degree : {1, 2})
    {
      check_transfer<2>(degree, grid_text("-2, -1", "2, 1", "4, 2", 3));
      check_transfer<2>(degree, grid_text("-2, -1", "2, 1", "4, 2", 4, graded_text(2)));
      check_transfer<3>(degree, grid_text("-2, -1, -1", "2, 1, 1", "4, 2, 2", 2));
    }
}
} // namespace
} // namespace scree
