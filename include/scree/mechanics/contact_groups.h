#pragma once

#include <scree/bodies/body.h>
#include <scree/contact/contact_points.h>
#include <scree/discretization/displacement_space.h>
#include <scree/solver/partition.h>

#include <vector>

namespace scree
{
/**
 * Groups of bodies that touch: between unknowns of different groups nothing acts. Rigid bodies of
 * prescribed motion, which have no unknowns, join nothing.
 */
template <int dim>
class ContactGroups
{
public:
  /** All arguments outlive it. */
  ContactGroups(const DisplacementSpace<dim> &space, const std::vector<Body<dim>> &bodies,
                const ContactPoints<dim> &contact);

  /** Takes no bodies to touch. */
  void clear();

  /** Adds the pairs that are in contact at the last ContactPoints::evaluate(). */
  void add();

  /** The group of each body, numbered from zero (collective). */
  std::vector<unsigned int> groups() const;

  /** The groups by their unknowns (collective). */
  Partition partition() const;

private:
  const ContactPoints<dim> &contact;
  const MPI_Comm            communicator;
  std::vector<unsigned int> body_of_unknown; //!< of the owned ones
  std::vector<bool>         is_joining;      //!< bodies with unknowns
  std::vector<unsigned int> are_touching;    //!< pairs, on this process
};
} // namespace scree
