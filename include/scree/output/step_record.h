#pragma once

#include <vector>

namespace scree
{
/** How a load step was solved, for the history and the log. */
struct StepRecord
{
  unsigned int        step              = 0;
  double              time              = 0.;
  unsigned int        stage             = 0; //!< its number, from 1; 0: there are no stages
  unsigned int        newton_iterations = 0; //!< of the accepted attempt
  unsigned int        attempts          = 1; //!< 1 + number of cuts before
  unsigned int        linear_iterations = 0;
  double              residual          = 0.; //!< |r| at the end
  double              local_error       = 0.; //!< over the way of the largest speed, see LocalError
  std::vector<double> momenta           = {}; //!< with inertia, of body after body: linear, angular
};
} // namespace scree
