#pragma once

#include <scree/discretization/displacement_space.h>

#include <vector>

namespace scree
{
/** Points of many cells, one after the other: those of entry i are [begin[i], begin[i+1]). */
template <int dim>
struct QuadratureCache
{
  std::vector<unsigned int>           begin = {0};
  std::vector<dealii::Point<dim>>     points;  //!< unit coordinates
  std::vector<double>                 weights; //!< physical measure
  std::vector<dealii::Tensor<1, dim>> normals; //!< surfaces only

  void append(const CellPoints<dim> &cell)
  {
    points.insert(points.end(), cell.points.begin(), cell.points.end());
    weights.insert(weights.end(), cell.weights.begin(), cell.weights.end());
    normals.insert(normals.end(), cell.normals.begin(), cell.normals.end());
    begin.push_back(points.size());
  }
};

/**
 * Everything that is integrated over the owned cells of the bodies, computed once per grid: points
 * of the physical part of cut cells, of the cut surface, and the tensor rule of the cells inside.
 */
template <int dim>
class CutQuadrature
{
public:
  CutQuadrature(const DisplacementSpace<dim> &space, const LevelSetNodes<dim> &level_set_nodes,
                const std::vector<Body<dim>> &bodies);

  /** Bulk points of owned active cell i; none if the cell is not cut. */
  QuadratureCache<dim> bulk;
  /** Points of the body's surface in owned active cell i; none if the cell is not cut. */
  QuadratureCache<dim> surface;
  /**
   * Distance from each point of `surface` to the boundary along the normal [L]: -phi/|grad phi| of
   * the nearest piece of a shape that has several, else of the cubic interpolant. int s v over the
   * surface is what the integral of v over the body lacks, which is of order h^2 for linear cuts.
   * Zero where parts of exact shapes are cut.
   */
  std::vector<double> strip_widths;
  /** Tensor Gauss rule of a whole cell, for unit edge. */
  CellPoints<dim> whole_cell;
};
} // namespace scree
