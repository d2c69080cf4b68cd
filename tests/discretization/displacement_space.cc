// Displacement spaces: colours of bodies, numbering of unknowns, evaluation at points anywhere.
#include <gtest/gtest.h>

#include <scree/discretization/displacement_space.h>

#include <deal.II/base/mpi.h>

#include <random>

#include "cut_bodies.h"

namespace scree
{
namespace
{
using namespace dealii;

std::string
two_discs(const double distance, const unsigned int degree = 1, const std::string &more = "")
{
  const auto number = [](const double x) { return std::to_string(x); };
  return grid_text("-1, -1", "1, 1", "4, 4", 3, more) + degree_text(degree)
         + bodies_text({{"left", ball_text(number(-0.35 - 0.5 * distance) + ", 0.01", 0.35)},
                        {"right", ball_text(number(0.35 + 0.5 * distance) + ", 0", 0.35)}});
}

TEST(DisplacementSpace, ColoursOfBodies)
{
  const CutBodies<2> touching(two_discs(0.)), apart(two_discs(0.5));
  EXPECT_EQ(touching.space->n_fields(), 2u);
  EXPECT_NE(touching.space->field_of_body(0), touching.space->field_of_body(1));
  EXPECT_EQ(apart.space->n_fields(), 1u);
  // Each active cell of a field belongs to one body.
  for (const CutBodies<2> *model : {&touching, &apart})
    for (unsigned int a = 0; a < model->space->cells().size(); ++a)
      {
        const auto &cell = model->space->cells()[a];
        EXPECT_EQ(model->space->active_cell(cell.grid_cell, cell.body), int(a));
        EXPECT_EQ(cell.field, model->space->field_of_body(cell.body));
      }
}

TEST(DisplacementSpace, ChainOfBodiesNeedsTwoFields)
{
  std::vector<std::pair<std::string, std::string>> bodies;
  for (unsigned int i = 0; i < 5; ++i)
    bodies.emplace_back("grain " + std::to_string(i),
                        ball_text(std::to_string(-0.8 + 0.4 * i) + ", 0", 0.2));
  const CutBodies<2> model(grid_text("-1, -1", "1, 1", "4, 4", 3) + degree_text(1)
                           + bodies_text(bodies));
  EXPECT_EQ(model.space->n_fields(), 2u);
  for (unsigned int i = 0; i < 4; ++i)
    EXPECT_NE(model.space->field_of_body(i), model.space->field_of_body(i + 1));
}

/** Unknowns of all nodes of this process's cells, with their positions. */
template <int dim>
std::map<DofIndex, Point<dim>>
positions(const DisplacementSpace<dim> &space)
{
  std::map<DofIndex, Point<dim>> result;
  for (unsigned int a = 0; a < space.cells().size(); ++a)
    {
      const auto &cell = space.grid.cells()[space.cells()[a].grid_cell];
      for (unsigned int i = 0; i < space.basis.n_nodes; ++i)
        {
          const Point<dim> position  = cell.lower + cell.size * Tensor<1, dim>(space.basis.node(i));
          const auto [entry, is_new] = result.emplace(space.nodes(a)[i], position);
          EXPECT_LE(entry->second.distance(position), 1e-12) << "a node has two places";
        }
    }
  return result;
}

template <int dim>
void
check_numbering(const CutBodies<dim> &model, const unsigned int n_multipliers)
{
  const DisplacementSpace<dim> &space   = *model.space;
  const unsigned int            rank    = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  const unsigned int            n_ranks = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  const IndexSet               &owned   = space.owned();
  EXPECT_TRUE(owned.is_contiguous());
  EXPECT_TRUE(owned.is_ascending_and_one_to_one(MPI_COMM_WORLD));
  EXPECT_EQ(Utilities::MPI::sum(owned.n_elements(), MPI_COMM_WORLD), space.n_dofs());
  // All owned unknowns but the multipliers are components of the nodes of some cell here.
  const auto nodes = positions(space);
  DofIndex   n     = rank + 1 == n_ranks ? n_multipliers : 0;
  for (const auto &[node, position] : nodes)
    {
      EXPECT_EQ(owned.is_element(node), owned.is_element(node + dim - 1));
      EXPECT_TRUE(space.relevant().is_element(node));
      n += owned.is_element(node) ? dim : 0;
    }
  EXPECT_EQ(n, owned.n_elements());
  for (unsigned int i = 0; i < n_multipliers; ++i)
    {
      EXPECT_EQ(space.multiplier(i), space.n_dofs() - n_multipliers + i);
      EXPECT_EQ(owned.is_element(space.multiplier(i)), rank + 1 == n_ranks);
    }
}

const char *const mean_supports
  = "  subsection Boundary conditions\n   set Names = mean\n   subsection mean\n"
    "    set Type = mean support\n    set Components = x, y, rotation\n   end\n  end\n";

std::string
discs_with_multipliers(const unsigned int degree)
{
  return grid_text("-1, -1", "1, 1", "4, 4", 3, graded_text(1)) + degree_text(degree)
         + bodies_text({{"left", ball_text("-0.35, 0.01", 0.35) + mean_supports},
                        {"right", ball_text("0.35, 0", 0.35)}});
}

TEST(DisplacementSpace, NumberingIsContiguous)
{
  check_numbering(CutBodies<2>(two_discs(0.)), 0);
  check_numbering(CutBodies<2>(two_discs(0., 2)), 0);
  check_numbering(CutBodies<2>(discs_with_multipliers(1)), 3);
}

TEST(FieldsMPI, NumberingIsContiguous)
{
  check_numbering(CutBodies<2>(two_discs(0., 2)), 0);
  check_numbering(CutBodies<2>(discs_with_multipliers(2)), 3);
}

/** Linear fields are reproduced at random points of each body, on whatever process they lie. */
template <int dim>
void
check_stencils(const CutBodies<dim> &model)
{
  const DisplacementSpace<dim>          &space = *model.space;
  const unsigned int                     rank  = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  std::mt19937                           engine(11 + rank);
  std::uniform_real_distribution<double> number(-1., 1.);
  std::vector<unsigned int>              bodies;
  std::vector<Point<dim>>                points;
  unsigned int                           n_elsewhere = 0;
  while (points.size() < 300)
    {
      Point<dim> point;
      for (unsigned int d = 0; d < dim; ++d)
        point[d] = number(engine);
      for (unsigned int b = 0; b < model.bodies.size(); ++b)
        if (model.bodies[b].level_set.value(point, 1) < 0.)
          {
            bodies.push_back(b);
            points.push_back(point);
            n_elsewhere += model.grid.locate(point).rank != rank;
          }
    }
  if (Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
    {
      EXPECT_GT(n_elsewhere, 50u);
    }
  const auto stencils = space.stencils(bodies, points);

  std::map<DofIndex, Point<dim>> everywhere;
  for (const auto &here : Utilities::MPI::all_gather(MPI_COMM_WORLD, positions(space)))
    everywhere.insert(here.begin(), here.end());
  for (unsigned int i = 0; i < points.size(); ++i)
    {
      double         sum = 0.;
      Tensor<1, dim> moment;
      for (const auto &[node, weight] : stencils[i])
        {
          ASSERT_TRUE(everywhere.count(node));
          if (space.relevant().is_element(node))
            {
              EXPECT_FALSE(space.hanging_constraints().is_constrained(node));
            }
          sum += weight;
          moment += weight * everywhere[node];
        }
      EXPECT_NEAR(sum, 1., 1e-12);
      EXPECT_LE((moment - Tensor<1, dim>(points[i])).norm(), 1e-12);
    }
}

std::string
balls_3d()
{
  return grid_text("-1, -1, -1", "1, 1, 1", "2, 2, 2", 3, graded_text(1)) + degree_text(1)
         + bodies_text(
           {{"left", ball_text("-0.4, 0, 0", 0.4)}, {"right", ball_text("0.4, 0.01, 0", 0.4)}});
}

TEST(DisplacementSpace, StencilsReproduceLinearFields)
{
  check_stencils(CutBodies<2>(two_discs(0.)));
  check_stencils(CutBodies<2>(two_discs(0., 1, graded_text(1))));
  check_stencils(CutBodies<2>(two_discs(0., 2, graded_text(1))));
  check_stencils(CutBodies<3>(balls_3d()));
}

TEST(FieldsMPI, StencilsReproduceLinearFields)
{
  check_stencils(CutBodies<2>(two_discs(0., 1, graded_text(1))));
  check_stencils(CutBodies<2>(two_discs(0., 2, graded_text(1))));
  check_stencils(CutBodies<3>(balls_3d()));
}

TEST(DisplacementSpace, PointsBesideABodyTakeTheNearestCell)
{
  const CutBodies<2> model(two_discs(0.5));
  const double       h = model.grid.finest_size();
  // Left of the left disc (x = -0.95): at half a cell there is one, at five cells there is none.
  EXPECT_GE(model.space->nearest_active_cell(Point<2>(-0.95 - 0.5 * h, 0.01), 0), 0);
  EXPECT_EQ(model.space->nearest_active_cell(Point<2>(0.6, 0.), 0), -1);
  EXPECT_TRUE(model.space->stencils({0}, {Point<2>(0.6, 0.)})[0].empty());
}

TEST(DisplacementSpace, HangingNodesAreConstrained)
{
  const CutBodies<2> model(two_discs(0., 2, graded_text(1)));
  EXPECT_TRUE(model.grid.triangulation().has_hanging_nodes());
  const auto &constraints = model.space->hanging_constraints();
  EXPECT_GT(constraints.n_constraints(), 0u);
  const auto nodes = positions(*model.space);
  for (const auto &[node, position] : nodes)
    if (const auto *entries = constraints.get_constraint_entries(node))
      {
        Tensor<1, 2> mean;
        for (const auto &[master, weight] : *entries)
          mean += weight * nodes.at(master);
        EXPECT_LE((mean - Tensor<1, 2>(position)).norm(), 1e-12);
      }
}
} // namespace
} // namespace scree
