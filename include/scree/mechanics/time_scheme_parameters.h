#pragma once

#include <scree/parameters/section.h>

#include <string>

namespace scree
{
/** How a parameter file wants the equations to be integrated in time, a part of section Time. */
struct TimeSchemeParameters
{
  std::string scheme          = "quasi-static"; //!< one of time_scheme_names()
  double      newmark_beta    = 0.25;
  double      newmark_gamma   = 0.5;
  double      spectral_radius = 0.8; //!< of generalized alpha, at infinite frequency
  double      flip_share      = 1.;  //!< 1: points get increments of the velocity; 0: the velocity
  bool        lumps_mass      = false;
  bool        is_static_stage = false; //!< bodies have mass, but no inertia in the present stage

  /** Of the run: in some stage. */
  bool has_inertia() const
  {
    return scheme != "quasi-static";
  }

  void declare(const ParameterSection &section);
};
} // namespace scree
