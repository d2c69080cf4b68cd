#pragma once

#include <scree/mechanics/bulk_quadrature.h>
#include <scree/mechanics/volume_projection.h>

#include <deal.II/lac/full_matrix.h>

#include <array>
#include <vector>

namespace scree
{
/**
 * Volume changes of increments F_D, projected on VolumeModes of each cell: what the laws of bodies
 * that would lock see, and how it depends on F_D (theory.md section 7, Volume changes).
 */
template <int dim>
class IncrementVolumes
{
public:
  /** @param shares of bodies, of a volume change that is replaced by its projection */
  IncrementVolumes(const DisplacementSpace<dim> &space, const std::vector<Body<dim>> &bodies,
                   const BulkQuadrature<dim> &quadrature, const std::vector<double> &shares);

  static constexpr unsigned int n_max = VolumeModes<dim>::n_max;

  /** Of a cell at an increment: sum_m psi_m values[m] is the projected VolumeChange. */
  struct CellVolume
  {
    bool                      is_projected = false;
    std::array<double, n_max> values       = {};
  };
  CellVolume cell_volume(const unsigned int active_cell, const PointEvaluator<dim> &u) const;

  /** Derivatives of CellVolume::values of an own projected cell by the unknowns of the cell. */
  using Derivatives = std::array<std::array<double, dim * max_nodes_per_cell<dim>>, n_max>;
  Derivatives derivatives(const unsigned int active_cell, const PointEvaluator<dim> &u) const;

  /** What the law sees at a point of the cell instead of the increment F_D. */
  dealii::Tensor<2, dim> projected_increment(const unsigned int            active_cell,
                                             const dealii::Point<dim>     &unit_point,
                                             const CellVolume             &volume,
                                             const dealii::Tensor<2, dim> &F_D,
                                             const IncrementStart         &start) const;
  /** The same, and how it depends on F_D; only where volume.is_projected. */
  VolumeChange<dim> change(const unsigned int active_cell, const dealii::Point<dim> &unit_point,
                           const CellVolume &volume, const dealii::Tensor<2, dim> &F_D,
                           const IncrementStart &start, dealii::Tensor<2, dim> &projected) const;

  const VolumeModes<dim> &modes(const unsigned int active_cell) const
  {
    return cell_modes[active_cell];
  }

  /** The points of an own cell while its law is asked. */
  struct CellIncrement
  {
    unsigned int        active_cell;
    unsigned int        n_points;
    std::vector<double> weights; //!< physical, per point

    std::vector<dealii::Tensor<2, dim>>             increments; //!< F_D, then projected
    std::vector<IncrementResponse<dim>>             responses;
    std::vector<VolumeChange<dim>>                  changes;
    std::vector<typename VolumeChange<dim>::Stress> pulled;
  };

  /** What tangents need beside dP/dF_D at fixed volumes. */
  struct Tangents
  {
    /** P by the mode's volume, its force by F_D, its volume by F_D; without psi. */
    std::vector<std::array<dealii::Tensor<2, dim>, 3>> of_points;
    /** Force of a mode of an owned cell by the volume of another one. */
    std::vector<std::array<std::array<double, n_max>, n_max>> of_modes;
  };

  /** Replaces the increments of a cell by projected ones. */
  void project(CellIncrement &cell, CellVolume &volume) const;

  /**
   * Turns the law's answers to projected increments into derivatives by the increments.
   *
   * @param tangents dP/dF_D of the cell's points, null: not asked for
   */
  void pull_back(CellIncrement &cell, dealii::Tensor<4, dim> *tangents, Tangents &of_volumes) const;

  /** Adds the part of the tangent of a cell by way of the volumes. */
  void add_couplings(const unsigned int active_cell, const Tangents &tangents,
                     dealii::FullMatrix<double> &block) const;

private:
  /** psi_m at the points of an own cell, n_max at each. */
  const double *values_of_modes(const unsigned int active_cell) const
  {
    return mode_values.data() + quadrature.first_point(active_cell) * n_max;
  }
  /** Elastic laws: r gives the energy of lambda (projected tr eps)^2/2 + mu eps : eps. */
  double exponent(const unsigned int body) const;

  const DisplacementSpace<dim> &space;
  const std::vector<Body<dim>> &bodies;
  const BulkQuadrature<dim>    &quadrature;
  const std::vector<double>     shares;
  std::vector<VolumeModes<dim>> cell_modes;  //!< of owned cells
  std::vector<double>           mode_values; //!< n_max at each point
};
} // namespace scree
