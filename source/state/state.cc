#include <scree/state/state.h>

namespace scree
{
template <int dim>
dealii::TrilinosWrappers::MPI::Vector
zero_displacement(const DisplacementSpace<dim> &space)
{
  return dealii::TrilinosWrappers::MPI::Vector(space.owned(), space.grid.communicator());
}

template dealii::TrilinosWrappers::MPI::Vector zero_displacement(const DisplacementSpace<2> &);
template dealii::TrilinosWrappers::MPI::Vector zero_displacement(const DisplacementSpace<3> &);
} // namespace scree
