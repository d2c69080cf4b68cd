#pragma once

#include <scree/contact/contact_law.h>
#include <scree/contact/enforcement_parameters.h>
#include <scree/contact/grid_node_parameters.h>

#include <limits>
#include <string>
#include <vector>

namespace scree
{
/** What Adjust takes off. */
enum class AdjustBy
{
  pairs, //!< the least gap of a pair from all its points
  points //!< from each point its own gap
};

/** A contact law for the pairs of bodies that match two names or wildcards. */
struct ContactPairParameters
{
  std::string              name;
  std::vector<std::string> bodies               = {"*", "*"}; //!< two names; '*' matches any text
  const ContactLaw        *kind                 = &contact_law("coulomb");
  double                   friction_coefficient = std::numeric_limits<double>::quiet_NaN();
  double                   normal_factor        = 10.; //!< c_n in eps_n = c_n E/h
  double                   tangential_factor    = 10.; //!< c_t in eps_t = c_t E/h
  /** E of the penalties [force/L^2]; NaN: from the materials */
  double penalty_modulus = std::numeric_limits<double>::quiet_NaN();
  /** Initial gaps and overlaps up to this are moved to zero without strain [L]. */
  double   adjust    = 0.;
  AdjustBy adjust_by = AdjustBy::pairs;
  /** Tied: points are glued up to this initial gap [L]; NaN: a tenth of their cell. */
  double      tied_gap = std::numeric_limits<double>::quiet_NaN();
  std::string where    = "1"; //!< tied: expression that selects the glued part
  std::string path;           //!< of the section, for messages

  void declare(ParameterSection &section);

  /** db/dp of the friction under large pressures; infinite where nothing slides. */
  double friction() const;

  /** Whether the law is meant for the two bodies, in either order. */
  bool matches(const std::string &a, const std::string &b) const;
};

/** Parameters of section Contact: laws by name, the last that matches a pair counts. */
struct ContactParameters
{
  std::vector<ContactPairParameters> laws;
  double                             shift = 4.; //!< largest phi on the contact surface, in h
  GridNodeParameters                 grid_nodes;
  EnforcementParameters              enforcement;

  void declare(ParameterSection &section, const std::vector<std::string> &body_names);

  /** The law of a pair; frictionless contact with default penalties if none matches. */
  ContactPairParameters law_of(const std::string &a, const std::string &b) const;

  /** Which names of all laws a body fits: bodies of equal roles have equal laws with all others. */
  std::vector<bool> roles_of(const std::string &body) const;
};
} // namespace scree
