#pragma once

#include <scree/discretization/displacement_space.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <Epetra_CrsGraph.h>
#include <cstddef>
#include <vector>

namespace scree
{
/**
 * Where the blocks of cells go in a sparse matrix, found once for many matrices of one sparsity
 * pattern. Blocks have the unknowns of the cell's nodes, the components of a node side by side.
 */
template <int dim>
class CellScatter
{
public:
  using Matrix = dealii::TrilinosWrappers::SparseMatrix;

  CellScatter(const DisplacementSpace<dim> &space, const Matrix &matrix);

  /** Whether the matrix has the graph (the same object) for which the places were found. */
  bool fits(const Matrix &matrix) const;

  /** `matrix += block` for an owned cell; hanging nodes as by AffineConstraints. It fits the
   * matrix, which has to be compressed (add) afterwards. */
  void add(const unsigned int active_cell, const dealii::FullMatrix<double> &block,
           Matrix &matrix) const;

private:
  /** The positions of a cell's nodes within the row of the first unknown of each; false if they are
   * not the same in the rows of the others. */
  bool find(const unsigned int active_cell, const int *rows, const int *columns,
            const Matrix &matrix);

  static constexpr std::size_t general = static_cast<std::size_t>(-1);

  const DisplacementSpace<dim> &space;
  const Epetra_CrsGraph         graph; //!< lives as long as its places: no other has its address
  std::vector<std::size_t>      first; //!< of a cell in `positions`, or `general`
  std::vector<int>              positions; //!< node by node: its row, then its columns in it
};
} // namespace scree
