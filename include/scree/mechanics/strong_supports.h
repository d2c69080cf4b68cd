#pragma once

#include <scree/mechanics/boundary_terms.h>

#include <map>
#include <vector>

namespace scree
{
/** An owned unknown whose value is prescribed. */
template <int dim>
struct PrescribedUnknown
{
  DofIndex           index;
  unsigned int       component;
  unsigned int       support; //!< index in StrongSupports::conditions()
  unsigned int       value;   //!< which value of the condition
  dealii::Point<dim> position;
  dealii::Point<dim> reference_position; //!< where formulas are evaluated
};

/**
 * Displacements imposed on unknowns: of the nodes on a face of the background box, and of single
 * vertices (theory.md section 5, box faces and supports). The formulas see the reference positions
 * of the kinematics, which knows what of a prescribed displacement is u.
 */
template <int dim>
class StrongSupports
{
public:
  using Vector = dealii::TrilinosWrappers::MPI::Vector;

  /** @throws UserError if a condition selects nothing or two conditions contradict each other */
  StrongSupports(const DisplacementSpace<dim> &space, const std::vector<Body<dim>> &bodies,
                 const Kinematics<dim> &kinematics);

  /** Body and condition of each support. */
  const std::vector<std::pair<unsigned int, const BoundaryCondition<dim> *>> &conditions() const
  {
    return supports;
  }

  const std::vector<PrescribedUnknown<dim>> &unknowns() const
  {
    return prescribed;
  }

  /** Sets the prescribed values of time `time` in u, see Kinematics::prescribed(). */
  void set(Vector &u, const double time) const;

  /** Zeros the prescribed entries. */
  void set_zero(Vector &r) const;

  /** Sum of the entries of `forces` per condition, with moments, over all processes. */
  std::vector<Resultant<dim>> resultants(const Vector &forces) const;

private:
  /** Of a support, on this process, then on all; counts. */
  struct Selection
  {
    double n_nodes = 0., n_contradictions = 0.;
  };
  /** Adds what a support prescribes in a cell of its body; the first support of an unknown counts.
   */
  void select(const DisplacementSpace<dim> &space, const unsigned int a, const unsigned int support,
              Selection &selection, std::map<DofIndex, PrescribedUnknown<dim>> &found) const;
  void require_selections(const std::vector<Body<dim>> &bodies,
                          std::vector<Selection>       &selections) const;
  bool is_prescribed_at(const BoundaryCondition<dim> &condition, const GridCell<dim> &cell,
                        const dealii::Point<dim> &unit_node,
                        const dealii::Point<dim> &position) const;

  const Kinematics<dim>                                               &kinematics;
  MPI_Comm                                                             communicator;
  std::vector<std::pair<unsigned int, const BoundaryCondition<dim> *>> supports;
  std::vector<PrescribedUnknown<dim>>                                  prescribed;
};
} // namespace scree
