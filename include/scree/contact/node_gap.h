#pragma once

#include <scree/contact/expected_slide.h>

namespace scree
{
/**
 * Gaps of contact at grid nodes (theory.md section 8). The level sets of bodies that deform have
 * slopes other than one: at a node, up to a cell from the surface, phi_a + phi_b has a share of
 * this distance. The gap is that of the foot y of the node on S = {phi_a = phi_b},
 *
 *     g_0 = phi_a(y) + phi_b(y).
 */
template <int dim>
class NodeGaps
{
public:
  /** @param prediction of the increments d_b; empty: bodies are expected to rest */
  NodeGaps(const std::vector<Body<dim>> &bodies, const IncrementPrediction<dim> &prediction)
      : bodies(bodies)
      , prediction(prediction)
  {
  }

  /** The gap at the start of a step of a node with the normal n from a to b. */
  double at_start(const ContactPair &pair, const dealii::Point<dim> &x,
                  const dealii::Tensor<1, dim> &n, const double cell_size) const;

  /**
   * Gap and normal of a point as the moved bodies have them in the end, whatever material is at the
   * node then: with phi'_b(x) = phi_b(x - d_b(x)),
   *
   *     n' = n + grad(phi'_a - phi_a - phi'_b + phi_b)/2, normalised,
   *     g_0 = phi'_a(y') + phi'_b(y') - n'.(d_b - d_a),    y' the foot on {phi'_a = phi'_b}.
   *
   * Where a body is strained by more than 1e-3 in the step nothing is expected, gap and normal are
   * those of the start: where material flows apart at a tip, and at nodes that it hardly reaches,
   * one increment does not tell the next.
   */
  void expect_motion(const ContactPair &pair, ContactPoint<dim> &point) const;

private:
  double distance(const unsigned int b, const dealii::Point<dim> &x) const;
  double moved_distance(const unsigned int b, const dealii::Point<dim> &x) const;
  /** |E| of the increment, 2 E = F^T F - I, F = I + grad d_b by differences over a cell. */
  double expected_strain(const unsigned int b, const dealii::Point<dim> &x,
                         const double cell_size) const;

  const std::vector<Body<dim>>   &bodies;
  const IncrementPrediction<dim> &prediction;
};
} // namespace scree
