#include <scree/discretization/cell_scatter.h>

#include <Epetra_CrsMatrix.h>
#include <algorithm>

namespace scree
{
namespace
{
using IndexType = dealii::TrilinosWrappers::types::int_type;

/** The arrays of a matrix on this process: row -> begin, local columns, values; null if it is not
 * stored in one piece. */
struct Arrays
{
  int    *begin = nullptr, *columns = nullptr;
  double *values = nullptr;

  explicit Arrays(const dealii::TrilinosWrappers::SparseMatrix &matrix)
  {
    if (matrix.trilinos_matrix().ExtractCrsDataPointers(begin, columns, values) != 0)
      begin = nullptr;
  }
};
} // namespace

template <int dim>
CellScatter<dim>::CellScatter(const DisplacementSpace<dim> &space, const Matrix &matrix)
    : space(space)
    , graph(matrix.trilinos_matrix().Graph())
    , first(space.n_owned_cells(), general)
{
  const Arrays arrays(matrix);
  if (!arrays.begin)
    return;
  const unsigned int n = space.basis.n_nodes;
  positions.reserve(std::size_t(space.n_owned_cells()) * n * (n + dim));
  for (unsigned int a = 0; a < space.n_owned_cells(); ++a)
    {
      const std::size_t end = positions.size();
      if (find(a, arrays.begin, arrays.columns, matrix))
        first[a] = end;
      else
        positions.resize(end);
    }
}

template <int dim>
bool
CellScatter<dim>::fits(const Matrix &matrix) const
{
  return matrix.trilinos_matrix().Graph().DataPtr() == graph.DataPtr();
}

template <int dim>
bool
CellScatter<dim>::find(const unsigned int active_cell, const int *begin, const int *columns,
                       const Matrix &matrix)
{
  const unsigned int n     = space.basis.n_nodes;
  const DofIndex    *nodes = space.nodes(active_cell);
  const auto        &maps  = matrix.trilinos_matrix();
  for (unsigned int i = 0; i < n; ++i)
    if (!space.owned().is_element(nodes[i]) || space.hanging_constraints().is_constrained(nodes[i]))
      return false;
  const auto local_column
    = [&](const unsigned int j) { return maps.LCID(static_cast<IndexType>(nodes[j])); };
  for (unsigned int i = 0; i < n; ++i)
    {
      const int row = maps.LRID(static_cast<IndexType>(nodes[i]));
      for (unsigned int d = 0; d < dim; ++d)
        positions.push_back(begin[row + d]);
      for (unsigned int j = 0; j < n; ++j)
        {
          const int column   = local_column(j);
          int       position = 0;
          for (unsigned int d = 0; d < dim; ++d)
            {
              const int *last  = columns + begin[row + d + 1];
              const int *found = std::lower_bound(columns + begin[row + d], last, column);
              const int  place = static_cast<int>(found - columns) - begin[row + d];
              if (last - found < dim || (d > 0 && place != position))
                return false;
              for (int e = 0; e < dim; ++e)
                if (found[e] != column + e)
                  return false;
              position = place;
            }
          positions.push_back(position);
        }
    }
  return true;
}

template <int dim>
void
CellScatter<dim>::add(const unsigned int active_cell, const dealii::FullMatrix<double> &block,
                      Matrix &matrix) const
{
  Assert(fits(matrix), dealii::ExcMessage("The matrix has another pattern."));
  const unsigned int n = space.basis.n_nodes;
  if (first[active_cell] == general)
    {
      space.hanging_constraints().distribute_local_to_global(
        block, unknowns_of_nodes<dim>(space.nodes(active_cell), n), matrix);
      return;
    }
  double    *values   = Arrays(matrix).values;
  const int *position = positions.data() + first[active_cell];
  for (unsigned int i = 0; i < n; ++i, position += dim + n)
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double *entry = &block(i * dim + d, 0);
        double       *row   = values + position[d];
        for (unsigned int j = 0; j < n; ++j)
          for (unsigned int e = 0; e < dim; ++e)
            row[position[dim + j] + e] += *entry++;
      }
}

template class CellScatter<2>;
template class CellScatter<3>;
} // namespace scree
