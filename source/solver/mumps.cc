#include <scree/solver/linear_solver.h>
#include <scree/solver/mumps.h>

#include <deal.II/base/mpi.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Map.h>
#include <Epetra_MpiComm.h>
#include <Epetra_Vector.h>
#include <array>
#include <dmumps_c.h>

namespace scree
{
namespace
{
/** Extra memory in percent of MUMPS's own estimate, one after the other. */
constexpr std::array<int, 4> extra_memory = {{40, 100, 300, 1000}};

/** Of unknowns: QAMD, minimum degree with rows that are nearly full last. PORD, MUMPS's own choice,
 * takes longer than all else here and saves little. */
constexpr int ordering = 6;

// Jobs of MUMPS.
constexpr int initialise = -1, terminate = -2, analyse = 1, numeric = 2, substitute = 3;

MPI_Comm
communicator_of(const Epetra_Vector &x)
{
  return dynamic_cast<const Epetra_MpiComm &>(x.Comm()).Comm();
}

/** Where the numbers of each process start in those of all, on process 0. */
struct Ranges
{
  Ranges(const int n, const MPI_Comm communicator)
      : size(dealii::Utilities::MPI::gather(communicator, n))
      , start(size.size(), 0)
  {
    for (std::size_t p = 1; p < size.size(); ++p)
      start[p] = start[p - 1] + size[p - 1];
  }

  std::vector<int> size, start;
};
} // namespace

MatrixEntries
matrix_entries(const Epetra_CrsMatrix &A, const bool symmetric)
{
  MatrixEntries     result;
  const std::size_t most = symmetric ? (A.NumMyNonzeros() + A.NumMyRows()) / 2 : A.NumMyNonzeros();
  result.rows.reserve(most);
  result.columns.reserve(most);
  result.values.reserve(most);
  const int *global_columns = A.ColMap().MyGlobalElements();
  for (int row = 0; row < A.NumMyRows(); ++row)
    {
      int     n_entries = 0, *column = nullptr;
      double *value = nullptr;
      A.ExtractMyRowView(row, n_entries, value, column);
      const int global_row = A.RowMap().GID(row);
      for (int i = 0; i < n_entries; ++i)
        {
          const int global_column = global_columns[column[i]];
          if (symmetric && global_column > global_row)
            continue;
          result.rows.push_back(global_row);
          result.columns.push_back(global_column);
          result.values.push_back(value[i]);
        }
    }
  return result;
}

std::vector<double>
gather_to_root(const std::vector<double> &mine, const MPI_Comm communicator)
{
  const int           n = mine.size();
  const Ranges        of_process(n, communicator);
  std::vector<double> all(
    of_process.size.empty() ? 0 : of_process.start.back() + of_process.size.back());
  MPI_Gatherv(mine.data(), n, MPI_DOUBLE, all.data(), of_process.size.data(),
              of_process.start.data(), MPI_DOUBLE, 0, communicator);
  return all;
}

std::vector<double>
gather_to_root(const Epetra_Vector &x)
{
  return gather_to_root(std::vector<double>(x.Values(), x.Values() + x.MyLength()),
                        communicator_of(x));
}

void
add_from_root(const std::vector<double> &values, Epetra_Vector &x)
{
  const MPI_Comm      communicator = communicator_of(x);
  const int           n            = x.MyLength();
  const Ranges        of_process(n, communicator);
  std::vector<double> mine(n);
  MPI_Scatterv(values.data(), of_process.size.data(), of_process.start.data(), MPI_DOUBLE,
               mine.data(), n, MPI_DOUBLE, 0, communicator);
  for (int i = 0; i < n; ++i)
    x[i] += mine[i];
}

struct Mumps::Instance
{
  DMUMPS_STRUC_C id      = {};
  bool           is_root = false; //!< whether this is process 0

