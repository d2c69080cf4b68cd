#pragma once

#include <scree/geometry/shape.h>
#include <scree/level_set/lattice.h>

#include <optional>
#include <string>

namespace scree
{
/**
 * The signed distance of `shape` on a lattice that covers its bounding box, clipped by the frame's
 * box, and `margin` (at least 6 spacings) around it. Beyond the frame's box the values are those
 * of the unclipped shape. Shapes that are not distances are turned into distances by fast marching
 * on the lattice. Parts of the box far from negative nodes are left out. The first and the last
 * node have even indices. Throws UserError, told as coming from the section `where`, if no node is
 * inside the shape (it is outside the frame's box, or thinner than a spacing) or a value is no
 * finite number.
 */
template <int dim>
Lattice<dim> make_lattice(const Shape<dim> &shape, const LatticeFrame<dim> &frame, double margin,
                          const std::string &where = "Shape");

/** The same, or nothing if no node is inside the shape. */
template <int dim>
std::optional<Lattice<dim>> find_lattice(const Shape<dim> &shape, const LatticeFrame<dim> &frame,
                                         double margin, const std::string &where = "Shape");

/**
 * The radius of the largest ball in the shape [L], half the thickness of a thin one: the largest
 * -phi, by a search from the deepest nodes of its lattice.
 */
template <int dim>
double inscribed_radius(const Shape<dim> &shape, const Lattice<dim> &lattice);
} // namespace scree
