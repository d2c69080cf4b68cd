#pragma once

#include <scree/discretization/cell_scatter.h>
#include <scree/mechanics/answered_increment.h>
#include <scree/mechanics/bulk.h>
#include <scree/mechanics/increment_volumes.h>

#include <optional>
#include <vector>

namespace scree
{
/**
 * The bulk in the increment u since the start of a step: int P(F_D) : grad v over Omega_n with P of
 * the laws in increments, which is no matrix but forces and a tangent at u.
 */
template <int dim>
class IncrementalBulk : public Bulk<dim>
{
public:
  using typename Bulk<dim>::Matrix;
  using typename Bulk<dim>::Vector;
  using typename Bulk<dim>::Work;
  using CellVolume = typename IncrementVolumes<dim>::CellVolume;

  /**
   * Collective.
   *
   * @param points where the laws are asked
   * @param u_n    at the start of the step
   */
  IncrementalBulk(const DisplacementSpace<dim> &space, const CutQuadrature<dim> &quadrature,
                  const std::vector<Body<dim>> &bodies, const SmallCutTreatment<dim> &small_cuts,
                  const BulkQuadrature<dim> &points, const PointEvaluator<dim> &u_n);

  bool is_linear() const override
  {
    return false;
  }

  void add_internal_forces(const PointEvaluator<dim> &u, Vector &forces) const override;

  void add_tangent(const PointEvaluator<dim> &u, Matrix &matrix) const override;

  Work work(const PointEvaluator<dim> &u) const override;

  /** The displacement is u_n + u, the strain ln V of F = V R with the projected volume change. */
  BulkSample<dim> sample(const unsigned int active_cell, const dealii::Point<dim> &unit_point,
                         const PointEvaluator<dim> &u) const override;

  /** int P F_D^T over Omega_n, the Cauchy stress at the end of the step over where bodies are. */
  std::vector<StressIntegral<dim>> stress_integrals(const PointEvaluator<dim> &u) const override;

  /** The projected volumes of active cells at the increment u; of owned ones. */
  const std::vector<CellVolume> &cell_volumes(const PointEvaluator<dim> &u) const;

  const IncrementVolumes<dim> &volume_projection() const
  {
    return projection;
  }

private:
  using CellIncrement = typename IncrementVolumes<dim>::CellIncrement;

  CellRule<dim> rule(const unsigned int active_cell) const override;

  void set_reference_volumes(const unsigned int   active_cell,
                             std::vector<double> &volumes) const override;

  void find_secant_ratios();
  /** What the laws answer to an increment u: once for forces, tangent and work. */
  struct Answers : AnsweredIncrement<dim>
  {
    std::vector<dealii::Tensor<2, dim>>      piola;    //!< at all points, cell after cell
    std::vector<dealii::Tensor<4, dim>>      tangents; //!< likewise
    Work                                     work;     //!< on this process
    std::vector<CellVolume>                  volumes;  //!< of active cells
    typename IncrementVolumes<dim>::Tangents of_volumes;
  };
  /** Those to u, asked for if the last ones were others. */
  const Answers &answers(const PointEvaluator<dim> &u, const bool with_tangents) const;
  void           ask(const unsigned int active_cell, CellIncrement &cell) const;

  using Bulk<dim>::bodies;
  using Bulk<dim>::space;
  using Bulk<dim>::projected_shares;

  const BulkQuadrature<dim>  &points;
  const PointEvaluator<dim>  &u_n;
  const IncrementVolumes<dim> projection;
  mutable Answers             last; //!< to the last increment
  /** Of the last tangent. */
  mutable std::optional<CellScatter<dim>> scatter;
};
} // namespace scree
