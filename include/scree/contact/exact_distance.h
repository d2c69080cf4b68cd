#pragma once

#include <scree/discretization/fields.h>

#include <deal.II/lac/trilinos_vector.h>

#include <optional>
#include <vector>

namespace scree
{
/**
 * The distances to the bodies from their shapes phi_0, where the lattices round edges and corners
 * by a part of a spacing: phi_0(X) of bodies that stay and of rigid ones, X the initial position of
 * x; of deformed bodies phi_0(X)/|grad phi_0(X)|, X = x - u_n(x), if some body has edges or
 * corners.
 */
template <int dim>
class ExactDistances
{
public:
  /**
   * Collective.
   *
   * @param start_displacement u_n of deformable bodies at the owned unknowns; null: zero, and
   * nothing is known of bodies on a moving geometry
   */
  ExactDistances(const Fields<dim> &fields, const std::vector<Body<dim>> &bodies,
                 const dealii::TrilinosWrappers::MPI::Vector *start_displacement);

  /** Whether the distance to the body is known near x: its shape tells distances there. */
  bool is_known(const unsigned int body, const dealii::Point<dim> &x) const;

  /** Whether it is a distance itself: the body has not been deformed. */
  bool is_exact(const unsigned int body) const
  {
    return !bodies[body].law;
  }

  /** The signed distance where it is known [L]. */
  double value(const unsigned int body, const dealii::Point<dim> &x) const;

  /** The unit normal out of the body. */
  dealii::Tensor<1, dim> normal(const unsigned int body, const dealii::Point<dim> &x) const;

  /** The point of the boundary next to x. */
  dealii::Point<dim> foot(const unsigned int body, const dealii::Point<dim> &x) const;

  /** Whether edges or corners of the body may lie in a box. */
  bool is_kinked(const unsigned int body, const dealii::BoundingBox<dim> &box) const;

private:
  /** Where a point of the body was at the start; nothing far from a deformed body. */
  std::optional<dealii::Point<dim>> initial_position(const unsigned int        body,
                                                     const dealii::Point<dim> &x) const;
  /** phi_0(X). */
  double                 level_set(const unsigned int body, const dealii::Point<dim> &x) const;
  dealii::Tensor<1, dim> gradient(const unsigned int body, const dealii::Point<dim> &x) const;

  const Fields<dim>                         &fields;
  const std::vector<Body<dim>>              &bodies;
  double                                     step; //!< of differences [L]
  std::vector<std::optional<RigidPose<dim>>> poses;
  std::vector<double>                        displacements; //!< u_n, see values_by_cell()
};
} // namespace scree
