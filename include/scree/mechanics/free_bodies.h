#pragma once

#include <scree/contact/contact_points.h>
#include <scree/mechanics/boundary_terms.h>
#include <scree/mechanics/rigid_motion.h>
#include <scree/mechanics/strong_supports.h>

#include <vector>

namespace scree
{
/** How a body is held before contact: rigid motions that nothing but contact resists. */
struct FreeMotion
{
  unsigned int body;
  unsigned int n_free; //!< number of free rigid motions
};

/** Which bodies supports do not hold, and which of them contact does not hold either. */
template <int dim>
class FreeBodies
{
public:
  FreeBodies(const Fields<dim> &fields, const std::vector<Body<dim>> &bodies,
             const StrongSupports<dim> &supports, const BoundaryTerms<dim> &boundary_terms,
             const ContactPoints<dim> &contact);

  /** Bodies that supports alone do not hold. */
  const std::vector<FreeMotion> &motions() const
  {
    return free_motions;
  }

  /** Those that the contact of the last evaluation does not hold either (collective). */
  std::vector<unsigned int> not_held() const;

private:
  dealii::FullMatrix<double> resistance_of_supports(const unsigned int       body,
                                                    const RigidMotions<dim> &motions) const;

  const std::vector<Body<dim>> &bodies;
  const StrongSupports<dim>    &supports;
  const BoundaryTerms<dim>     &boundary_terms;
  const ContactPoints<dim>     &contact;
  MPI_Comm                      communicator;
  std::vector<FreeMotion>       free_motions;
};
} // namespace scree
