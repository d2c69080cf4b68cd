#pragma once

#include <scree/level_set/lattice.h>

#include <limits>

namespace scree
{
/** When and how a level set is made a distance again. */
struct ReinitialisationOptions
{
  double       tolerance = 0.1; // of ||grad phi| - 1|, up to which values stay as they are
  unsigned int degree    = 3;   // of the interpolant whose contour is watched
  /**
   * Half width in spacings of the narrow band, at least 8: slopes are watched at nodes with |phi|
   * up to it and values are marched up to that distance; the others stay as they are. With
   * advection in a band the one of the extension, so that phi is renewed where its motion ended,
   * before the extension follows it. Infinite: all nodes.
   */
  double band = std::numeric_limits<double>::infinity();
};

/** What a reinitialisation found and did. */
struct ReinitialisationCount
{
  double      deviation_near; // largest ||grad phi| - 1| in the strip around the contour, before
  double      deviation_far;  // the same elsewhere
  std::size_t n_changed_near; // nodes in the strip that got a new value
  std::size_t n_changed_far;  // the same elsewhere
  double      contour_motion; // largest distance from the old to the new contour, length
};

/**
 * Makes a level set a signed distance where it is needed, without moving the contour.
 *
 * The strip holds the nodes of cut cells and two more around: the values on which the contours of
 * all interpolants depend. It stays as it is, to the last bit, as long as `||grad phi| - 1|`
 * (central differences) is within the tolerance in it; slopes within 2 nodes of a kink (see
 * ContourDistance) do not count. Else its nodes take the distance to the closest point of the cubic
 * interpolant, except near kinks, where phi is multiplied by the mean factor of the nodes around.
 *
 * Where slopes are beyond the tolerance, the other nodes are marched from the strip
 * (march_distances()); the new values come in over 6 nodes, from 8 to 2 steps away from such
 * places, and beyond 8 spacings from the contour everywhere. Marching everything instead makes the
 * medial axis sharp at every call, which raises the error of Zalesak's disc by a third.
 *
 * The contour of the cubic interpolant stays to fourth order. That of degree 1 cannot when a slope
 * that varies is removed: a factor f on phi moves the zero of a cut edge by up to h/4 times the
 * difference of log f between its ends. `contour_motion` says what happened, measured at the cuts
 * of edges.
 *
 * Throws ExcMessage without a contour.
 */
template <int dim>
ReinitialisationCount reinitialise(Lattice<dim> &lattice, const ReinitialisationOptions &options
                                                          = ReinitialisationOptions());
} // namespace scree
