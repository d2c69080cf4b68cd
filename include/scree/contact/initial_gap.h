#pragma once

#include <scree/contact/contact_surface.h>

#include <array>

namespace scree
{
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

  /** Whether the law of the pair needs the gaps. */
  bool are_needed(const unsigned int pair) const;

  /**
   * With X_a = x - u_a, X_b = x - u_b and G = phi_a + phi_b of the initial level sets: takes
   * (A(X_a) + A(X_b))/2 off the gap, A = G where |G| <= Adjust, else 0, and glues a tied point
   * where what is left of (G(X_a) + G(X_b))/2 is at most the tied gap and the region selects
   * (X_a + X_b)/2. Beyond an edge, where the surfaces do not face each other, nothing is adjusted
   * and the tied gap is a tenth: there the gap opens from the edge on.
   *
   * @param displacement u_a, u_b since the start of the run [L]
   */
  void apply(const std::array<dealii::Tensor<1, dim>, 2> &displacement,
             ContactPoint<dim>                           &point) const;

private:
  const std::vector<Body<dim>>   &bodies;
  const std::vector<ContactPair> &pairs;
  std::vector<Expression<dim>>    regions; //!< of the pairs
  unsigned int                    degree;
};
} // namespace scree
