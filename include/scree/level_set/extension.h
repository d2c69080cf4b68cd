#pragma once

#include <scree/level_set/lattice.h>

#include <limits>

namespace scree
{
/** How nodal values are continued off a body. */
enum class Extrapolation
{
  constant, // grad v . grad phi = 0
  linear    // values and gradients carried along
};

/** How far and how nodal values are continued. */
struct ExtensionOptions
{
  Extrapolation extrapolation = Extrapolation::linear;
  /**
   * Half width in spacings of the narrow band: nodes with larger |phi| keep their values. For
   * semi-Lagrangian advection in a band, that band plus 2 |du| and 2 spacings, as nodes that |du|
   * beyond it move and interpolate du |du| further. Infinite: all nodes.
   */
  double band = std::numeric_limits<double>::infinity();
  /**
   * Linear: G at a known node is that of the affine function that fits the known nodes up to so
   * many spacings away along the axes best (least squares); 0: differences. A jagged v, of which
   * finite element fields have a little in cut cells, is not continued with wild gradients then.
   */
  int fit = 0;
};

/** What an extension did. */
struct ExtensionCount
{
  std::size_t n_extended; // nodes that got values
  std::size_t n_upstream; // those of them that no node nearer to the contour leads to
};

/**
 * Continues nodal values from the `known` nodes (what is not zero is known) to all others, all
 * components in one pass over the nodes in the order of |phi|, which should be a distance.
 *
 * Constant: `sum_i g_i D_i v = 0` with the central differences g_i of |phi| and the one-sided
 * differences D_i towards smaller |phi|: second order where two nodes there have values, else first
 * order.
 *
 * Linear: the gradient G of v is continued as a constant and `sum_i g_i D_i (v - G x) = 0`, so that
 * affine fields are continued exactly whatever phi is. At known nodes G is the central difference
 * along an axis, at the end of what is known the one-sided one of second order (of first order
 * where only two nodes are known), or that of its neighbours across where it sticks out.
 *
 * Nodes without such neighbours (local minima of |phi|) take the mean of the neighbours with
 * values, after all others; nodes of the band that none of this reaches keep their values. Throws
 * ExcMessage if no node is known.
 *
 * @tparam n_components of v, e.g. dim
 * @param v  in: values at the known nodes; out: at the nodes of the band; one array per component,
 * in the order of the values of the lattice
 */
template <int dim, std::size_t n_components>
ExtensionCount extend(const Lattice<dim> &phi, const std::vector<char> &known,
                      const ExtensionOptions                        &options,
                      std::array<std::vector<double>, n_components> &v);
} // namespace scree
