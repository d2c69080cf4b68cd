#pragma once

#include <scree/discretization/displacement_space.h>

#include <deal.II/non_matching/quadrature_generator.h>

#include <memory>
#include <vector>

namespace scree
{
/** Quadrature points of one cell in unit coordinates; weights in physical measure. */
template <int dim>
struct CellPoints
{
  std::vector<dealii::Point<dim>>     points;
  std::vector<double>                 weights;
  std::vector<dealii::Tensor<1, dim>> normals; //!< surfaces only: unit, out of {phi < 0}

  void append(const CellPoints &other)
  {
    points.insert(points.end(), other.points.begin(), other.points.end());
    weights.insert(weights.end(), other.weights.begin(), other.weights.end());
    normals.insert(normals.end(), other.normals.begin(), other.normals.end());
  }
};

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
 * Quadrature on {phi < 0} and {phi = 0} in a cell, phi given by its nodal values of degree k: the
 * rules of dealii::NonMatching (Saye 2015) on the unit cell, with k+1 Gauss points per direction.
 */
template <int dim>
class CutCellRules
{
public:
  explicit CutCellRules(const LagrangeBasis<dim> &basis);
  ~CutCellRules();

  /** Points inside and on the surface of a cut cell; `scaled` = phi/h, nudged. */
  struct Rules
  {
    CellPoints<dim> inside, surface;
  };
  Rules rules(const double *scaled, const double cell_size);

  /** The same of a cut; exact on its convex parts for polynomials of degree 2k+1 (surface: 3k). */
  Rules rules(const CellCut<dim> &cut, const double cell_size);

  /** Points of {phi < 0} on face `face` of a cell, in unit coordinates of the cell. */
  CellPoints<dim> face_rule(const double *scaled, const double cell_size, const unsigned int face);

  /** The same of a cell that is not outside. */
  CellPoints<dim> face_rule(const CellCut<dim> &cut, const double cell_size,
                            const unsigned int face);

private:
  class CellLevelSet;
  const unsigned int                                                 degree;
  std::unique_ptr<CellLevelSet>                                      level_set;
  dealii::hp::QCollection<1>                                         gauss;
  dealii::NonMatching::QuadratureGenerator<dim>                      generator;
  std::unique_ptr<dealii::NonMatching::FaceQuadratureGenerator<dim>> face_generator;
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
