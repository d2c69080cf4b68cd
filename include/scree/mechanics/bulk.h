#pragma once

#include <scree/discretization/cut_quadrature.h>
#include <scree/discretization/ghost_penalty.h>

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
  dealii::SymmetricTensor<2, dim> strain;
  dealii::SymmetricTensor<2, dim> stress;
  double                          out_of_plane_stress = 0.; //!< sigma_zz of plane strain, 2D only
};

/**
 * The elastic bulk on cut cells: int sigma(u) : grad v over the physical part, plus the ghost
 * penalty gamma (2 mu + lambda) s_h(u, v) (method.md section 7).
 */
template <int dim>
class Bulk
{
public:
  using Vector = dealii::TrilinosWrappers::MPI::Vector;

  Bulk(const Fields<dim> &fields, const CutQuadrature<dim> &quadrature,
       const std::vector<Body<dim>> &bodies, const double ghost_penalty_factor);

  /** Adds the stiffness matrix; hanging nodes are condensed. */
  void add_to_matrix(dealii::TrilinosWrappers::SparseMatrix &matrix);

  /** Adds int b . v at time `time`. */
  void add_body_forces(Vector &loads, const double time) const;

  /** Which nodes couple, cell by cell and ghost face by ghost face. */
  std::vector<std::vector<DofIndex>> couplings() const;

  /** Strain energy of each body for ghosted u, summed over the processes. */
  std::vector<double> strain_energy(const Vector &u) const;

  /** Energy of the ghost penalty, summed over the processes. */
  double ghost_energy(const Vector &u);

  /** Volume of each body by the cut quadrature, summed over the processes. */
  std::vector<double> volumes() const;

  /** int of the basis functions: lumped volume of each owned unknown's node, for artificial mass.
   */
  void add_lumped_volumes(Vector &volumes, const std::vector<double> &factor_of_body) const;

  /** Values at a point in unit coordinates of an active cell. */
  BulkSample<dim> sample(const unsigned int active_cell, const dealii::Point<dim> &unit_point,
                         const Vector &u) const;

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
  void     cell_stiffness(const unsigned int active_cell, dealii::FullMatrix<double> &matrix) const;

  const Fields<dim>            &fields;
  const CutQuadrature<dim>     &quadrature;
  const std::vector<Body<dim>> &bodies;
  const double                  gamma;
  GhostPenalty<dim>             ghost_penalty;
};
} // namespace scree
