#pragma once

#include <scree/discretization/cut_quadrature.h>
#include <scree/mechanics/moving_geometry_parameters.h>
#include <scree/mechanics/reference_map.h>
#include <scree/mechanics/volume_projection.h>
#include <scree/points/moving_least_squares.h>

#include <optional>
#include <vector>

namespace scree
{
/**
 * What a step on a moving geometry starts from: the displacement u_n = x - X since the start of
 * the run and the material's history, anywhere in the bodies. u_n is the fit of the material
 * points (fit_displacement()) and gives F_n = (I - grad u_n)^{-1}; or F_n comes from the points by
 * moving least squares. Internal variables always do, by those that interpolate: stresses that are
 * smoothed in every step fall below the yield stress where the material flows.
 */
template <int dim>
class StepStart
{
public:
  using Vector = dealii::TrilinosWrappers::MPI::Vector;

  /** Collective. Points are those of the owned cells. */
  StepStart(const DisplacementSpace<dim> &space, const CutQuadrature<dim> &quadrature,
            const std::vector<Body<dim>> &bodies, const MaterialPoints<dim> &points,
            const MovingGeometryParameters &parameters);

  /** u_n and F_n at a point. */
  struct Deformation
  {
    dealii::Tensor<1, dim> displacement; //!< [L]
    dealii::Tensor<2, dim> gradient;     //!< F_n
  };

  /** The fit: u_n at the owned unknowns [L]. */
  const Vector &displacement() const
  {
    return fitted;
  }

  /** The same at points [L]. */
  const PointEvaluator<dim> &displacement_field() const
  {
    return displacements;
  }

  /** By the fit. */
  Deformation deformation(const PointInCell<dim> &point) const;

  /** X = x - u_n. */
  dealii::Point<dim> reference_position(const PointInCell<dim> &point) const;

  /**
   * The histories at points of deformable bodies.
   *
   * @throws UserError where det F_n is not positive
   */
  std::vector<PointHistory<dim>> histories(const std::vector<PointInCell<dim>> &points) const;

  /** The history of an own material point, whose internal variables are known there. */
  PointHistory<dim> history_of_material_point(const std::size_t point) const;

  /** What an own material point carries itself, F too. */
  PointHistory<dim> carried_history(const std::size_t point) const;

  /** The own material points. */
  const MaterialPoints<dim> &points() const
  {
    return own_points;
  }

  /** Where they are in their cells. */
  const std::vector<PointInCell<dim>> &material_points() const
  {
    return locations;
  }

  /** What the moving least squares met since the start of the step, on this process. */
  const MovingLeastSquaresReport &transfer_report() const
  {
    return report;
  }

  /**
   * Entries of MaterialPoints::internal: six of the internal tensor, alpha, six of the deviator of
   * the elastic strain (of ln b_e at finite strain).
   */
  static constexpr unsigned int n_internal     = 13;
  static constexpr unsigned int index_of_alpha = 6;
  /** Whether some law needs them. */
  static bool needs_internal(const std::vector<Body<dim>> &bodies);

  /** Whether F_n is that of the material points, not of the displacement since the start. */
  bool gradients_are_of_cloud() const
  {
    return parameters.deformation == DeformationTransfer::moving_least_squares;
  }

private:
  void require_admissible(const PointInCell<dim> &point, const dealii::Tensor<2, dim> &F) const;
  PointWeights weights(const std::vector<PointInCell<dim>> &targets) const;
  /** F_n; `of_cloud` are the weights of these points, empty if F_n is not from the cloud. */
  std::vector<dealii::Tensor<2, dim>>
  deformation_gradients(const std::vector<PointInCell<dim>> &points,
                        const std::optional<PointWeights>   &of_cloud) const;
  /** Projects the volume changes of F_n in the cells of bodies that may flow, as Bulk does. */
  void find_volume_changes(const CutQuadrature<dim> &quadrature);
  /** The F_n that the law of such a body sees. */
  dealii::Tensor<2, dim> projected_gradient(const PointInCell<dim>       &point,
                                            const dealii::Tensor<2, dim> &F) const;
  /** Takes the n_internal numbers into the history of a point whose F_n is known. */
  void set_internal(const PointInCell<dim> &point, const double *internal,
                    PointHistory<dim> &history) const;

  const DisplacementSpace<dim>   &space;
  const std::vector<Body<dim>>   &bodies;
  const MaterialPoints<dim>      &own_points;
  const MovingGeometryParameters &parameters;
  std::vector<PointInCell<dim>>   locations;
  Vector                          fitted;        //!< u_n at the owned unknowns
  PointEvaluator<dim>             displacements; //!< u_n
  MaterialPoints<dim>             cloud;         //!< own points and neighbours
  /** From the cloud, if something needs it. */
  std::optional<MovingLeastSquares<dim>> moving_least_squares;
  struct ProjectedVolumeChange
  {
    VolumeModes<dim>                            modes;
    std::array<double, VolumeModes<dim>::n_max> values;
  };
  std::vector<ProjectedVolumeChange> volume_changes;
  std::vector<int>                   change_of_cell; //!< of each owned cell, -1: none
  mutable MovingLeastSquaresReport   report;
};

/** Internal tensor, alpha and elastic strain as MaterialPoints::internal holds them. */
template <int dim>
void store_internal(const IncrementLaw<dim> &law, const PointHistory<dim> &history,
                    double *internal);

/** Leaves alpha alone of what store_internal() put there: the point is undeformed. */
void keep_hardening(double *internal);
} // namespace scree
