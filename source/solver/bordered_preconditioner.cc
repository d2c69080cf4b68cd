#include <scree/solver/bordered_preconditioner.h>

#include <Epetra_Import.h>
#include <Epetra_Vector.h>
#include <algorithm>

namespace scree
{
BorderedPreconditioner::BorderedPreconditioner(const Epetra_CrsMatrix &A,
                                               const unsigned int      n_border)
    : n_border(n_border)
    , n_inner(A.NumGlobalRows() - static_cast<int>(n_border))
{
  Assert(n_border > 0, dealii::ExcMessage("There is no border."));
  const Epetra_Map &rows = A.RowMap();
  n_local_inner          = 0;
  while (n_local_inner < rows.NumMyElements() && rows.GID(n_local_inner) < n_inner)
    ++n_local_inner;
  copy_inner(A);
  copy_border(A);
}

void
BorderedPreconditioner::copy_inner(const Epetra_CrsMatrix &A)
{
  const Epetra_Map    rows(n_inner, n_local_inner, 0, A.Comm());
  std::vector<int>    lengths(n_local_inner);
  std::vector<int>    columns(A.MaxNumEntries());
  std::vector<double> values(A.MaxNumEntries());
  for (int row = 0; row < n_local_inner; ++row)
    lengths[row] = A.NumMyEntries(row);
  K = std::make_unique<Epetra_CrsMatrix>(Copy, rows, lengths.data());
  for (int row = 0; row < n_local_inner; ++row)
    {
      int     n = 0, n_entries = 0, *column = nullptr;
      double *value = nullptr;
      A.ExtractMyRowView(row, n_entries, value, column);
      for (int i = 0; i < n_entries; ++i)
        if (A.ColMap().GID(column[i]) < n_inner)
          {
            columns[n]  = A.ColMap().GID(column[i]);
            values[n++] = value[i];
          }
      K->InsertGlobalValues(rows.GID(row), n, values.data(), columns.data());
    }
  K->FillComplete(rows, rows);
}

void
BorderedPreconditioner::copy_border(const Epetra_CrsMatrix &A)
{
  const Epetra_Map &rows = A.RowMap();
  C                      = std::make_unique<Epetra_MultiVector>(K->RowMap(), n_border);
  D                      = std::make_unique<Epetra_MultiVector>(K->RowMap(), n_border);
  W                      = std::make_unique<Epetra_MultiVector>(K->RowMap(), n_border);
  Epetra_MultiVector of_columns(A.ColMap(), n_border), of_rows(rows, n_border);
  for (int row = 0; row < rows.NumMyElements(); ++row)
    {
      int     n_entries = 0, *column = nullptr;
      double *value = nullptr;
      A.ExtractMyRowView(row, n_entries, value, column);
      for (int i = 0; i < n_entries; ++i)
        if (row >= n_local_inner)
          of_columns[rows.GID(row) - n_inner][column[i]] = value[i];
        else if (A.ColMap().GID(column[i]) >= n_inner)
          (*C)[A.ColMap().GID(column[i]) - n_inner][row] = value[i];
    }
  // The border rows go to the processes that own their columns.
  of_rows.Export(of_columns, Epetra_Import(A.ColMap(), rows), Add);
  dealii::FullMatrix<double> local(n_border, n_border);
  S.reinit(n_border, n_border);
  for (unsigned int k = 0; k < n_border; ++k)
    {
      std::copy(of_rows[k], of_rows[k] + n_local_inner, (*D)[k]);
      for (int row = n_local_inner; row < rows.NumMyElements(); ++row)
        local(k, rows.GID(row) - n_inner) = of_rows[k][row];
    }
  A.Comm().SumAll(&local(0, 0), &S(0, 0), static_cast<int>(n_border * n_border));
}

void
BorderedPreconditioner::set_inner(const Epetra_Operator &new_inner)
{
  inner = &new_inner;
  std::vector<double> norms(n_border);
  C->NormInf(norms.data());
  inverse_schur = S;
  for (unsigned int k = 0; k < n_border; ++k)
    {
      if (norms[k] == 0.)
        continue;
      const Epetra_Vector right(View, *C, static_cast<int>(k));
      Epetra_Vector       left(View, *W, static_cast<int>(k));
      inner->ApplyInverse(right, left);
      const std::vector<double> products = border_products((*W)[k]);
      for (unsigned int j = 0; j < n_border; ++j)
        inverse_schur(j, k) -= products[j];
    }
  inverse_schur.gauss_jordan();
}

std::vector<double>
BorderedPreconditioner::border_products(const double *y) const
{
  std::vector<double> local(n_border), result(n_border);
  for (unsigned int k = 0; k < n_border; ++k)
    for (int i = 0; i < n_local_inner; ++i)
      local[k] += (*D)[k][i] * y[i];
  K->Comm().SumAll(local.data(), result.data(), static_cast<int>(n_border));
  return result;
}

void
BorderedPreconditioner::vmult(Vector &dst, const Vector &src) const
{
  // Views of the inner part; the border is known to all processes.
  double             *from = src.trilinos_vector()[0], *to = dst.trilinos_vector()[0];
  const Epetra_Vector right(View, K->RowMap(), from);
  Epetra_Vector       left(View, K->RowMap(), to);
  inner->ApplyInverse(right, left);

  const int           n_local = src.trilinos_vector().MyLength();
  std::vector<double> local(n_border), rest(n_border);
  for (int i = n_local_inner; i < n_local; ++i)
    local[i - n_local_inner] = from[i];
  K->Comm().SumAll(local.data(), rest.data(), static_cast<int>(n_border));
  const std::vector<double> products = border_products(to);
  for (unsigned int k = 0; k < n_border; ++k)
    {
      double z = 0.;
      for (unsigned int j = 0; j < n_border; ++j)
        z += inverse_schur(k, j) * (rest[j] - products[j]);
      for (int i = 0; i < n_local_inner; ++i)
        to[i] -= (*W)[k][i] * z;
      if (n_local > n_local_inner)
        to[n_local_inner + k] = z;
    }
}
} // namespace scree
