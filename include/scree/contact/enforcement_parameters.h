#pragma once

#include <scree/parameters/section.h>

#include <string>

namespace scree
{
/** How contact is enforced. */
struct EnforcementParameters
{
  std::string  type            = "penalty";
  double       largest_gap     = 1e-5;  //!< of gaps and slides that should be zero [h]
  unsigned int maximum_updates = 20;    //!< of multipliers in a step
  double       growth          = 10.;   //!< of penalties that multipliers follow too slowly
  double       largest_growth  = 1000.; //!< of penalties in a step

  void declare(ParameterSection &section);
};
} // namespace scree
