#pragma once

#include <scree/discretization/cut_cell_rules.h>

namespace scree
{
/**
 * Appends points in a convex part of a cell, for polynomials of degree 2n-1, n at most 4: tensor
 * Gauss rules in boxes, else those of Witherden and Vincent (Comput. Math. Appl. 69, 2015) in its
 * simplices. All weights are positive.
 */
template <int dim>
void append_rule(const Polytope<dim> &part, const unsigned int n, const double cell_size,
                 CellPoints<dim> &result);

/**
 * Appends points on a facet with the given normal, for polynomials of degree 2n-1; on triangles,
 * where products of three functions of degree n-1 are not tensor products, of 3(n-1) up to 7.
 */
template <int dim>
void append_rule(const Facet<dim> &facet, const dealii::Tensor<1, dim> &normal,
                 const unsigned int n, const double cell_size, CellPoints<dim> &result);
} // namespace scree