  /** Control parameter ICNTL(i) of the manual. */
  MUMPS_INT &control(const int i)
  {
    return id.icntl[i - 1];
  }
};

Mumps::Mumps(const int n, const bool symmetric, const MatrixEntries &entries,
             const std::vector<int> &kept, const MPI_Comm communicator)
    : instance(std::make_unique<Instance>())
    , rows(entries.rows)
    , columns(entries.columns)
    , kept_rows(kept)
{
  for (std::vector<int> *indices : {&rows, &columns, &kept_rows})
    for (int &index : *indices)
      ++index;
  DMUMPS_STRUC_C &id = instance->id;
  instance->is_root  = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
  id.comm_fortran    = MPI_Comm_c2f(communicator);
  id.par             = 1;
  id.sym             = symmetric ? 2 : 0;
  id.job             = initialise;
  dmumps_c(&id);
  for (const int stream : {1, 2, 3, 4})
    instance->control(stream) = stream < 4 ? -1 : 0;
  instance->control(7) = ordering;
  id.n                 = n;
  if (dealii::Utilities::MPI::n_mpi_processes(communicator) == 1)
    {
      id.nnz = rows.size();
      id.irn = rows.data();
      id.jcn = columns.data();
    }
  else
    {
      instance->control(18) = 3; // the entries are distributed
      id.nnz_loc            = rows.size();
      id.irn_loc            = rows.data();
      id.jcn_loc            = columns.data();
    }
  if (!kept_rows.empty())
    {
      instance->control(19) = 1; // the Schur complement on process 0
      id.size_schur         = kept_rows.size();
      id.listvar_schur      = kept_rows.data();
    }
  run(analyse, "analyse the matrix");
}

Mumps::~Mumps()
{
  instance->id.job = terminate;
  dmumps_c(&instance->id);
}

void
Mumps::run(const int job, const char *what) const
{
  instance->id.job = job;
  dmumps_c(&instance->id);
  if (const int code = instance->id.infog[0]; code < 0)
    throw LinearSolverFailure("MUMPS cannot " + std::string(what)
                              + (code == -10 || code == -6
                                   ? ", the matrix is singular"
                                   : " (code " + std::to_string(code) + ")"));
}

void
Mumps::factorise(const std::vector<double> &values)
{
  matrix_values      = values;
  DMUMPS_STRUC_C &id = instance->id;
  id.a = id.a_loc = matrix_values.data();
  if (!kept_rows.empty())
    {
      schur.assign(instance->is_root ? kept_rows.size() * kept_rows.size() : 1, 0.);
      id.schur = schur.data();
    }
  for (std::size_t i = 0;; ++i)
    {
      instance->control(14) = extra_memory[i];
      try
        {
          run(numeric, "factorise the matrix");
          break;
        }
      catch (const LinearSolverFailure &)
        {
          const int  code         = id.infog[0];
          const bool needs_memory = code == -8 || code == -9;
          if (!needs_memory || i + 1 == extra_memory.size())
            throw;
        }
    }
  if (id.sym != 0 && instance->is_root) // MUMPS sets one triangle
    for (std::size_t i = 0; i < kept_rows.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        schur[j * kept_rows.size() + i] = schur[i * kept_rows.size() + j];
}

double
Mumps::operations() const
{
  return instance->id.rinfog[2];
}

int
Mumps::n_negative_pivots() const
{
  return instance->id.infog[11];
}

void
Mumps::solve(std::vector<double> &right) const
{
  DMUMPS_STRUC_C &id = instance->id;
  id.nrhs            = instance->is_root ? right.size() / id.n : 1;
  id.nrhs            = dealii::Utilities::MPI::max(id.nrhs, MPI_Comm_f2c(id.comm_fortran));
  id.lrhs            = id.n;
  id.rhs             = right.data();
  run(substitute, "solve");
}

std::vector<double>
Mumps::condense(const std::vector<double> &right) const
{
  DMUMPS_STRUC_C &id = instance->id;
  right_hand_side    = right;
  reduced.resize(kept_rows.size());
  id.nrhs               = 1;
  id.lrhs               = id.n;
  id.rhs                = right_hand_side.data();
  id.lredrhs            = reduced.size();
  id.redrhs             = reduced.data();
  instance->control(26) = 1;
  run(substitute, "condense the right-hand side");
  return reduced;
}

std::vector<double>
Mumps::expand(const std::vector<double> &x_of_kept) const
{
  reduced               = x_of_kept;
  instance->id.redrhs   = reduced.data();
  instance->control(26) = 2;
  run(substitute, "solve");
  instance->control(26) = 0;
  return right_hand_side;
}
} // namespace scree
