// The background grid: finding cells, refinement around contact.
#include <gtest/gtest.h>

#include <scree/base/exceptions.h>
#include <scree/grid/background_grid.h>
#include <scree/parameters/file.h>

#include <deal.II/base/mpi.h>

#include <random>

#include "../discretization/cut_bodies.h"

namespace scree
{
namespace
{
using namespace dealii;

/** Bodies are only needed to refine; a grid alone is enough here. */
template <int dim>
BodiesInput<dim>
two_balls(const unsigned int finest_level, const unsigned int coarsest_level,
          const std::string &more = "")
{
  const std::string zero = dim == 2 ? "" : ", 0";
  return BodiesInput<dim>::from_string(grid_text("-1, -1" + std::string(dim == 2 ? "" : ", -1"),
                                                 "1, 1" + std::string(dim == 2 ? "" : ", 1"),
                                                 dim == 2 ? "2, 2" : "2, 2, 2", finest_level,
                                                 graded_text(coarsest_level, more))
                                       + bodies_text({{"left", ball_text("-0.4, 0" + zero, 0.4)},
                                                      {"right", ball_text("0.4, 0" + zero, 0.4)}}));
}

/** A grid refined for its bodies. */
template <int dim>
struct RefinedGrid
{
  explicit RefinedGrid(const BodiesInput<dim> &input)
      : grid(input.grid, MPI_COMM_WORLD)
  {
    std::map<std::string, std::shared_ptr<const Material<dim>>> materials;
    for (const auto &[name, material] : input.materials)
      materials[name] = make_material<dim>(material);
    bodies = make_bodies<dim>(input.bodies, materials,
                              {input.grid.lower, grid.finest_size(), grid.box()}, 1.);
    grid.refine(bodies, {{0, 1}});
  }

