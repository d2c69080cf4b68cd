#pragma once

#include <scree/discretization/cut_quadrature.h>
#include <scree/discretization/ghost_penalty.h>
#include <scree/mechanics/answered_increment.h>
#include <scree/mechanics/step_start.h>
#include <scree/mechanics/volume_projection.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <array>
#include <vector>

namespace scree
{
/** Displacement, its gradient and what follows from them at a point of a body. */
template <int dim>
struct BulkSample
{
  dealii::Tensor<1, dim>          displacement;
  dealii::SymmetricTensor<2, dim> strain;
  dealii::SymmetricTensor<2, dim> stress;
  double                          out_of_plane_stress = 0.; //!< sigma_zz of plane strain, 2D only
};

/**
 * The bulk on cut cells: int sigma(u) : grad v over the physical part, plus the ghost penalty
 * gamma (2 mu + min(lambda, 4 mu)) rho s_h(u, v) (theory.md section 6), rho the squared
 * secant ratio of plastic flow, at least 1e-3. The volume change that the materials see is
 * projected on VolumeModes of each cell.
 *
 * On a fixed geometry it is linear elastic in the total displacement u. On a moving one u is the
 * increment since the start of the step and the laws in increments give int P(F_D) : grad v over
 * Omega_n, which is no matrix but forces and a tangent at u; forces per volume then are those per
 * reference volume.
 */
template <int dim>
class Bulk
{
public:
  using Vector = dealii::TrilinosWrappers::MPI::Vector;

  /** @param start of a step on a moving geometry; null: the geometry is fixed */
  Bulk(const Fields<dim> &fields, const CutQuadrature<dim> &quadrature,
       const std::vector<Body<dim>> &bodies, const double ghost_penalty_factor,
       const StepStart<dim> *start = nullptr);

  /** Adds what is linear: the ghost penalty and, on a fixed geometry, the stiffness; hanging nodes
   * are condensed. */
  void add_to_matrix(dealii::TrilinosWrappers::SparseMatrix &matrix);

  /** Adds int b . v at time `time`, over the body up to its boundary: see strip_widths. */
  void add_body_forces(Vector &loads, const double time) const;

  /** Adds int P : grad v at the increment u; nothing on a fixed geometry. */
  void add_internal_forces(const PointEvaluator<dim> &u, Vector &forces) const;

  /** Adds its derivative. */
  void add_tangent(const PointEvaluator<dim>              &u,
                   dealii::TrilinosWrappers::SparseMatrix &matrix) const;

  /** What the laws did with the increment u, over all bodies and processes [force L]. */
  struct Work
  {
    double energy      = 0.; //!< stored
    double dissipation = 0.; //!< plastic, in this step
  };
  Work work(const PointEvaluator<dim> &u) const;

  /** The start of the step, null on a fixed geometry. */
  const StepStart<dim> *step_start() const
  {
    return start;
  }

  /**
   * The projected divergence of the displacement at a point: its coefficients of the unknowns of
   * the cell, component by component of node after node. False, and nothing, if the body's is not
   * projected.
   */
  bool projected_divergence(const unsigned int active_cell, const dealii::Point<dim> &unit_point,
                            std::vector<double> &coefficients) const;
  /** Its value for u; only where it is projected. */
  double projected_divergence(const PointInCell<dim> &point, const PointEvaluator<dim> &u) const;

  /** The part of a deformable body's lambda that acts on it [force/area]. */
  double projected_lambda(const unsigned int body) const;

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

  /** Secant over elastic shear modulus at the start of the step, in an active cell. */
  double secant_ratio(const unsigned int active_cell) const
  {
    return secant_ratios[active_cell];
  }

  /** The smallest of the cells around each owned node, at its first unknown. */
  Vector nodal_secant_ratios() const;

  /** Which nodes couple, cell by cell and ghost face by ghost face. */
  std::vector<std::vector<DofIndex>> couplings() const;

  /** Energy of the ghost penalty, summed over the processes. */
  double ghost_energy(const PointEvaluator<dim> &u);

  /** Volume of each body by the cut quadrature, summed over the processes. */
  std::vector<double> volumes() const;

