// CellScatter: the matrix of all cells is that of AffineConstraints, also beside hanging nodes and
// other processes.
#include <gtest/gtest.h>

#include <scree/discretization/cell_scatter.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

#include <random>

#include "cut_bodies.h"

namespace scree
{
namespace
{
using namespace dealii;

/** All couplings of cells and of a trailing unknown with the first component of every node. */
template <int dim>
typename CellScatter<dim>::Matrix
empty_matrix(const DisplacementSpace<dim> &space)
{
  DynamicSparsityPattern pattern(space.n_dofs(), space.n_dofs(), space.relevant());
  for (unsigned int a = 0; a < space.n_owned_cells(); ++a)
    {
      auto unknowns = unknowns_of_nodes<dim>(space.nodes(a), space.basis.n_nodes);
      space.hanging_constraints().add_entries_local_to_global(unknowns, pattern, true);
      if (space.n_trailing() > 0)
        for (const DofIndex unknown : unknowns)
          if (unknown % dim == 0)
            pattern.add(unknown, space.n_dofs() - 1);
    }
  for (const DofIndex unknown : space.owned())
    pattern.add(unknown, unknown);
  SparsityTools::distribute_sparsity_pattern(pattern, space.owned(), MPI_COMM_WORLD,
                                             space.relevant());
  typename CellScatter<dim>::Matrix result;
  result.reinit(space.owned(), space.owned(), pattern, MPI_COMM_WORLD, true);
  return result;
}

template <int dim>
void
check(const DisplacementSpace<dim> &space)
{
  const unsigned int     n      = space.basis.n_nodes * dim;
  auto                   matrix = empty_matrix(space), expected = empty_matrix(space);
  const CellScatter<dim> scatter(space, matrix);
  std::mt19937           engine(5);
  std::uniform_real_distribution<double> number(-1., 1.);
  FullMatrix<double>                     block(n, n);
  for (unsigned int a = 0; a < space.n_owned_cells(); ++a)
    {
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          block(i, j) = number(engine);
      scatter.add(a, block, matrix);
      space.hanging_constraints().distribute_local_to_global(
        block, unknowns_of_nodes<dim>(space.nodes(a), space.basis.n_nodes), expected);
    }
  matrix.compress(VectorOperation::add);
  expected.compress(VectorOperation::add);
  EXPECT_GT(expected.frobenius_norm(), 1.);
  EXPECT_TRUE(scatter.fits(matrix));
  EXPECT_FALSE(scatter.fits(expected));
  expected.add(-1., matrix);
  EXPECT_LE(expected.linfty_norm(), 1e-14);
}

void
check_bodies()
{
  const std::string mean = conditions_text(
    {{"mean", "    set Type = mean support\n    set Components = x, y, rotation"}});
  for (const unsigned int degree : {1u, 2u})
    {
      check(*CutBodies<2>(grid_text("0, 0", "2, 2", "2, 2", 3, graded_text(1)) + degree_text(degree)
                          + bodies_text({{"block", half_space_text("0, 0.93", "0, 1") + mean},
                                         {"disc", ball_text("1, 1.43", 0.5)}}))
               .space);
      check(*CutBodies<3>(grid_text("0, 0, 0", "2, 2, 2", "2, 2, 2", 2, graded_text(1))
                          + degree_text(degree)
                          + bodies_text({{"block", half_space_text("0, 0, 0.93", "0, 0, 1")},
                                         {"ball", ball_text("1, 1, 1.43", 0.5)}}))
               .space);
    }
}
} // namespace

TEST(CellScatter, AddsWhatAffineConstraintsAdd)
{
  check_bodies();
}

TEST(CellScatterMPI, AddsWhatAffineConstraintsAdd)
{
  check_bodies();
}
} // namespace scree
