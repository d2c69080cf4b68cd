#include <scree/application/command_line.h>

#include <deal.II/base/mpi.h>

int
main(int argc, char **argv)
{
  // deal.II initialises PETSc as well, which complains of options that are not its own.
  int                                      argc_of_name = 1;
  char                                   **name         = argv;
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc_of_name, name, 1);
  return scree::run_command_line(argc, argv, MPI_COMM_WORLD);
}
