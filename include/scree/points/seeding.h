#pragma once

#include <scree/discretization/cut_quadrature.h>
#include <scree/points/material_points.h>

namespace scree
{
/**
 * Places material points in the active cells of this process, undeformed, with volumes that sum to
 * the cut quadrature's volume of the body in every cell (theory.md section 9). Masses are those of
 * the cells up to the exact boundary, see CutQuadrature::strip_widths.
 */
template <int dim>
class PointSeeding
{
public:
  /** All arguments are referenced; `density` [M/L^dim] has an entry per body. */
  PointSeeding(const DisplacementSpace<dim> &space, const LevelSetNodes<dim> &level_set_nodes,
               const std::vector<Body<dim>> &bodies, const CutQuadrature<dim> &quadrature,
               const std::vector<double> &density);

  /** At the bulk quadrature points; each takes its weight as volume. */
  MaterialPoints<dim> at_quadrature_points(const unsigned int n_internal) const;

  /**
   * On a regular grid of m^dim sub-cells per cell: at the centroid of the part of each sub-cell
   * that lies in the body. A part of less than a tenth of a sub-cell joins the nearest larger one
   * of its cell; where there is none, all parts become one point, at the largest.
   */
  MaterialPoints<dim> on_sub_grid(const unsigned int m, const unsigned int n_internal) const;

private:
  void            add_cell(MaterialPoints<dim> &points, const unsigned int active_cell,
                           const CellPoints<dim> &cell_points, const unsigned int n_per_direction) const;
  CellPoints<dim> quadrature_points(const unsigned int active_cell) const;
  /** The volume of the body in a cell, with the strips up to its boundary, over that of points. */
  double whole_volume_ratio(const unsigned int     active_cell,
                            const CellPoints<dim> &cell_points) const;

  const DisplacementSpace<dim> &space;
  const LevelSetNodes<dim>     &level_set_nodes;
  const std::vector<Body<dim>> &bodies;
  const CutQuadrature<dim>     &quadrature;
  const std::vector<double>    &density;
};
} // namespace scree
