#pragma once

#include <scree/discretization/cut_quadrature.h>
#include <scree/mechanics/cell_rule.h>

namespace scree
{
/** The rule of an owned active cell in the cut quadrature. */
template <int dim>
CellRule<dim> cut_cell_rule(const DisplacementSpace<dim> &space,
                            const CutQuadrature<dim> &quadrature, const unsigned int active_cell);
} // namespace scree
