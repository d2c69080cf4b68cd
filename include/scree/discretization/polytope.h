#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <optional>
#include <utility>
#include <vector>

namespace scree
{
/** The plane n.x + offset = 0 in unit coordinates of a cell, |n| = 1. */
template <int dim>
struct CellPlane
{
  dealii::Tensor<1, dim> normal;
  double                 offset;

  double distance(const dealii::Point<dim> &x) const
  {
    return normal * x + offset;
  }
};

/** A facet of a convex polytope: an edge (2D), or a convex polygon with its vertices in order. */
template <int dim>
struct Facet
{
  std::vector<dealii::Point<dim>> vertices;
  int                             face  = -1; //!< of the unit cell, -1: inside the cell
  int                             plane = -1; //!< that contains it, -1: none
  dealii::Tensor<1, dim>          normal;     //!< out of the body if it is surface, else zero

  bool is_surface() const
  {
    return normal.norm_square() > 0.;
  }
};

/**
 * A convex part of the unit cell. Distances below `tolerance` count as none: vertices that near to
 * a plane lie on it, so that planes on grid lines leave no slivers.
 */
template <int dim>
class Polytope
{
public:
  static constexpr double tolerance = 1e-10;

  /** The whole cell. */
  static Polytope unit_cell();

  /** Whether it is the whole cell. */
  bool is_unit_cell() const;

  /**
   * The parts with negative and with positive distance; an empty one where the plane only touches:
   * then a facet on the plane is told as `plane`.
   */
  std::pair<std::optional<Polytope>, std::optional<Polytope>> split(const CellPlane<dim> &plane,
                                                                    const int number) const;

  /** A point inside: the mean of the vertices. */
  dealii::Point<dim> middle() const;

  /** Its bounds if it is a box along the axes. */
  std::optional<std::pair<dealii::Point<dim>, dealii::Point<dim>>> as_box() const;

  /** Simplices of positive volume that fill it: dim + 1 vertices each. */
  std::vector<std::vector<dealii::Point<dim>>> simplices() const;

  /** 1 of the unit cell. */
  double volume() const;

  std::vector<Facet<dim>> facets;
};

/** Simplices of dim vertices that fill a facet. */
template <int dim>
std::vector<std::vector<dealii::Point<dim>>> simplices_of(const Facet<dim> &facet);
} // namespace scree
