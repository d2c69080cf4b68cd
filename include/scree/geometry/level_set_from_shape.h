#pragma once

#include <scree/geometry/shape.h>
#include <scree/level_set/lattice.h>

#include <memory>
#include <optional>
#include <string>

namespace scree
{
/** A level set that moves as a whole has at most as many nodes (128 MB). */
constexpr double largest_dense_lattice = 1 << 24;

/** Up to as many nodes (1 MB), all of them cost little. */
constexpr double largest_cheap_lattice = 1 << 17;

/**
 * The signed distance of `shape` on a lattice that covers its bounding box, clipped by the frame's
 * box, and `margin` (at least 6 spacings) around it. Beyond the frame's box the values are those
 * of the unclipped shape. Shapes that are not distances are turned into distances by fast marching
 * on the lattice, which is dense; a distance of more than `most_nodes` nodes is evaluated where the
 * lattice is asked. Parts of the box far from negative nodes are left out. The first and the last
 * node have even indices. Throws UserError, told as coming from the section `where`, if no node is
 * inside the shape (it is outside the frame's box, or thinner than a spacing) or a value is no
 * finite number.
 */
template <int dim>
Lattice<dim> make_lattice(const std::shared_ptr<const Shape<dim>> &shape,
                          const LatticeFrame<dim> &frame, double margin,
                          const std::string &where      = "Shape",
                          double             most_nodes = largest_dense_lattice);

/** The same, or nothing if no node is inside the shape. */
template <int dim>
std::optional<Lattice<dim>>
find_lattice(const std::shared_ptr<const Shape<dim>> &shape, const LatticeFrame<dim> &frame,
             double margin, const std::string &where, double most_nodes = largest_dense_lattice);

/**
 * The radius of the largest ball in the shape [L], half the thickness of a thin one: the largest
 * -phi, by a search from the deepest nodes of its lattice.
 */
template <int dim>
double inscribed_radius(const Shape<dim> &shape, const Lattice<dim> &lattice);
} // namespace scree
