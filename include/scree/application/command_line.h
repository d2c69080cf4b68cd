#pragma once

#include <mpi.h>

namespace scree
{
/**
 * What `scree` does with its arguments (scree --help). Every error is told once, in plain words,
 * and ends all processes; returns the exit code: 0, 1
 * after an error, 128 + number of the signal that a run obeyed.
 */
int run_command_line(int argc, char **argv, const MPI_Comm communicator);
} // namespace scree
