// The ghost penalty vanishes for polynomials of its degree and has the documented size for others.
#include <gtest/gtest.h>

#include <scree/discretization/face_jumps.h>

#include <cmath>

#include "cut_bodies.h"

namespace scree
{
namespace
{
using namespace dealii;

template <int dim>
std::string
cut_ball(const unsigned int degree, const unsigned int finest_level)
{
  const std::string zero = dim == 2 ? "" : ", 0.01", cells = dim == 2 ? "2, 2" : "2, 2, 2";
  const std::string limit = "set Cell size limit = if(x > 0.1, "
                            + std::to_string(std::pow(0.5, finest_level)) + ", 10)\n";
  return grid_text(dim == 2 ? "-1, -1" : "-1, -1, -1", dim == 2 ? "1, 1" : "1, 1, 1", cells,
                   finest_level, graded_text(finest_level - 2, limit))
         + degree_text(degree) + bodies_text({{"ball", ball_text("0.013, -0.021" + zero, 0.61)}});
}

/** The nodal values of a function on both cells of a face. */
template <int dim>
Vector<double>
values(const DisplacementSpace<dim> &space, const GhostFace &face,
       const std::function<double(const Point<dim> &)> &function)
{
  const unsigned int n = space.basis.n_nodes;
  Vector<double>     result(2 * n);
  for (unsigned int side = 0; side < 2; ++side)
    {
      const auto &cell
        = space.grid.cells()[space.cells()[side == 0 ? face.cell : face.neighbor].grid_cell];
      for (unsigned int i = 0; i < n; ++i)
        result(side * n + i)
          = function(cell.lower + cell.size * Tensor<1, dim>(space.basis.node(i)));
    }
  return result;
}

template <int dim>
void
check_polynomials(const unsigned int degree, const unsigned int finest_level)
{
  const CutBodies<dim> model(cut_ball<dim>(degree, finest_level));
  FaceJumps<dim>       face_jumps(*model.space);
  unsigned int         n_hanging = 0;
  for (const GhostFace &face : face_jumps.faces())
    {
      const auto  &here   = model.grid.cells()[model.space->cells()[face.cell].grid_cell];
      const auto  &there  = model.grid.cells()[model.space->cells()[face.neighbor].grid_cell];
      const auto   matrix = face_jumps.matrix(face);
      const double size   = here.size;
      EXPECT_LE(here.size, there.size);
      EXPECT_TRUE(model.space->cells()[face.cell].is_cut
                  || model.space->cells()[face.neighbor].is_cut);
      n_hanging += there.size > 1.5 * here.size;
      const auto     polynomial = values<dim>(*model.space, face, [&](const Point<dim> &x) {
        const double linear = 0.3 + 1.2 * x[0] - 0.7 * x[1] + 0.4 * x[dim - 1];
        return degree == 1 ? linear : linear + linear * linear + 3. * x[0] * x[1];
      });
      Vector<double> product(polynomial.size());
      matrix.vmult(product, polynomial);
      EXPECT_LE(product.linfty_norm(), 1e-11 * std::pow(size, dim - 2));
      // Other functions are not let through.
      const auto   other = values<dim>(*model.space, face, [&](const Point<dim> &x) {
        return std::pow(x[face.face / 2], degree + 1);
      });
      const double value = matrix.matrix_norm_square(other);
      EXPECT_GT(value, 0.);
      if (there.size > 1.5 * here.size)
        continue;
      // Equal cells: the normal derivative of the interpolant of x^2 jumps by 2 h, the second one
      // of the interpolant of x^3 by 6 h.
      const double expected = degree == 1 ? size * std::pow(2. * size, 2)
                                          : std::pow(size, 3) / 4. * std::pow(6. * size, 2);
      EXPECT_NEAR(value / (expected * std::pow(size, dim - 1)), 1., 1e-7);
    }
  EXPECT_GT(n_hanging, 0u);
}

TEST(FaceJumps, VanishesForPolynomials2D)
{
  check_polynomials<2>(1, 4);
  check_polynomials<2>(2, 4);
}

TEST(FaceJumps, VanishesForPolynomials3D)
{
  check_polynomials<3>(1, 3);
  check_polynomials<3>(2, 3);
}

/** Area of all faces that are integrated; the same on any number of processes. */
double
total_length(const CutBodies<2> &model)
{
  double             sum = 0.;
  const FaceJumps<2> face_jumps(*model.space);
  for (const GhostFace &face : face_jumps.faces())
    sum += model.grid.cells()[model.space->cells()[face.cell].grid_cell].size;
  return Utilities::MPI::sum(sum, MPI_COMM_WORLD);
}

/** The same by brute force from one side of each face. */
double
expected_length(const CutBodies<2> &model)
{
  double sum = 0.;
  for (unsigned int a = 0; a < model.space->n_owned_cells(); ++a)
    {
      const auto &active = model.space->cells()[a];
      const auto &cell   = model.grid.cells()[active.grid_cell];
      for (const unsigned int f : cell.iterator->face_indices())
        {
          if (cell.iterator->at_boundary(f) || cell.iterator->neighbor(f)->has_children())
            continue;
          const int n = model.space->active_cell(
            model.grid.local_index(*cell.iterator->neighbor(f)), active.body);
          if (n >= 0 && (active.is_cut || model.space->cells()[n].is_cut))
            sum += cell.iterator->neighbor_is_coarser(f) ? cell.size : 0.5 * cell.size;
        }
    }
  return Utilities::MPI::sum(sum, MPI_COMM_WORLD);
}

TEST(FaceJumps, EachFaceOnce)
{
  const CutBodies<2> model(cut_ball<2>(1, 4));
  EXPECT_NEAR(total_length(model), expected_length(model), 1e-12);
}

TEST(FaceJumpsMPI, EachFaceOnce)
{
  const CutBodies<2> model(cut_ball<2>(1, 4));
  EXPECT_NEAR(total_length(model), expected_length(model), 1e-12);
}
} // namespace
} // namespace scree
