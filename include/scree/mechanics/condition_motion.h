#pragma once

#include <scree/mechanics/boundary_terms.h>
#include <scree/mechanics/strong_supports.h>

#include <vector>

namespace scree
{
/**
 * Mean displacement since the start of the run of the region of each condition [L], for the u
 * of a step: first of the regions of `terms`, int u dA/int dA over their reference area, then of
 * `supports`, over their nodes with the faces of the cells around them as weights. One reduction
 * (collective).
 */
template <int dim>
std::vector<dealii::Tensor<1, dim>>
mean_displacements(const DisplacementSpace<dim> &space, const BoundaryTerms<dim> &terms,
                   const StrongSupports<dim> &supports, const PointEvaluator<dim> &u);
} // namespace scree
