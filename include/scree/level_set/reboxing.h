#pragma once

#include <scree/level_set/lattice.h>

namespace scree
{
/** The nodes of a box, from an even node to an even node. */
template <int dim>
struct NodeBox
{
  typename Lattice<dim>::Index lower, n_nodes;
};

/** The smallest such box around two corners; corners that are even nodes up to rounding stay so. */
template <int dim>
NodeBox<dim> node_box(const LatticeFrame<dim> &frame, const dealii::Point<dim> &lower,
                      const dealii::Point<dim> &upper);

/** Such a box around nodes, with `margin` (length) and a spacing around them. */
template <int dim>
NodeBox<dim> node_box_around(const LatticeFrame<dim> &frame, const NodeBox<dim> &nodes,
                             double margin);

/**
 * The box of the negative nodes of a lattice, of which there must be one, with `margin` (length)
 * and a spacing around it, for the contour is up to one spacing beyond the negative nodes.
 */
template <int dim>
NodeBox<dim> node_box_of_body(const Lattice<dim> &lattice, double margin);

/**
 * The same for a body that `box` clips: nodes beyond it do not count, and where negative nodes
 * reach a face of it the lattice keeps its end.
 */
template <int dim>
NodeBox<dim> node_box_of_body(const Lattice<dim> &lattice, double margin,
                              const dealii::BoundingBox<dim> &box);

/**
 * A dense lattice on another box. Nodes of both keep their values. The others take the distance to
 * the closest point that a search finds on the contour of the cubic interpolant, with the sign of
 * the nearest old node; without one the value that the lattice has beyond its box.
 */
template <int dim>
Lattice<dim> reboxed(const Lattice<dim> &lattice, const NodeBox<dim> &box);

/**
 * Lets a dense lattice follow its body: once the contour is nearer than `margin` (length) to an
 * end, or farther from an end than twice that and 4 spacings, the lattice gets the box of the body
 * with 1.5 margins. The box may leave that of the frame. Returns whether it did.
 */
template <int dim>
bool follow_body(Lattice<dim> &lattice, double margin);

/** The same for a body that `box` clips, see node_box_of_body(). */
template <int dim>
bool follow_body(Lattice<dim> &lattice, double margin, const dealii::BoundingBox<dim> &box);
} // namespace scree