  BackgroundGrid<dim>    grid;
  std::vector<Body<dim>> bodies;
};

template <int dim>
void
check_locate(const BackgroundGrid<dim> &grid)
{
  const unsigned int                     rank = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  std::mt19937                           engine(7);
  std::uniform_real_distribution<double> unit(0.001, 0.999);
  for (unsigned int c = 0; c < grid.cells().size(); ++c)
    for (unsigned int trial = 0; trial < 4; ++trial)
      {
        Point<dim> point = grid.cells()[c].lower;
        for (unsigned int d = 0; d < dim; ++d)
          point[d] += unit(engine) * grid.cells()[c].size;
        const auto found = grid.locate(point);
        EXPECT_EQ(found.local_cell, int(c));
        EXPECT_EQ(found.rank == rank, c < grid.n_owned_cells());
      }
  // Points of all processes: a cell is owned by exactly the process that locate() names.
  std::vector<Point<dim>> centres;
  for (unsigned int c = 0; c < grid.n_owned_cells(); ++c)
    centres.push_back(grid.cells()[c].centre());
  const auto   all = Utilities::MPI::all_gather(MPI_COMM_WORLD, centres);
  unsigned int n   = 0;
  for (unsigned int owner = 0; owner < all.size(); ++owner)
    for (const auto &point : all[owner])
      {
        EXPECT_EQ(grid.locate(point).rank, owner);
        ++n;
      }
  EXPECT_EQ(n, grid.triangulation().n_global_active_cells());
}

TEST(BackgroundGrid, LocatesEveryCell)
{
  check_locate(RefinedGrid<2>(two_balls<2>(6, 1)).grid);
  check_locate(RefinedGrid<3>(two_balls<3>(3, 1)).grid);
}

TEST(BackgroundGridMPI, LocatesEveryCell)
{
  check_locate(RefinedGrid<2>(two_balls<2>(6, 1)).grid);
  check_locate(RefinedGrid<3>(two_balls<3>(3, 1)).grid);
}

TEST(BackgroundGrid, PointsOutsideCountAsTheNearestInside)
{
  const RefinedGrid<2> model(two_balls<2>(5, 1));
  const auto          &grid = model.grid;
  EXPECT_EQ(grid.locate(Point<2>(-3., 0.3)).local_cell, grid.locate(Point<2>(-1., 0.3)).local_cell);
  EXPECT_EQ(grid.locate(Point<2>(1., 7.)).local_cell,
            grid.locate(Point<2>(0.999, 0.999)).local_cell);
}

TEST(BackgroundGrid, CellsAreExactMultiplesOfTheFinest)
{
  const RefinedGrid<2> model(two_balls<2>(6, 1));
  const double         h = model.grid.finest_size();
  EXPECT_EQ(h, 1. / 64.);
  double area = 0.;
  for (const auto &cell : model.grid.cells())
    {
      area += cell.size * cell.size;
      for (unsigned int d = 0; d < 2; ++d)
        {
          const double multiple = (cell.lower[d] + 1.) / cell.size;
          EXPECT_NEAR(multiple, std::round(multiple), 1e-12);
        }
    }
  EXPECT_NEAR(area, 4., 1e-12);
}

template <int dim>
void
check_grading(const RefinedGrid<dim> &model, const double band, const double grading)
{
  const double h       = model.grid.finest_size();
  double       largest = 0.;
  for (const auto &cell : model.grid.cells())
    {
      largest = std::max(largest, cell.size);
      // Everywhere in the cell, its size is allowed by the distance of its nearest point.
      const double distance = std::max(model.bodies[0].level_set.value(cell.centre(), 1),
                                       model.bodies[1].level_set.value(cell.centre(), 1))
                              - 0.5 * std::sqrt(double(dim)) * cell.size;
      EXPECT_LE(cell.size, (1. + 1e-9) * (h + grading * std::max(0., distance - band * h)));
      for (const unsigned int f : cell.iterator->face_indices())
        if (!cell.iterator->at_boundary(f))
          {
            EXPECT_LE(std::abs(cell.iterator->level() - cell.iterator->neighbor(f)->level()), 1);
          }
    }
  EXPECT_GE(largest, 4. * h);
}

TEST(BackgroundGrid, GrowsWithTheDistanceFromContact)
{
  check_grading(RefinedGrid<2>(two_balls<2>(6, 1)), 2., 0.5);
  check_grading(RefinedGrid<3>(two_balls<3>(4, 0)), 2., 0.5);
}

/** A grid made from another whose cells near a point are wanted `more` levels finer. */
template <int dim>
void
check_wanted_levels(const BackgroundGrid<dim> &old, const unsigned int more)
{
  std::vector<unsigned int> levels;
  for (unsigned int c = 0; c < old.n_owned_cells(); ++c)
    levels.push_back(old.cells()[c].iterator->level()
                     + (old.cells()[c].centre().distance(Point<dim>()) < 0.3 ? more : 0));
  const auto          wanted = std::make_shared<const WantedLevels>(old.wanted_levels(levels));
  BackgroundGrid<dim> grid(old.grid_parameters().with(wanted), MPI_COMM_WORLD);
  grid.refine({}, {});
  EXPECT_DOUBLE_EQ(grid.finest_size() * (1u << more), old.finest_size());
  check_locate(grid);
  // All that is wanted is there; what is finer than wanted has a finer neighbour.
  unsigned int n_wanted = 0;
  for (const auto &cell : grid.cells())
    {
      const auto location = old.locate(cell.centre());
      if (location.local_cell < 0 || location.local_cell >= int(old.n_owned_cells()))
        continue;
      const unsigned int level = cell.iterator->level();
      EXPECT_GE(level, levels[location.local_cell]);
      n_wanted += level == levels[location.local_cell];
    }
  EXPECT_GT(n_wanted, grid.cells().size() / (4 * Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD)));
  if (more == 0)
    {
      EXPECT_EQ(grid.triangulation().n_global_active_cells(),
                old.triangulation().n_global_active_cells());
    }
}

TEST(BackgroundGridMPI, WantedLevels)
{
  for (const unsigned int more : {0, 1, 2})
    {
      check_wanted_levels(RefinedGrid<2>(two_balls<2>(5, 1)).grid, more);
      check_wanted_levels(RefinedGrid<3>(two_balls<3>(3, 1)).grid, more);
    }
}

TEST(BackgroundGrid, CellSizeLimit)
{
  const RefinedGrid<2> model(two_balls<2>(6, 0, "set Cell size limit = if(y > 0.5, 0.0625, 10)\n"));
  unsigned int         n_above = 0;
  for (const auto &cell : model.grid.cells())
    if (cell.centre()[1] > 0.5)
      {
        ++n_above;
        EXPECT_LE(cell.size, 0.0625);
      }
  EXPECT_GT(n_above, 0u);
}

TEST(BackgroundGrid, WrongGridsAreExplained)
{
  const auto message = [](const std::string &text) -> std::string {
    try
      {
        ParameterFile     file    = ParameterFile::from_string(text);
        ParameterSection  section = file.root().subsection("Grid", "");
        GridParameters<2> parameters;
        parameters.declare(section);
        file.check();
      }
    catch (const UserError &error)
      {
        return error.what();
      }
    return "";
  };
  EXPECT_EQ(message(grid_text("0, 0", "2, 1", "4, 2", 3)), "");
  EXPECT_NE(message(grid_text("0, 0", "2, 1", "4, 4", 3)).find("not squares"), std::string::npos);
  EXPECT_NE(message(grid_text("0, 0", "2, 0", "4, 4", 3)).find("must lie above"),
            std::string::npos);
  EXPECT_NE(message(grid_text("0, 0", "1, 1", "4", 3)).find("2 positive numbers"),
            std::string::npos);
  EXPECT_NE(message(grid_text("0, 0", "1, 1", "4, 4", 3, "set Coarsest level = 4"))
              .find("exceeds Finest level"),
            std::string::npos);
  EXPECT_NE(message(grid_text("0, 0", "1, 1", "4, 4", 3, "set Cell size limit = 1 +"))
              .find("not a formula"),
            std::string::npos);
}
} // namespace
} // namespace scree
