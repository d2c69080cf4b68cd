#pragma once

#include <scree/mechanics/boundary_regions.h>
#include <scree/mechanics/resultant.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <memory>
#include <vector>

namespace scree
{
/** What boundary terms refer to. */
template <int dim>
struct BoundarySetting
{
  const DisplacementSpace<dim>           &space;
  const std::vector<Body<dim>>           &bodies;
  const Kinematics<dim>                  &kinematics;
  const std::vector<BoundaryRegion<dim>> &regions; //!< of all terms
};

/**
 * The part of the conditions of one Imposition in the equations: what is linear in u as a matrix
 * and loads, what is not as forces and their derivative.
 */
template <int dim>
class BoundaryTerm
{
public:
  using Vector = dealii::TrilinosWrappers::MPI::Vector;
  using Matrix = dealii::TrilinosWrappers::SparseMatrix;

  /** @param own_regions its indices of setting.regions */
  BoundaryTerm(const BoundarySetting<dim> &setting, const std::vector<unsigned int> &own_regions);

  virtual ~BoundaryTerm() = default;

  virtual void add_to_matrix(Matrix &matrix) const = 0;

  /** Adds the dead loads and what is prescribed, each if asked for. */
  virtual void add_loads(Vector &loads, const double time, const bool dead_loads,
                         const bool prescribed) const = 0;

  /** Whether add_to_matrix() has all of it; true unless overridden, with the next two. */
  virtual bool is_linear() const;

  /** Adds what is not linear; nothing unless overridden. */
  virtual void add_internal_forces(const PointEvaluator<dim> &u, const double time,
                                   Vector &forces) const;

  /** Adds its derivative. */
  virtual void add_tangent(const PointEvaluator<dim> &u, const double time, Matrix &matrix) const;

  /** Whether matrix and tangent are symmetric. */
  virtual bool is_symmetric() const;

  /** Unknowns that couple, beyond those of a cell. */
  virtual std::vector<std::vector<DofIndex>> couplings() const;

  /** Tractions on the body at the points of an own region; zero unless overridden. */
  virtual std::vector<dealii::Tensor<1, dim>>
  tractions(const unsigned int region, const PointEvaluator<dim> &u, const double time) const;

  /** Resultant of the multipliers of an own region that are owned. */
  virtual Resultant<dim> resultant_of_multipliers(const unsigned int         region,
                                                  const PointEvaluator<dim> &u) const;

  /** Stored energy on this process. */
  virtual double energy(const PointEvaluator<dim> &u, const double time) const;

protected:
  const BoundaryRegion<dim> &region(const unsigned int index) const
  {
    return setting.regions[index];
  }

  /** The displacement unknowns of the cell of a point. */
  std::vector<DofIndex> unknowns(const BoundaryPoint<dim> &point) const;
  void set_unknowns(const BoundaryPoint<dim> &point, std::vector<DofIndex> &unknowns) const;

  /**
   * Sets the derivative of the forces of a traction t(F_D) at a point by the unknowns of its cell,
   * w N_a dt_i/dF_D,kL N_b,L in row (a, i) and column (b, k).
   *
   * @param shape with gradients in physical coordinates
   */
  void set_tangent(const BoundaryPoint<dim> &point, const ShapeValues<dim> &shape,
                   const dealii::Tensor<3, dim> &by_increment,
                   dealii::FullMatrix<double>   &block) const;

  const BoundarySetting<dim>      setting;
  const DisplacementSpace<dim>   &space;
  const std::vector<unsigned int> own_regions;
};

/** The term of an imposition; null if it acts on unknowns only (StrongSupports). */
template <int dim>
std::unique_ptr<BoundaryTerm<dim>> make_boundary_term(const Imposition                 imposition,
                                                      const BoundarySetting<dim>      &setting,
                                                      const std::vector<unsigned int> &own_regions);
} // namespace scree
