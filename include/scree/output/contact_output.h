#pragma once

#include <scree/contact/contact_points.h>
#include <scree/output/field_parameters.h>

#include <array>
#include <string>
#include <vector>

namespace scree
{
/** What happens between two bodies, summed over their contact surface and all processes. */
template <int dim>
struct ContactSummary
{
  dealii::Tensor<1, dim> force;  //!< on body b
  dealii::Tensor<1, 3>   moment; //!< of that force about the origin; 2D: only the last component
  /** Sums f x^T of the forces f on b at the sides of a and b, where their displacements are taken.
   */
  dealii::Tensor<2, dim> virial_a, virial_b;
  double                 strength = 0.;        //!< sum of the |f| of points [force]
  dealii::Tensor<1, dim> placed;               //!< sum |f| x [force L]
  dealii::Tensor<1, dim> directed;             //!< sum |f| n [force]
  double                 minimum_gap = 0.;     //!< smallest gap, negative: penetration [L]
  dealii::Point<dim>     where;                //!< of the smallest gap
  double                 max_penetration = 0.; //!< largest penetration [L]
  double                 max_pressure    = 0.; //!< [force/area]
  double                 open = 0., stick = 0., slip = 0.;      //!< length or area by status
  double open_points = 0., stick_points = 0., slip_points = 0.; //!< number of points by status

  bool is_closed() const
  {
    return stick_points + slip_points > 0.;
  }

  /** Mean of the places of the forces |f|; NaN without any. */
  dealii::Point<dim> place() const
  {
    return dealii::Point<dim>(placed / strength);
  }

  /** Unit vector of the mean normal, weighted in the same way. */
  dealii::Tensor<1, dim> normal() const
  {
    return directed / directed.norm();
  }

  /** Along normal(), positive in compression; zero without force. */
  double normal_force() const
  {
    return strength > 0. ? force * normal() : 0.;
  }

  /** Magnitude of the rest. */
  double tangential_force() const
  {
    return strength > 0. ? (force - normal_force() * normal()).norm() : 0.;
  }

  /** Adds what other points of the same pair do. */
  void merge(const ContactSummary &other);

  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &force &moment &minimum_gap &where &max_penetration &max_pressure;
    archive &virial_a &virial_b &strength &placed               &directed;
    archive &open &stick &slip &open_points &stick_points       &slip_points;
  }
};

/**
 * The summary of every pair after the last evaluation.
 *
 * @param geometry_is_moving whether virials and places are where the bodies have moved to
 */
template <int dim>
std::vector<ContactSummary<dim>> summarise_contact(const ContactPoints<dim> &contact,
                                                   const MPI_Comm            communicator,
                                                   const bool geometry_is_moving = false);

/** Names of the columns of a contact point, see write_contact_csv(). */
template <int dim>
std::vector<std::string> contact_columns();

/** The columns of a contact point, with the number of the pair in the first. */
template <int dim>
using ContactRow = std::array<double, 6 + 5 * dim>;

/** Those of each contact point of this process. */
template <int dim>
std::vector<ContactRow<dim>> contact_rows(const ContactPoints<dim> &contact);

/**
 * Writes DIR/contact_NNNN.csv with all contact points, sorted by pair and position: pair, position,
 * normal, weight, gap, pressure p, tangential traction, jump [[u]], status (0 open, 1 stick, 2
 * slip), means of p and the tangential traction over the points in its cell. The first process
 * writes; returns false there if it could not.
 */
template <int dim>
bool write_contact_csv(const ContactPoints<dim> &contact, const MPI_Comm communicator,
                       const std::string &directory, const unsigned int number);

/**
 * Writes the same as points to DIR/contact_NNNN.vtu or .pvtu, see write_vtu_files(), with the field
 * data TimeValue and pair.NAME, the number of each pair.
 */
template <int dim>
std::string write_contact_vtu(const ContactPoints<dim> &contact, const FieldParameters &parameters,
                              const MPI_Comm communicator, const std::string &directory,
                              const unsigned int number, const double time);
} // namespace scree
