#pragma once

#include <scree/mechanics/nitsche_stiffness.h>
#include <scree/mechanics/prescribed_values.h>
#include <scree/mechanics/volume_projection.h>

#include <vector>

namespace scree
{
/**
 * Displacements prescribed on bodies that keep their volume: Nitsche's penalty on the moments of
 * the normal displacement over the surface in each cell, int psi_m n.(u_n + u - ubar), see
 * NitscheStiffness.
 */
template <int dim>
class NormalMoments
{
public:
  using Vector = dealii::TrilinosWrappers::MPI::Vector;
  using Matrix = dealii::TrilinosWrappers::SparseMatrix;

  NormalMoments(const BoundarySetting<dim> &setting, const std::vector<unsigned int> &own_regions,
                const NitscheStiffness<dim> &stiffness, const PrescribedValues<dim> &prescribed);

  void add_to_matrix(Matrix &matrix) const;

  void add_loads(Vector &loads, const double time) const;

  /** What the moments add to the traction at a point. */
  dealii::Tensor<1, dim> traction(const unsigned int region, const unsigned int q,
                                  const PointEvaluator<dim> &u, const double time) const;

private:
  /** Those of one cell. */
  struct CellMoments
  {
    unsigned int     region, begin, end; //!< points of the cell
    double           stiffness;
    VolumeModes<dim> modes;
    /** Coefficients of each moment by the unknowns of the cell. */
    std::vector<std::vector<double>> rows;
  };
  /** CellMoments::rows of moment m. */
  std::vector<double> row(const CellMoments &moments, const unsigned int m) const;
  /** int psi_m n.(ubar - u_n) over the prescribed components. */
  double                prescribed_moment(const CellMoments &moments, const unsigned int m,
                                          const double time) const;
  std::vector<DofIndex> unknowns(const CellMoments &moments) const;

  const DisplacementSpace<dim>           &space;
  const std::vector<BoundaryRegion<dim>> &regions;
  const PrescribedValues<dim>            &prescribed;
  std::vector<CellMoments>                of_cells;
  std::vector<std::vector<int>>           moments_of_point; //!< [region][q], -1: none
};
} // namespace scree
