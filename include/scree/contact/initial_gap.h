#pragma once

#include <scree/contact/contact_surface.h>

#include <array>
#include <boost/serialization/map.hpp>
#include <boost/serialization/utility.hpp>
#include <map>

namespace scree
{
/** The least gaps at the start of the run of pairs that are adjusted as a whole. */
struct StartGaps
{
  bool                                                    are_known = false;
  std::map<std::pair<unsigned int, unsigned int>, double> of_bodies; //!< [L]

  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &are_known &of_bodies;
  }
};

/** What the laws of pairs do with the gaps at the start of the run. */
template <int dim>
class InitialGaps
{
public:
  /**
   * @param reach gap at which the contact surface ends [L]
   * @throws UserError if a law adjusts or glues gaps beyond `reach`, or its region does not parse
   */
  InitialGaps(const std::vector<Body<dim>> &bodies, const std::vector<ContactPair> &pairs,
              const double reach, const unsigned int degree);

  /**
   * Sets what is taken off pairs that are adjusted as a whole: their least gap at the start, if
   * that is at most Adjust. Collective.
   *
   * @param points at the start of the run, if start_gaps are not known yet
   */
  void adjust_pairs(const std::vector<ContactPoint<dim>> &points, const MPI_Comm communicator,
                    StartGaps &start_gaps);

  /** Whether the law of the pair needs the gaps. */
  bool are_needed(const unsigned int pair) const;

  /**
   * With X_a = x - u_a, X_b = x - u_b and G = phi_a + phi_b of the initial level sets: takes what
   * adjust_pairs() found off the gap, or of laws that adjust points (A(X_a) + A(X_b))/2, A = G
   * where |G| <= Adjust, else 0. Glues a tied point
   * where what is left of (G(X_a) + G(X_b))/2 is at most the tied gap and the region selects
   * (X_a + X_b)/2. Beyond an edge, where the surfaces do not face each other, no point is adjusted
   * and the tied gap is a tenth: there the gap opens from the edge on.
   *
   * @param displacement u_a, u_b since the start of the run [L]
   */
  void apply(const std::array<dealii::Tensor<1, dim>, 2> &displacement,
             ContactPoint<dim>                           &point) const;

private:
  const std::vector<Body<dim>>   &bodies;
  const std::vector<ContactPair> &pairs;
  std::vector<Expression<dim>>    regions;  //!< of the pairs
  std::vector<double>             of_pairs; //!< taken off all points of a pair [L]
  unsigned int                    degree;
};
} // namespace scree
