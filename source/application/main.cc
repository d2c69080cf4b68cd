#include <scree/application/command_line.h>

#include <deal.II/base/mpi.h>

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  return scree::run_command_line(argc, argv, MPI_COMM_WORLD);
}
