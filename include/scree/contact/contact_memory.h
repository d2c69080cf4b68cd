#pragma once

#include <scree/contact/contact_points.h>

#include <boost/serialization/vector.hpp>
#include <mpi.h>
#include <vector>

namespace scree
{
/**
 * What the material points of the contact surfaces remember when the geometry moves: one entry of
 * each array per old contact point. Pairs are found anew in each step, entries name their bodies.
 * All processes hold all entries, in an order that does not depend on their number.
 */
template <int dim>
struct ContactMemory
{
  std::vector<unsigned int>           body_a, body_b; //!< numbers of the bodies, a < b
  std::vector<dealii::Point<dim>>     position;       //!< [L]
  std::vector<dealii::Tensor<1, dim>> normal;         //!< unit, from a to b
  std::vector<double>                 weight;         //!< length or area
  std::vector<double>                 cell_size;      //!< h where the point was [L]
  std::vector<dealii::Tensor<1, dim>> tau;            //!< tangential traction on b
  std::vector<double>                 pressure;       //!< positive in compression

  std::size_t size() const
  {
    return position.size();
  }

  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &body_a &body_b &position &normal &weight &cell_size &tau &pressure;
  }
};

/**
 * The points that are closed, or open by at most a cell, moved by the last evaluation: the latter
 * carry zero, so that tractions end where contact ended; of tied pairs the glued ones. Collective.
 */
template <int dim>
ContactMemory<dim> remember(const ContactPoints<dim> &contact, const MPI_Comm communicator);

/**
 * Moves remembered points by their displacements m: x' = x + m. Tangents T of the surface before
 * and T' after are the slopes of x and x' over the old tangent plane (weighted linear least squares
 * over the neighbours within two cells). With the polar decompositions T = E (T^T T)^{1/2} and T' =
 * E' (T'^T T')^{1/2}, R the rotation from E to E' and J the ratio of areas,
 *
 *     n' = R n,   weight' = J weight,   tau' = R tau/J,   p' = p/J,
 *
 * so that the force of a point keeps its length and turns with the surface: exactly for rigid
 * motions. Points with too few neighbours keep n, tau and p.
 */
template <int dim>
ContactMemory<dim> moved(const ContactMemory<dim>                  &memory,
                         const std::vector<dealii::Tensor<1, dim>> &displacement);

/**
 * History of contact points from what old points of the same bodies remember, with [[u]]_n = 0.
 * Neighbours within two cells whose normals differ by less than 60 degrees are turned into the new
 * tangent plane, keeping their length, and interpolated there: moving least squares of degree 2, or
 * 1 where all neighbours lie on one side or their places determine no more (0 if not even that),
 * with weights (1 - d^2/r^2)^2/d^2 that are singular at d = 0 (Lancaster and Salkauskas, Math.
 * Comp. 37, 1981). So coinciding points get what was remembered, and polynomials of degree 2 on
 * planes are reproduced: degree 1 would lose a part of every maximum in every step. Results differ
 * from the weighted mean by at most the scatter of the neighbours' values; where all neighbours lie
 * on one side they are at most as large as the largest value and do not reverse. Zero without
 * neighbours. O(n).
 */
template <int dim>
ContactHistory<dim> recall(const std::vector<ContactPoint<dim>> &points,
                           const std::vector<ContactPair> &pairs, const ContactMemory<dim> &memory);

/** The same for the points of this process. */
template <int dim>
ContactHistory<dim> recall(const ContactPoints<dim> &contact, const ContactMemory<dim> &memory);

/** Contact forces of a pair on body b before and after they are transferred to new points. */
template <int dim>
struct TransferredForce
{
  dealii::Tensor<1, dim> total_before, total_after;           //!< int p n + tau
  dealii::Tensor<1, dim> tangential_before, tangential_after; //!< int tau
};

/**
 * Forces of what is remembered and of what is recalled, for each pair of `contact`, both with the
 * normals at the start of the step. Collective.
 */
template <int dim>
std::vector<TransferredForce<dim>>
transferred_forces(const ContactPoints<dim> &contact, const ContactMemory<dim> &memory,
                   const ContactHistory<dim> &history, const MPI_Comm communicator);

/**
 * Gives each pair of `contact` the resultant of the tangential tractions that is remembered: with D
 * what is missing after recall() and S = int |tau|, tau <- tau + |tau| P D/S, P = I - n n^T of the
 * surface at the start of the step, where |D| < S/10; else the surface has changed and tau stays.
 * Collective.
 */
template <int dim>
void keep_resultants(const ContactPoints<dim> &contact, const ContactMemory<dim> &memory,
                     ContactHistory<dim> &history, const MPI_Comm communicator);
} // namespace scree
