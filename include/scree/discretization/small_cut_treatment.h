#pragma once

#include <scree/discretization/point_evaluator.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <memory>
#include <vector>

namespace scree
{
/** Stiffness of the bodies, to which a treatment of their small cuts is in proportion. */
struct CutStiffness
{
  std::vector<double> of_bodies; //!< [force/area]; of rigid ones any
  std::vector<double> ratios;    //!< of active cells: what is left where the material flows
};

/**
 * What keeps cells of which a body fills hardly anything from spoiling the equations: without it
 * condition numbers grow without bound. Chosen once, where the discrete problem is made.
 */
template <int dim>
class SmallCutTreatment
{
public:
  using Matrix = dealii::TrilinosWrappers::SparseMatrix;
  using Vector = dealii::TrilinosWrappers::MPI::Vector;

  virtual ~SmallCutTreatment() = default;

  /** The first unknowns of nodes that it couples, beyond those of each cell. */
  virtual std::vector<std::vector<DofIndex>> couplings() const = 0;

  /** Adds its matrix; hanging nodes are condensed. */
  virtual void add_to_matrix(const CutStiffness &stiffness, Matrix &matrix) const = 0;

  /**
   * Adds the forces of what earlier steps left in it, as seen in the present frame.
   *
   * @param start u_n, which brought the bodies to where they are
   */
  virtual void add_start_forces(const CutStiffness &stiffness, const PointEvaluator<dim> &start,
                                Vector &forces) const = 0;

  /** Energy stored in it on this process with the increment u [force L]. */
  virtual double energy(const CutStiffness &stiffness, const PointEvaluator<dim> &start,
                        const PointEvaluator<dim> &u) const = 0;
};

/** None: for cells that are not cut small, and to see what the others do. */
template <int dim>
class NoSmallCutTreatment : public SmallCutTreatment<dim>
{
public:
  using typename SmallCutTreatment<dim>::Matrix;
  using typename SmallCutTreatment<dim>::Vector;

  std::vector<std::vector<DofIndex>> couplings() const override;
  void   add_to_matrix(const CutStiffness &stiffness, Matrix &matrix) const override;
  void   add_start_forces(const CutStiffness &stiffness, const PointEvaluator<dim> &start,
                          Vector &forces) const override;
  double energy(const CutStiffness &stiffness, const PointEvaluator<dim> &start,
                const PointEvaluator<dim> &u) const override;
};

/** A GhostPenalty; none if its factor is zero. */
template <int dim>
std::unique_ptr<const SmallCutTreatment<dim>>
make_small_cut_treatment(const DisplacementSpace<dim> &space, const double ghost_penalty_factor);
} // namespace scree
