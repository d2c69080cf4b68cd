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
 * vertices (theory.md section 5, box faces and supports). On a moving geometry the unknowns are
 * increments, the formulas see the reference positions, and neither motions normal to a face nor
 * those of vertices are possible, since box and grid stay.
 */
template <int dim>
class StrongSupports
{
public:
  using Vector = dealii::TrilinosWrappers::MPI::Vector;

  /**
   * @param start of the step on a moving geometry; null: the geometry is fixed
   * @throws UserError if a condition selects nothing or two conditions contradict each other
   */
  StrongSupports(const Fields<dim> &fields, const std::vector<Body<dim>> &bodies,
                 const StepStart<dim> *start = nullptr);

  /** Body and condition of each support. */
  const std::vector<std::pair<unsigned int, const BoundaryCondition<dim> *>> &conditions() const
  {
    return supports;
  }

  const std::vector<PrescribedUnknown<dim>> &unknowns() const
  {
    return prescribed;
  }

  /**
   * Sets the prescribed values of time `time` in u; on a moving geometry those since `start_time`.
   * @throws UserError for motions that are not possible there
   */
  void set(Vector &u, const double time, const double start_time) const;

  /** Zeros the prescribed entries. */
  void set_zero(Vector &r) const;

  /** Sum of the entries of `forces` per condition, with moments, over all processes. */
  std::vector<Resultant<dim>> resultants(const Vector &forces) const;

private:
  double increment(const PrescribedUnknown<dim> &unknown, const double time,
                   const double start_time) const;
  /** Of a support, on this process, then on all; counts. */
  struct Selection
  {
    double n_nodes = 0., n_contradictions = 0.;
  };
  /** Adds what a support prescribes in a cell of its body; the first support of an unknown counts.
   */
  void select(const Fields<dim> &fields, const unsigned int a, const unsigned int support,
              Selection &selection, std::map<DofIndex, PrescribedUnknown<dim>> &found) const;
  void require_selections(const std::vector<Body<dim>> &bodies,
                          std::vector<Selection>       &selections) const;
  bool is_prescribed_at(const BoundaryCondition<dim> &condition, const GridCell<dim> &cell,
                        const dealii::Point<dim> &unit_node,
                        const dealii::Point<dim> &position) const;

  const StepStart<dim>                                                *start;
  MPI_Comm                                                             communicator;
  std::vector<std::pair<unsigned int, const BoundaryCondition<dim> *>> supports;
  std::vector<PrescribedUnknown<dim>>                                  prescribed;
};
} // namespace scree
