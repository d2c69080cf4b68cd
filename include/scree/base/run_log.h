#pragma once

#include <scree/base/log.h>
#include <scree/base/timings.h>
#include <scree/base/warnings.h>

namespace scree
{
/** What a run tells: lines for the user, wall times of its parts, what it has warned about. */
struct RunLog
{
  Log      log;
  Timings  timings;
  Warnings warnings;
};
} // namespace scree
