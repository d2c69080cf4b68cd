#pragma once

#include <scree/discretization/cut_quadrature.h>
#include <scree/discretization/small_cut_treatment.h>
#include <scree/mechanics/cell_rule.h>
#include <scree/mechanics/mass_points.h>
#include <scree/mechanics/projected_divergence.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <vector>

namespace scree
{
/** Displacement, its gradient and what follows from them at a point of a body. */
template <int dim>
struct BulkSample
{
  dealii::Tensor<1, dim>          displacement;
  dealii::SymmetricTensor<2, dim> strain; //!< small or logarithmic, as Bulk::sample() says
  dealii::SymmetricTensor<2, dim> stress;
  double                          out_of_plane_stress = 0.; //!< sigma_zz of plane strain, 2D only
  double                          plastic_strain      = 0.; //!< equivalent, since the start
  double                          energy_density      = 0.; //!< stored, per initial volume [F/L^2]
  double                          volume_ratio        = 1.; //!< of present to initial volume
};

/** The stress of a body integrated over where it is. */
template <int dim>
struct StressIntegral
{
  double                          volume       = 0.; //!< of the body in the equations [L^dim]
  double                          moved_volume = 0.; //!< where the displacement brings it [L^dim]
  dealii::SymmetricTensor<2, dim> stress;            //!< int sigma [force L]
};

/**
 * The bulk on cut cells: int sigma : grad v over the physical part, of the kind that a Kinematics
 * needs, plus the treatment of small cuts for the stiffness (2 mu + min(lambda, 4 mu)) rho, rho the
 * squared secant ratio of plastic flow, at least 1e-3 (theory.md section 6). The volume change that
 * the materials see is projected on VolumeModes of each cell.
 */
template <int dim>
class Bulk
{
public:
  using Vector = dealii::TrilinosWrappers::MPI::Vector;
  using Matrix = dealii::TrilinosWrappers::SparseMatrix;

  /** @param projected_shares of bodies, of a volume change that is replaced by its projection */
  Bulk(const DisplacementSpace<dim> &space, const CutQuadrature<dim> &quadrature,
       const std::vector<Body<dim>> &bodies, const SmallCutTreatment<dim> &small_cuts,
       const std::vector<double> &projected_shares);

  virtual ~Bulk() = default;

  /** Adds what is linear in u, here the treatment of small cuts; hanging nodes are condensed. */
  virtual void add_to_matrix(Matrix &matrix) const;

  /** Whether add_to_matrix() has all of it. */
  virtual bool is_linear() const = 0;

  /** Adds the forces at u of what is not linear; none unless overridden. */
  virtual void add_internal_forces(const PointEvaluator<dim> &u, Vector &forces) const;

  /** Adds their derivative. */
  virtual void add_tangent(const PointEvaluator<dim> &u, Matrix &matrix) const;

  /** What the laws did with u, over all bodies and processes [force L]. */
  struct Work
  {
    double energy      = 0.; //!< stored
    double dissipation = 0.; //!< plastic, in this step
  };
  virtual Work work(const PointEvaluator<dim> &u) const = 0;

  /** Values at a point in unit coordinates of an active cell. */
  virtual BulkSample<dim> sample(const unsigned int         active_cell,
                                 const dealii::Point<dim>  &unit_point,
                                 const PointEvaluator<dim> &u) const = 0;

  /** Of each body, on this process: here of sample(), volumes for small strain. */
  virtual std::vector<StressIntegral<dim>> stress_integrals(const PointEvaluator<dim> &u) const;

  /** Adds int b . v at time `time`, b per volume at the start of the run, over the body up to its
   * boundary: see strip_widths. */
  void add_body_forces(Vector &loads, const double time) const;

  /** The same of their weight. */
  void add_weight(Vector &loads, const double time) const;

  /** The mass of the bodies up to their boundaries, at the points of body forces. */
  MassPoints<dim> mass_points() const;

  /** Whether the volume change of a body is projected. */
  bool is_projected(const unsigned int body) const
  {
    return projected_shares[body] > 0.;
  }

  /** The projected div u of the bodies for which it is. */
  const ProjectedDivergence<dim> &projected_divergence() const
  {
    return divergence;
  }

  /** The part of a deformable body's lambda that acts on it [force/area]. */
  double projected_lambda(const unsigned int body) const;

  /** Secant over elastic shear modulus at the start of the step, in an active cell. */
  double secant_ratio(const unsigned int active_cell) const
  {
    return secant_ratios[active_cell];
  }

  /** The smallest of the cells around each owned node, at its first unknown. */
  Vector nodal_secant_ratios() const;

  /** Which nodes couple: those of cells, and by the treatment of small cuts. */
  std::vector<std::vector<DofIndex>> couplings() const;

  /** SmallCutTreatment::add_start_forces(). */
  void add_start_forces(const PointEvaluator<dim> &start, Vector &forces) const;

  /** Energy of the treatment of small cuts after an increment u, over all processes. */
  double energy_of_small_cuts(const PointEvaluator<dim> &start, const PointEvaluator<dim> &u) const;

  /** Volume of each body by the cut quadrature, summed over the processes. */
  std::vector<double> volumes() const;

  /** int of the basis functions: lumped volume of each owned unknown's node, for artificial mass.
   */
  void add_lumped_volumes(Vector &volumes, const std::vector<double> &factor_of_body) const;

protected:
  /** Those of the cut quadrature unless overridden. */
  virtual CellRule<dim> rule(const unsigned int active_cell) const;

  /** Volumes at the start of the run of the points of an owned active cell [L^dim]; here those of
   * the rule. */
  virtual void set_reference_volumes(const unsigned int   active_cell,
                                     std::vector<double> &volumes) const;

  const DisplacementSpace<dim>  &space;
  const CutQuadrature<dim>      &quadrature;
  const std::vector<Body<dim>>  &bodies;
  const std::vector<double>      projected_shares;
  const ProjectedDivergence<dim> divergence;
  std::vector<double>            secant_ratios; //!< of active cells; 1 unless set

private:
  /** Calls f(unit point, reference volume) for the points of an owned active cell and of the strip
   * between its cut and the body's boundary. */
  template <typename F>
  void for_each_volume(const unsigned int active_cell, const F &f) const;
  /** Adds int b . v of forces per reference volume b(active cell, unit point) of the bodies with
   * acts(body). */
  template <typename Acts, typename F>
  void add_volume_forces(const Acts &acts, const F &b, Vector &loads) const;
  /** @throws UserError where it is not finite */
  dealii::Tensor<1, dim> body_force(const unsigned int        active_cell,
                                    const dealii::Point<dim> &unit_point, const double time) const;
  CutStiffness           cut_stiffness() const;

  const SmallCutTreatment<dim> &small_cuts;
};
} // namespace scree
