// The bodies near the cells, against all cells times all bodies.
#include <gtest/gtest.h>

#include <scree/grid/background_grid.h>
#include <scree/grid/cell_bodies.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <map>
#include <vector>

namespace scree
{
namespace
{
using namespace dealii;

/** Boxes along a spiral, of edges 0.05 to 0.6. */
template <int dim>
std::vector<BoundingBox<dim>>
scattered_boxes(const unsigned int n)
{
  std::vector<BoundingBox<dim>> boxes;
  for (unsigned int b = 0; b < n; ++b)
    {
      const double angle = 0.7 * b, radius = 0.9 * b / n;
      Point<dim>   centre;
      centre[0] = 0.03 + radius * std::cos(angle);
      centre[1] = -0.02 + radius * std::sin(angle);
      if (dim == 3)
        centre[2] = 0.8 * std::cos(1.3 * b);
      boxes.push_back(BoundingBox<dim>({centre, centre}));
      boxes.back().extend(0.025 + 0.275 * std::pow(std::sin(b), 2));
    }
  return boxes;
}

template <int dim>
void
expect_all_found()
{
  GridParameters<dim> parameters;
  for (unsigned int d = 0; d < dim; ++d)
    {
      parameters.lower[d] = -1.;
      parameters.upper[d] = 1.;
    }
  parameters.cells.assign(dim, 2);
  parameters.refinement   = GridRefinement::uniform;
  parameters.finest_level = dim == 2 ? 4 : 3;
  const BackgroundGrid<dim> grid(parameters, MPI_COMM_WORLD);
  const auto                boxes = scattered_boxes<dim>(40);
  const auto                reach = [](const double size) { return 0.02 + size; };
  std::map<unsigned int, std::vector<unsigned int>> found;
  CellBodies<dim>(BodyBoxes<dim>(boxes))
    .visit(grid.triangulation(), reach,
           [&](const auto &cell, const std::vector<unsigned int> &near) {
             EXPECT_TRUE(found.emplace(grid.local_index(*cell), near).second);
           });
  unsigned int n_found = 0;
  for (unsigned int c = 0; c < grid.n_owned_cells(); ++c)
    {
      const GridCell<dim>      &cell = grid.cells()[c];
      std::vector<unsigned int> expected;
      for (unsigned int b = 0; b < boxes.size(); ++b)
        {
          bool is_near = true;
          for (unsigned int d = 0; d < dim; ++d)
            is_near &= cell.lower[d] - reach(cell.size) <= boxes[b].upper_bound(d)
                       && cell.lower[d] + cell.size + reach(cell.size) >= boxes[b].lower_bound(d);
          if (is_near)
            expected.push_back(b);
        }
      EXPECT_EQ(found.count(c) == 0 ? std::vector<unsigned int>() : found[c], expected) << c;
      n_found += expected.size();
    }
  EXPECT_GT(Utilities::MPI::sum(n_found, MPI_COMM_WORLD), 1000u);
}

TEST(CellBodiesMPI, AreThoseWhoseBoxesAreNear)
{
  expect_all_found<2>();
  expect_all_found<3>();
}
} // namespace
} // namespace scree
