#pragma once

#include <scree/mechanics/answered_increment.h>
#include <scree/mechanics/incremental_bulk.h>
#include <scree/mechanics/prescribed_displacements.h>

namespace scree
{
/** Prescribed displacements with the stress vector P(F_D) n of the laws in increments. */
template <int dim>
class IncrementalNitsche : public PrescribedDisplacements<dim>
{
public:
  using typename BoundaryTerm<dim>::Vector;
  using typename BoundaryTerm<dim>::Matrix;

  /**
   * @param bulk       of the same step: stresses see its projected volume changes
   * @param quadrature brings the histories
   */
  IncrementalNitsche(const BoundarySetting<dim>      &setting,
                     const std::vector<unsigned int> &own_regions, const IncrementalBulk<dim> &bulk,
                     const BulkQuadrature<dim> &quadrature);

  bool is_linear() const override;

  void add_internal_forces(const PointEvaluator<dim> &u, const double time,
                           Vector &forces) const override;

  void add_tangent(const PointEvaluator<dim> &u, const double time, Matrix &matrix) const override;

  /** False: the adjoint term is that of zero strain. */
  bool is_symmetric() const override;

private:
  std::vector<dealii::Tensor<1, dim>> fluxes(const unsigned int         region,
                                             const PointEvaluator<dim> &u) const override;

  void find_starts(const BulkQuadrature<dim> &quadrature);
  /** The law's answer at a point. */
  struct PointAnswer
  {
    dealii::Tensor<2, dim> piola;
    dealii::Tensor<4, dim> tangent; //!< dP/dF_D at fixed volume of the cell
    /** Of a projected volume change: dP by the values of the modes, but for psi_m. */
    dealii::Tensor<2, dim> by_volume;
  };
  /** Those to an increment u at all points: once for forces, tractions and tangent. */
  struct Answers : AnsweredIncrement<dim>
  {
    std::vector<std::vector<PointAnswer>> of_points; //!< [region][q]
  };
  /** Those to u, asked for if the last ones were others. */
  const Answers &answers(const PointEvaluator<dim> &u, const bool with_tangents) const;
  void           ask(const unsigned int region) const;
  using VolumeDerivatives = typename IncrementVolumes<dim>::Derivatives;
  /** Sets the derivative of the forces of a point; `volume` of its cell, null: not projected. */
  void set_point_tangent(const BoundaryRegion<dim> &region, const BoundaryPoint<dim> &point,
                         const PointAnswer &answer, const VolumeDerivatives *volume,
                         dealii::FullMatrix<double> &block) const;

  using BoundaryTerm<dim>::own_regions;
  using PrescribedDisplacements<dim>::bodies;
  using PrescribedDisplacements<dim>::space;
  const IncrementalBulk<dim>              &bulk;
  std::vector<unsigned int>                nitsche_regions; //!< of the own ones
  std::vector<std::vector<IncrementStart>> starts;          //!< [region][q]
  mutable Answers                          last;            //!< to the last increment
};
} // namespace scree
