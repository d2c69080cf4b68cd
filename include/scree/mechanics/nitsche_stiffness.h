#pragma once

#include <scree/mechanics/boundary_term.h>

namespace scree
{
/**
 * Stiffness per area of prescribed displacements: beta = factor k^2 (2 mu + lambda)/h of penalty at
 * a point; of Nitsche with rho (2 mu + min(lambda, 4 mu)), rho the secant ratio of plastic flow, at
 * least 0.1. The rest of 2 mu + lambda acts on the moments of the normal displacement over the
 * cell, as its pressure does: held point by point, a curved surface would lock what keeps its
 * volume.
 */
template <int dim>
class NitscheStiffness
{
public:
  explicit NitscheStiffness(const BoundarySetting<dim> &setting);

  /** Of Nitsche's moduli in a cell that flows. */
  double flow_ratio(const unsigned int active_cell) const;

  /** beta [force/area/L]. */
  double of_point(const BoundaryRegion<dim> &region, const unsigned int q) const;

  /** What acts on moments over the cell of a point [force/area/L]; zero: nothing. */
  double of_moments(const BoundaryRegion<dim> &region, const unsigned int q) const;

private:
  /** Share of the whole that acts at points. */
  double pointwise_share(const BoundaryRegion<dim> &region, const unsigned int q) const;

  const DisplacementSpace<dim> &space;
  const std::vector<Body<dim>> &bodies;
  const Bulk<dim>              &bulk;
};
} // namespace scree
