#pragma once

#include <scree/discretization/cell_cut.h>

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

/** Gauss points per direction of the rules in cells. */
struct GaussPoints
{
  unsigned int bulk;
  unsigned int surface;
};

/**
 * Quadrature on {phi < 0} and {phi = 0} in a cell, phi given by its nodal values: the rules of
 * dealii::NonMatching (Saye 2015) on the unit cell.
 */
template <int dim>
class CutCellRules
{
public:
  /** @param basis of phi */
  CutCellRules(const LagrangeBasis<dim> &basis, const GaussPoints gauss);
  ~CutCellRules();

  /** Points inside and on the surface of a cut cell; `scaled` = phi/h, nudged. */
  struct Rules
  {
    CellPoints<dim> inside, surface;
  };
  Rules rules(const double *scaled, const double cell_size);

  /** The same of a cut; on its convex parts by append_rule(). */
  Rules rules(const CellCut<dim> &cut, const double cell_size);

  /** Points of {phi < 0} on face `face` of a cell, in unit coordinates of the cell. */
  CellPoints<dim> face_rule(const double *scaled, const double cell_size, const unsigned int face);

  /** The same of a cell that is not outside. */
  CellPoints<dim> face_rule(const CellCut<dim> &cut, const double cell_size,
                            const unsigned int face);

  const LagrangeBasis<dim> basis; //!< of phi
  const GaussPoints        gauss;

private:
  class CellLevelSet;
  using Generator = dealii::NonMatching::QuadratureGenerator<dim>;

  std::unique_ptr<CellLevelSet> level_set;
  Generator                     generator;
  std::unique_ptr<Generator>    surface_generator; //!< if it differs
  std::unique_ptr<dealii::NonMatching::FaceQuadratureGenerator<dim>> face_generator;
};
} // namespace scree
