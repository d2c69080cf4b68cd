#include <scree/mechanics/equilibrium.h>

#include <deal.II/base/mpi.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Import.h>
#include <Epetra_Vector.h>

// Tangents of the equilibrium.
namespace scree
{
template <int dim>
bool
Equilibrium<dim>::couple(const std::vector<bool> &points, const double near)
{
  const MPI_Comm communicator = space.grid.communicator();
  unsigned int   is_missing   = coupled.size() != points.size() || newton_matrix.m() == 0;
  for (std::size_t p = 0; p < points.size() && !is_missing; ++p)
    is_missing = points[p] && !coupled[p];
  if (dealii::Utilities::MPI::max(is_missing, communicator) == 0)
    return false;
  const std::vector<bool> also = contact.points_within(near);
  coupled.resize(points.size(), false);
  for (std::size_t p = 0; p < points.size(); ++p)
    coupled[p] = coupled[p] || points[p] || also[p];
  contact.jump_operator().complete_groups(coupled);
  make_matrix(contact.jump_operator().couplings(coupled), newton_matrix);
  return true;
}

template <int dim>
void
Equilibrium<dim>::start_tangent()
{
  newton_matrix = 0.;
  newton_matrix.add(1., stiffness);
  if (has_inertia())
    {
      newton_matrix.add(inertia.factor, *inertia.mass->matrix());
      inertia.add_tangent(ghosted, newton_matrix);
    }
  bulk.add_tangent(seen_by_bulk, newton_matrix);
  boundary_terms.add_tangent(seen_by_bulk, time, newton_matrix);
  rigid.add_to_matrix(ghosted, time, newton_matrix);
}

template <int dim>
void
Equilibrium<dim>::finish_tangent()
{
  add_artificial_mass(newton_matrix);
  newton_matrix.compress(dealii::VectorOperation::add);
  eliminate_prescribed(newton_matrix);
}

template <int dim>
void
Equilibrium<dim>::tangent_without_contact(const std::vector<bool> &points, Matrix &K_0)
{
  constexpr double near = 1.5; // cells: what may come near in the next iterations
  if (!couple(points, near) && K_0.m() > 0)
    return;
  start_tangent();
  newton_matrix.compress(dealii::VectorOperation::add);
  K_0.copy_from(newton_matrix);
}

template <int dim>
const typename Equilibrium<dim>::Matrix &
Equilibrium<dim>::tangent_with_contact(const Matrix                              &K_0,
                                       const std::vector<dealii::Tensor<2, dim>> &D)
{
  newton_matrix = 0.;
  newton_matrix.add(1., K_0);
  contact.jump_operator().add_stiffness(D, newton_matrix);
  finish_tangent();
  return newton_matrix;
}

template <int dim>
const typename Equilibrium<dim>::Matrix &
Equilibrium<dim>::tangent()
{
  couple(contact.stiff_points(false));
  start_tangent();
  if (inertia.contact_weight == 1.)
    contact.add_to_matrix(newton_matrix);
  else
    {
      newton_matrix.compress(dealii::VectorOperation::add);
      newton_matrix *= 1. / inertia.contact_weight;
      contact.add_to_matrix(newton_matrix);
      newton_matrix.compress(dealii::VectorOperation::add);
      newton_matrix *= inertia.contact_weight;
    }
  finish_tangent();
  return newton_matrix;
}

template <int dim>
Condensation
Equilibrium<dim>::condensation(const bool only_closed)
{
  const auto &glued = contact.choose_glued(only_closed);
  couple(contact.stiff_points(true));
  start_tangent();
  contact.jump_operator().add_stiffness(glued, newton_matrix);
  finish_tangent();

  // Prescribed unknowns may belong to any process: a ghosted vector tells them.
  Vector is_prescribed(space.owned(), space.grid.communicator());
  for (const auto &unknown : supports.unknowns())
    is_prescribed(unknown.index) = 1.;
  is_prescribed.compress(dealii::VectorOperation::insert);
  Vector with_ghosts(ghosted);
  with_ghosts     = is_prescribed;
  SparseRows rows = contact.jump_operator().rows();
  for (std::size_t i = 0; i < rows.columns.size(); ++i)
    if (with_ghosts(rows.columns[i]) != 0.)
      rows.values[i] = 0.;
  return {newton_matrix, rows, boundary_terms.is_symmetric()};
}

template <int dim>
void
Equilibrium<dim>::eliminate_prescribed(Matrix &matrix) const
{
  // A vector with ones on prescribed unknowns, imported to the columns of this process.
  const auto   &epetra = matrix.trilinos_matrix();
  Epetra_Vector owned(epetra.RowMap()), columns(epetra.ColMap());
  for (const auto &unknown : supports.unknowns())
    owned[epetra.RowMap().LID(static_cast<int>(unknown.index))] = 1.;
  for (const DofIndex index : rigid.prescribed())
    owned[epetra.RowMap().LID(static_cast<int>(index))] = 1.;
  const Epetra_Import import(epetra.ColMap(), epetra.RowMap());
  columns.Import(owned, import, Insert);
  for (int row = 0; row < epetra.NumMyRows(); ++row)
    {
      int     n_entries, *column;
      double *value;
      epetra.ExtractMyRowView(row, n_entries, value, column);
      const int diagonal = epetra.ColMap().LID(epetra.RowMap().GID(row));
      for (int i = 0; i < n_entries; ++i)
        if (column[i] != diagonal && (owned[row] != 0. || columns[column[i]] != 0.))
          value[i] = 0.;
    }
}

template <int dim>
bool
Equilibrium<dim>::is_symmetric_without_contact() const
{
  return boundary_terms.is_symmetric() && !boundary_terms.has_multipliers()
         && rigid.is_symmetric(time);
}

template <int dim>
bool
Equilibrium<dim>::is_symmetric() const
{
  bool is_symmetric = true;
  for (const auto &response : contact.responses())
    is_symmetric &= response.is_symmetric;
  return is_symmetric_without_contact()
         && dealii::Utilities::MPI::max(static_cast<unsigned int>(!is_symmetric),
                                        space.grid.communicator())
              == 0;
}

#define SCREE_INSTANTIATE(dim)                                                                     \
  template void Equilibrium<dim>::tangent_without_contact(const std::vector<bool> &, Matrix &);    \
  template const Equilibrium<dim>::Matrix &Equilibrium<dim>::tangent_with_contact(                 \
    const Matrix &, const std::vector<dealii::Tensor<2, dim>> &);                                  \
  template const Equilibrium<dim>::Matrix &Equilibrium<dim>::tangent();                            \
  template Condensation                    Equilibrium<dim>::condensation(const bool);             \
  template bool                            Equilibrium<dim>::is_symmetric_without_contact() const; \
  template bool                            Equilibrium<dim>::is_symmetric() const;

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
