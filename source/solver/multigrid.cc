#include <scree/solver/multigrid.h>

#include <deal.II/base/mpi.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_MultiVector.h>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <cmath>
#include <ml_MultiLevelPreconditioner.h>

namespace scree
{
namespace
{
/** A hierarchy is given up beyond this many times its first iterations per digit ... */
constexpr double acceptable_growth = 1.5;

/** ... and these, which a short iteration needs whatever its preconditioner. */
constexpr double free_iterations = 4.;
} // namespace

Multigrid::Multigrid(const Matrix &A, const Settings &settings, const std::vector<Vector> &modes)
    : graph(A.trilinos_matrix().Graph())
{
  for (const Vector &mode : modes)
    AssertThrow(
      mode.size() == A.m() && mode.locally_owned_size() == A.local_size(),
      dealii::ExcMessage("The near null space is not distributed as the rows of the matrix."));
  if (settings.n_border == 0)
    {
      matrix = std::make_unique<Epetra_CrsMatrix>(A.trilinos_matrix());
      initialize(*matrix, settings, modes);
      return;
    }
  bordered = std::make_unique<BorderedPreconditioner>(A.trilinos_matrix(), settings.n_border);
  initialize(bordered->inner_matrix(), settings, modes);
  bordered->set_inner(amg.trilinos_operator());
}

void
Multigrid::initialize(const Epetra_CrsMatrix &A, const Settings &settings,
                      const std::vector<Vector> &modes)
{
  const Epetra_Map &rows = A.RowMap();
  // ML needs whole nodes on every process.
  const int dimension       = settings.dimension;
  int       has_whole_nodes = rows.NumMyElements() % dimension == 0, whole_nodes = 0;
  rows.Comm().MinAll(&has_whole_nodes, &whole_nodes, 1);

  Teuchos::ParameterList list;
  ML_Epetra::SetDefaults("SA", list);
  list.set("ML output", 0);
  if (settings.smooth_by_ilu)
    {
      list.set("smoother: type", "IFPACK");
      list.set("smoother: ifpack type", "ILU");
      list.set("smoother: ifpack level-of-fill", 1.);
    }
  else
    {
      list.set("smoother: type", "Chebyshev");
      list.set("smoother: sweeps", static_cast<int>(settings.parameters.amg_smoother_sweeps));
    }
  list.set("coarse: type", "Amesos-KLU");
  list.set("coarse: max size", 2000);
  list.set("aggregation: threshold", settings.parameters.amg_aggregation_threshold);
  list.set("PDE equations", whole_nodes ? dimension : 1);

  Epetra_MultiVector null_space(rows, std::max<int>(1, modes.size()));
  for (unsigned int k = 0; k < modes.size(); ++k)
    std::copy(modes[k].begin(), modes[k].begin() + rows.NumMyElements(), null_space[k]);
  if (!modes.empty())
    {
      list.set("null space: type", "pre-computed");
      list.set("null space: dimension", static_cast<int>(modes.size()));
      list.set("null space: vectors", null_space.Values());
    }
  amg.initialize(A, list);
}

void
Multigrid::vmult(Vector &dst, const Vector &src) const
{
  if (bordered)
    bordered->vmult(dst, src);
  else
    amg.vmult(dst, src);
}

bool
Multigrid::fits(const Matrix &A) const
{
  return A.trilinos_matrix().Graph().DataPtr() == graph.DataPtr();
}

unsigned int
Multigrid::expected_iterations(const double tolerance) const
{
  return std::ceil(acceptable_growth * iterations_per_digit * -std::log10(tolerance)
                   + free_iterations);
}

bool
Multigrid::is_worth_keeping(const unsigned int iterations, const double relative_residual)
{
  if (iterations_per_digit == 0.)
    {
      iterations_per_digit = iterations / std::max(1., -std::log10(relative_residual));
      return true;
    }
  return iterations <= expected_iterations(relative_residual);
}
} // namespace scree
