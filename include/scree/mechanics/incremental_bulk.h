#pragma once

#include <scree/mechanics/answered_increment.h>
#include <scree/mechanics/bulk.h>
#include <scree/mechanics/step_start.h>
#include <scree/mechanics/volume_projection.h>

#include <array>
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

  /** Collective. */
  IncrementalBulk(const Fields<dim> &fields, const CutQuadrature<dim> &quadrature,
                  const std::vector<Body<dim>> &bodies, const SmallCutTreatment<dim> &small_cuts,
                  const StepStart<dim> &start);

  void add_internal_forces(const PointEvaluator<dim> &u, Vector &forces) const override;

  void add_tangent(const PointEvaluator<dim> &u, Matrix &matrix) const override;

  bool is_linear() const override
  {
    return false;
  }

  Work work(const PointEvaluator<dim> &u) const override;

  /** The displacement is u_n + u, the strain Green's. */
  BulkSample<dim> sample(const unsigned int active_cell, const dealii::Point<dim> &unit_point,
                         const PointEvaluator<dim> &u) const override;

  /** Of active cells at the increment u: sum_m psi_m values[m] is the projected VolumeChange. */
  struct CellVolume
  {
    bool                                        is_projected = false;
    std::array<double, VolumeModes<dim>::n_max> values       = {};
  };
  const std::vector<CellVolume> &cell_volumes(const PointEvaluator<dim> &u) const;

  /** Derivatives of CellVolume::values of an own projected cell by the unknowns of the cell. */
  using VolumeDerivatives
    = std::array<std::array<double, dim * max_nodes_per_cell<dim>>, VolumeModes<dim>::n_max>;
  VolumeDerivatives volume_derivatives(const unsigned int         active_cell,
                                       const PointEvaluator<dim> &u) const;

  /** What the law sees at a point of the cell instead of the increment F_D. */
  dealii::Tensor<2, dim> projected_increment(const unsigned int            active_cell,
                                             const dealii::Point<dim>     &unit_point,
                                             const CellVolume             &volume,
                                             const dealii::Tensor<2, dim> &F_D,
                                             const IncrementStart         &start) const;
  /** The same, and how it depends on F_D; only where volume.is_projected. */
  VolumeChange<dim>       volume_change(const unsigned int        active_cell,
                                        const dealii::Point<dim> &unit_point, const CellVolume &volume,
                                        const dealii::Tensor<2, dim> &F_D, const IncrementStart &start,
                                        dealii::Tensor<2, dim> &projected) const;
  const VolumeModes<dim> &volume_modes(const unsigned int active_cell) const
  {
    return modes[active_cell];
  }

private:
  void set_reference_volumes(const unsigned int   active_cell,
                             std::vector<double> &volumes) const override;

  void set_up_points();
  void set_up_modes();
  void find_secant_ratios();
  /** What the laws answer to an increment u: once for forces, tangent and work. */
  struct Answers : AnsweredIncrement<dim>
  {
    std::vector<dealii::Tensor<2, dim>> piola;    //!< at all points, cell after cell
    std::vector<dealii::Tensor<4, dim>> tangents; //!< likewise
    Work                                work;     //!< on this process
    std::vector<CellVolume>             volumes;  //!< of active cells
    // Of projected volume changes.
    /** P by the mode's volume, its force by F_D, its volume by F_D; without psi. */
    std::vector<std::array<dealii::Tensor<2, dim>, 3>> volume_tensors;
    /** Force of a mode of an owned cell by the volume of another one. */
    std::vector<std::array<std::array<double, VolumeModes<dim>::n_max>, VolumeModes<dim>::n_max>>
      mode_stiffness;
  };
  /** Those to u, asked for if the last ones were others. */
  const Answers &answers(const PointEvaluator<dim> &u, const bool with_tangents) const;
  /** Points of a cell while its law is asked. */
  struct CellIncrement
  {
    unsigned int          active_cell;
    unsigned int          n_points;
    std::vector<double>   weights;     //!< physical, per point
    const double         *mode_values; //!< of VolumeModes, per point
    const IncrementStart *starts;

    std::vector<dealii::Tensor<2, dim>>             increments; //!< F_D, projected
    std::vector<IncrementResponse<dim>>             responses;
    std::vector<VolumeChange<dim>>                  changes;
    std::vector<typename VolumeChange<dim>::Stress> pulled;
  };
  void       ask(const unsigned int active_cell, CellIncrement &cell) const;
  CellVolume cell_volume(const unsigned int active_cell, const PointEvaluator<dim> &u) const;
  /** Unit gradients of the basis at the points of a cell. */
  const double *unit_gradients(const unsigned int active_cell) const
  {
    return fields.cells()[active_cell].is_cut ? &cut_gradients[first_gradient[active_cell]]
                                              : whole_gradients.data();
  }
  /** F_D with unit gradients of the basis at a point. */
  dealii::Tensor<2, dim> increment(const unsigned int active_cell, const double *gradients,
                                   const PointEvaluator<dim> &u) const
  {
    return u.gradient(active_cell, gradients)
           + dealii::Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>());
  }

  // Projected volume changes, incremental_bulk_volume.cc.
  /** Replaces the increments of a cell by projected ones. */
  void project(CellIncrement &cell) const;
  /** Turns the law's answers to projected increments into derivatives by the increments. */
  void pull_back(CellIncrement &cell) const;
  void add_volume_couplings(const unsigned int          active_cell,
                            dealii::FullMatrix<double> &block) const;

  using Bulk<dim>::bodies;
  using Bulk<dim>::fields;
  using Bulk<dim>::projected_shares;
  using Bulk<dim>::rule;

  const StepStart<dim>         &start;
  std::vector<IncrementStart>   starts;          //!< at all points, cell after cell
  std::vector<double>           volume_ratios;   //!< J_n at all points
  std::vector<std::size_t>      first_point;     //!< of each owned cell
  std::vector<double>           cut_gradients;   //!< of the basis at points of cut cells
  std::vector<std::size_t>      first_gradient;  //!< of each owned cell
  std::vector<double>           whole_gradients; //!< of the basis for unit edge
  std::vector<VolumeModes<dim>> modes;           //!< of owned cells
  std::vector<double>           mode_values;     //!< n_max at each point
  mutable Answers               last;            //!< to the last increment
};
} // namespace scree