  /** int of the basis functions: lumped volume of each owned unknown's node, for artificial mass.
   */
  void add_lumped_volumes(Vector &volumes, const std::vector<double> &factor_of_body) const;

  /** Values at a point in unit coordinates of an active cell. */
  BulkSample<dim> sample(const unsigned int active_cell, const dealii::Point<dim> &unit_point,
                         const PointEvaluator<dim> &u) const;

private:
  /** Points and weights of an owned active cell. */
  struct CellRule
  {
    const dealii::Point<dim> *points;
    const double             *weights;
    unsigned int              n_points;
    double                    weight_scale;
  };
  CellRule rule(const unsigned int active_cell) const;

  /** @throws UserError where it is not finite */
  dealii::Tensor<1, dim> body_force(const unsigned int        active_cell,
                                    const dealii::Point<dim> &unit_point, const double time) const;

  // Moving geometry, bulk_increment.cc.
  void set_up_increments();
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
  struct CellIncrement;
  void            ask(const unsigned int active_cell, CellIncrement &cell) const;
  BulkSample<dim> increment_sample(const PointInCell<dim>    &point,
                                   const PointEvaluator<dim> &u) const;
  CellVolume      cell_volume(const unsigned int active_cell, const PointEvaluator<dim> &u) const;
  double          linear_strain_energy(const PointEvaluator<dim> &u) const;
  /** Unit gradients of the basis at the points of a cell. */
  const double *unit_gradients(const unsigned int active_cell) const
  {
    return fields.cells()[active_cell].is_cut ? &cut_gradients[first_gradient[active_cell]]
                                              : whole_gradients.data();
  }

  void cell_stiffness(const unsigned int active_cell, dealii::FullMatrix<double> &matrix) const;

  /** F_D with unit gradients of the basis at a point. */
  dealii::Tensor<2, dim> increment(const unsigned int active_cell, const double *gradients,
                                   const PointEvaluator<dim> &u) const
  {
    return u.gradient(active_cell, gradients)
           + dealii::Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>());
  }

  // Projected volume changes, bulk_volume.cc.
  void set_up_volume_rows();
  /** Of a cell, and the factor of these rows. */
  std::pair<const double *, double> volume_rows_of(const unsigned int active_cell) const;
  /** Adds lambda int (projected div u) (projected div v). */
  void add_projected_stiffness(const unsigned int active_cell, const double lambda,
                               dealii::FullMatrix<double> &matrix) const;
  void set_up_increment_modes();
  /** Of the face, instead of gamma (2 mu + lambda). */
  double ghost_stiffness(const GhostFace &face) const;
  void   find_secant_ratios();
  /** Replaces the increments of a cell by projected ones. */
  void project(CellIncrement &cell) const;
  /** Turns the law's answers to projected increments into derivatives by the increments. */
  void pull_back(CellIncrement &cell) const;
  void add_volume_couplings(const unsigned int          active_cell,
                            dealii::FullMatrix<double> &block) const;

  const Fields<dim>            &fields;
  const CutQuadrature<dim>     &quadrature;
  const std::vector<Body<dim>> &bodies;
  const double                  gamma;
  GhostPenalty<dim>             ghost_penalty;

  const StepStart<dim>       *start;
  std::vector<IncrementStart> starts;          //!< at all points, cell after cell
  std::vector<double>         volume_ratios;   //!< J_n at all points
  std::vector<std::size_t>    first_point;     //!< of each owned cell
  std::vector<double>         cut_gradients;   //!< of the basis at points of cut cells
  std::vector<std::size_t>    first_gradient;  //!< of each owned cell
  std::vector<double>         whole_gradients; //!< of the basis for unit edge
  mutable Answers             last;            //!< to the last increment

  /** int f_j div u of cut active cells, as far as projected on the functions of VolumeModes. */
  std::vector<double>           volume_rows;
  std::vector<std::size_t>      first_row;         //!< of each active cell
  std::vector<double>           whole_volume_rows; //!< of whole cells of unit edge
  std::vector<double>           projected_shares;  //!< of bodies
  std::vector<VolumeModes<dim>> modes;             //!< of owned cells on a moving geometry
  std::vector<double>           mode_values;       //!< n_max at each point
  std::vector<double>           secant_ratios;     //!< of active cells
};
} // namespace scree
