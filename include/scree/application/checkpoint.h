#pragma once

#include <scree/application/stages.h>
#include <scree/application/stepper.h>
#include <scree/base/warnings.h>
#include <scree/output/results.h>
#include <scree/output/run_report.h>
#include <scree/solver/step_control.h>
#include <scree/state/gathered_state.h>

#include <boost/serialization/map.hpp>
#include <map>
#include <string>

namespace scree
{
/**
 * All that a run needs to go on after an accepted step, on any number of processes: what its input
 * and its files do not tell.
 */
template <int dim>
struct Checkpoint
{
  std::string                        program;    //!< version that wrote it
  std::map<std::string, std::string> parameters; //!< of the run, value by path
  StepControlRecord                  steps;
  StageRecord<dim>                   stages;
  ResultsRecord                      results;
  ReportRecord                       report;
  Warnings                           warnings;
  StepperRecord                      stepper;
  GatheredState<dim>                 state;

  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &program &parameters &steps &stages &results &report &warnings &stepper &state;
  }

  /** Writes it into a directory (write_checkpoint_file()); by one process. Returns its bytes. */
  std::size_t write(const std::string &directory) const;

  /** What the newest undamaged one of a directory holds, on all processes; collective. */
  static Checkpoint read(const std::string &directory, const MPI_Comm communicator);

  /** Why it is not the newest one; empty: it is. Not stored. */
  std::string warning;
};

/**
 * @throws UserError unless parameters differ only where a run may be changed on its way: in
 * sections Time, Solver and Output (but its probes) and the title
 */
void require_resumable(const std::map<std::string, std::string> &before,
                       const std::map<std::string, std::string> &now);
} // namespace scree
