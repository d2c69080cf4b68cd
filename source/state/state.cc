#include <scree/state/state.h>

namespace scree
{
template <int dim>
dealii::TrilinosWrappers::MPI::Vector
zero_displacement(const Fields<dim> &fields)
{
  return dealii::TrilinosWrappers::MPI::Vector(fields.owned(), fields.grid.communicator());
}

template dealii::TrilinosWrappers::MPI::Vector zero_displacement(const Fields<2> &);
template dealii::TrilinosWrappers::MPI::Vector zero_displacement(const Fields<3> &);
} // namespace scree
