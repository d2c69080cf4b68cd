#pragma once

#include <scree/discretization/cut_quadrature.h>

namespace scree
{
/**
 * Appends points in a convex part of a cell, for polynomials of degree 2k+1: tensor Gauss rules in
 * boxes, else those of Witherden and Vincent (Comput. Math. Appl. 69, 2015) in its simplices. All
 * weights are positive.
 */
template <int dim>
void append_rule(const Polytope<dim> &part, const unsigned int k, const double cell_size,
                 CellPoints<dim> &result);

/** Appends points on a facet with the given normal, for polynomials of degree 3k. */
template <int dim>
void append_rule(const Facet<dim> &facet, const dealii::Tensor<1, dim> &normal,
                 const unsigned int k, const double cell_size, CellPoints<dim> &result);
} // namespace scree
