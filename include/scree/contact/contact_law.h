#pragma once

#include <scree/parameters/section.h>

#include <deal.II/base/array_view.h>

#include <string>
#include <vector>

namespace scree
{
struct ContactPairParameters;

/** The largest |tau| that a law bears under a pressure. */
struct FrictionBound
{
  double value       = 0.; //!< b(p) [force/area]
  double by_pressure = 0.; //!< db/dp
};

/**
 * A contact law: the tractions that two bodies bear between them,
 *
 *     p >= 0, or any p of what is glued,    |tau| <= b(p).
 *
 * return_to_admissible() brings trial tractions there. A new law is a header, a source with a
 * function that makes this description, and a line in registered_contact_laws().
 */
struct ContactLaw
{
  std::string name;        //!< in entry Law
  std::string description; //!< of it in the reference of parameters, if the name does not say all

  bool acts   = true;  //!< false: bodies pass through each other
  bool glues  = false; //!< the points that InitialGaps glues; the others do not interact
  bool slides = true;  //!< b is finite

  /**
   * b at a batch of pressures p >= 0; null: no friction. Where b(0) > 0, it acts across open gaps,
   * too.
   */
  void (*bound)(const ContactPairParameters            &parameters,
                const dealii::ArrayView<const double>  &pressures,
                const dealii::ArrayView<FrictionBound> &bounds)
    = nullptr;

  /** Its own entries, and what declares and reads them, and checks them if it `is_chosen`. */
  std::vector<std::string> entries = {};
  void (*declare)(ContactPairParameters &parameters, const ParameterSection &section,
                  const bool is_chosen)
    = nullptr;
};

/** All laws, in the order of the documentation. */
const std::vector<ContactLaw> &registered_contact_laws();

/** The law of that name. */
const ContactLaw &contact_law(const std::string &name);
} // namespace scree
