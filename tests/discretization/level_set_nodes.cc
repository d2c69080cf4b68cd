// Level sets on grids with hanging nodes: continuous over all faces, contours closed.
#include <gtest/gtest.h>

#include <scree/bodies/rigid_placement.h>
#include <scree/discretization/cut_quadrature.h>

#include <cmath>

#include "cut_bodies.h"

namespace scree
{
namespace
{
using namespace dealii;

/** A ball that is cut by cells of several levels. */
template <int dim>
std::string
graded_ball(const unsigned int finest_level, const unsigned int degree)
{
  const std::string zero = dim == 2 ? "" : ", 0.01", cells = dim == 2 ? "2, 2" : "2, 2, 2";
  const std::string limit = "set Cell size limit = if(x > 0.1, "
                            + std::to_string(std::pow(0.5, finest_level)) + ", 10)\n";
  const unsigned int coarsest = finest_level > 2 ? finest_level - 2 : 1;
  return grid_text(dim == 2 ? "-1, -1" : "-1, -1, -1", dim == 2 ? "1, 1" : "1, 1, 1", cells,
                   finest_level, graded_text(coarsest, limit))
         + degree_text(degree) + bodies_text({{"ball", ball_text("0.013, -0.021" + zero, 0.61)}});
}

/** The largest jump of phi over a face, relative to the cell size, and whether levels differ. */
template <int dim>
void
check_continuity(const CutBodies<dim> &model)
{
  const auto         &lattice = model.bodies[0].level_set;
  const auto         &basis   = model.level_set_nodes->basis();
  std::vector<double> here(basis.n_nodes), there(basis.n_nodes), shape(basis.n_nodes);
  unsigned int        n_hanging_cut = 0;
  const auto          value = [&](const std::vector<double> &nodal, const Point<dim> &unit) {
    basis.evaluate_values(unit, shape.data());
    double sum = 0.;
    for (unsigned int i = 0; i < basis.n_nodes; ++i)
      sum += shape[i] * nodal[i];
    return sum;
  };
  for (unsigned int c = 0; c < model.grid.n_owned_cells(); ++c)
    {
      const auto &cell = model.grid.cells()[c];
      for (const unsigned int f : cell.iterator->face_indices())
        {
          if (cell.iterator->at_boundary(f) || cell.iterator->neighbor(f)->has_children())
            continue;
          const unsigned int n     = model.grid.local_index(*cell.iterator->neighbor(f));
          const auto        &other = model.grid.cells()[n];
          model.level_set_nodes->cell_values(c, lattice, here.data());
          model.level_set_nodes->cell_values(n, lattice, there.data());
          bool positive = false, negative = false;
          for (unsigned int i = 0; i < 5; ++i)
            for (unsigned int j = 0; j < (dim == 2 ? 1 : 5); ++j)
              {
                Point<dim> unit;
                unit[f / 2]             = f % 2;
                unit[(f / 2 + 1) % dim] = 0.1 + 0.2 * i;
                if (dim == 3)
                  unit[(f / 2 + 2) % dim] = 0.1 + 0.2 * j;
                const Point<dim> x   = cell.lower + cell.size * Tensor<1, dim>(unit);
                const double     phi = value(here, unit);
                EXPECT_NEAR(phi, value(there, Point<dim>((x - other.lower) / other.size)), 1e-13);
                positive |= phi > 0.;
                negative |= phi < 0.;
              }
          n_hanging_cut += other.size > 1.5 * cell.size && positive && negative;
        }
    }
  EXPECT_GT(n_hanging_cut, 0u) << "no hanging face is cut: the test tests nothing";
}

TEST(LevelSetNodes, ContinuousOverHangingFaces)
{
  for (const unsigned int degree : {1, 2})
    {
      check_continuity(CutBodies<2>(graded_ball<2>(5, degree)));
      check_continuity(CutBodies<3>(graded_ball<3>(3, degree)));
    }
}

double
perimeter_error(const unsigned int finest_level, const unsigned int degree)
{
  const CutBodies<2>     model(graded_ball<2>(finest_level, degree));
  const CutQuadrature<2> quadrature(*model.space, *model.level_set_nodes, model.bodies);
  double                 perimeter = 0.;
  for (const double weight : quadrature.surface.weights)
    perimeter += weight;
  return std::abs(perimeter / (2. * M_PI * 0.61) - 1.);
}

TEST(LevelSetNodes, PerimeterOnGradedGridsConverges)
{
  for (const unsigned int degree : {1, 2})
    {
      const double coarse = perimeter_error(4, degree), fine = perimeter_error(6, degree);
      std::cout << "  degree " << degree << ": perimeter errors " << coarse << ", " << fine << "\n";
      EXPECT_GT(std::log2(coarse / fine) / 2., degree == 1 ? 1.8 : 2.8);
    }
}

TEST(LevelSetNodes, ClassifiesCells)
{
  const CutBodies<2> model(grid_text("0, 0", "1, 1", "4, 4", 0) + degree_text(1)
                           + bodies_text({{"half", half_space_text("0, 0.5", "0, 1")}}));
  // The surface lies on the line y = 1/2: cells below are cut, cells above are outside.
  for (unsigned int c = 0; c < model.grid.n_owned_cells(); ++c)
    {
      const double y = model.grid.cells()[c].lower[1];
      EXPECT_EQ(model.level_set_nodes->cut(c, model.bodies[0]).location,
                y < 0.2   ? CellLocation::inside
                : y < 0.4 ? CellLocation::cut
                          : CellLocation::outside);
    }
}

/** A turned plate of less than two cells, seen from one side: the distance from that face alone. */
TEST(LevelSetNodes, ThinRigidPlateShowsTheFaceThatLooksTowards)
{
  for (const unsigned int degree : {1, 2})
    {
      CutBodies<2> model(
        grid_text("-1, -1", "1, 1", "2, 2", 3) + degree_text(degree)
        + bodies_text({{"plate", motion_text("") + box_text("-0.1, -0.8", "0.1, 0.8")},
                       {"ball", ball_text("0.7, 0.7", 0.2)}}));
      Body<2>     &plate = model.bodies[0];
      const double h     = model.grid.finest_size();
      place_rigid_body(plate, {0.03, 0.02, 0.4}, {Point<2>(-1, -1), h / degree, model.grid.box()},
                       6. * h);
      ASSERT_GT(std::abs(plate.pose.rotation()[2]), 0.3);
      const Tensor<1, 2>  normal = plate.pose.initial_gradient()[0];
      const auto         &basis  = model.level_set_nodes->basis();
      std::vector<double> values(basis.n_nodes);
      unsigned int        n_nodes = 0;
      for (unsigned int c = 0; c < model.grid.n_owned_cells(); ++c)
        {
          const auto &cell = model.grid.cells()[c];
          model.level_set_nodes->facing_values(c, plate, normal, values.data());
          for (unsigned int i = 0; i < basis.n_nodes; ++i)
            {
              const Point<2> X
                = plate.pose.initial_position(cell.lower + cell.size * Tensor<1, 2>(basis.node(i)));
              if (std::abs(X[0]) > 0.3 || std::abs(X[1]) > 0.4)
                continue;
              // Farther than half a cell behind the plate nothing faces.
              const bool is_behind = -0.1 - X[0] > 0.5 * h;
              EXPECT_NEAR(values[i], is_behind ? -0.1 - X[0] : X[0] - 0.1, 1e-12)
                << "at " << X << ", degree " << degree;
              ++n_nodes;
            }
        }
      EXPECT_GT(n_nodes, 50u);
    }
}
} // namespace
} // namespace scree
