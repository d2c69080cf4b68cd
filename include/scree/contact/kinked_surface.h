#pragma once

#include <scree/contact/contact_surface.h>
#include <scree/contact/exact_distance.h>
#include <scree/discretization/cut_quadrature.h>

#include <vector>

namespace scree
{
/**
 * The contact surface in cells where a body has edges or corners. The interpolant of degree k of a
 * kinked distance moves the end of a face by up to a cell; here the cell is halved towards the
 * kinks, 8 times (2D) or 4 times (3D), with the exact distances in each part. The points of all
 * parts that lie in the same quadrant of the cell, have similar sizes and the same normals of both
 * bodies are joined, with the sum of their weights: to one point at the mean of their places, which
 * integrates linear functions, or for three Gauss points and more to 2 (dim - 1) points that have
 * their second moments along the surface.
 */
template <int dim>
class KinkedSurface
{
public:
  KinkedSurface(const ExactDistances<dim> &distances, const std::vector<Body<dim>> &bodies,
                const LevelSetNodes<dim> &level_set_nodes);

  /** Whether the cell needs it and the exact distances are known. */
  bool concerns(const ContactPair &pair, const GridCell<dim> &cell) const;

  /** The points in a cell. */
  std::vector<ContactPoint<dim>> points(const unsigned int number, const ContactPair &pair,
                                        const GridCell<dim> &cell);

private:
  /** A point of a part of the cell, or several of them joined. */
  struct Piece
  {
    dealii::Point<dim>              x;
    double                          weight;
    dealii::Tensor<1, dim>          n_a, n_b; //!< out of the bodies
    unsigned int                    group;    //!< by quadrant and size of the part
    dealii::SymmetricTensor<2, dim> square;   //!< mean of (x - mean x)^2 [L^2]
  };
  void divide(const ContactPair &pair, const GridCell<dim> &cell, const dealii::Point<dim> &lower,
              const unsigned int depth);

  /** The point of phi_a = phi_b next to x along a unit direction, at most `size` away, else x: in
   * the smallest parts the interpolant misses a face by a tenth of their size. */
  dealii::Point<dim> on_surface(const ContactPair &pair, const dealii::Point<dim> &x,
                                const dealii::Tensor<1, dim> &direction, const double size) const;

  std::vector<Piece> joined_pieces() const;
  /** The quadrature points of a joined piece, of the same weights. */
  std::vector<dealii::Point<dim>> places(const Piece &piece) const;

  const ExactDistances<dim>    &distances;
  const std::vector<Body<dim>> &bodies;
  CutCellRules<dim>             rules;
  std::vector<Piece>            pieces;
};
} // namespace scree
