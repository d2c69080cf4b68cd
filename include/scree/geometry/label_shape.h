#pragma once

#include <scree/geometry/label_image.h>
#include <scree/geometry/shape.h>

#include <string>

namespace scree
{
/** Where an image lies, and how its steps of pixels become smooth outlines. */
template <int dim>
struct LabelPlacement
{
  dealii::Point<dim> lower_corner;   //!< of the image [L]
  double             pixel_size;     //!< [L]
  int                smoothing = -1; //!< passes of distance_from_labels(); -1: see shape_of_label()
  double             gap       = 0.; //!< between labels that touch: each loses half of it [L]

  /** The centre of a pixel. */
  dealii::Point<dim> centre(const typename LabelImage<dim>::Pixel &pixel) const;

  /** The area (2D) or volume of a piece. */
  double volume(const LabelPiece<dim> &piece) const;
};

/**
 * A piece of a label as a smooth signed distance that keeps its area (volume), shrunk by half the
 * gap: distance_from_labels() with the passes that are set, or fewer where they would cut a neck.
 *
 * By default there are 4 passes, but 2.5 (R - 3) unbiased ones of a piece without corners, R the
 * radius in pixels of the disc (ball) of its volume: where a round outline lies along rows of
 * pixels its steps are sqrt(2 R) pixels wide, and the kernel, of deviation sqrt(n/2), is up to 0.8
 * times that. A piece has no corners if these move its outline by a quarter of a pixel at most from
 * that of 4 passes.
 *
 * @param where for messages
 * @throws UserError if the gap leaves nothing, or several pieces, of the label
 */
template <int dim>
ShapePointer<dim> shape_of_label(const LabelImage<dim> &image, const LabelPiece<dim> &piece,
                                 const LabelPlacement<dim> &placement, const std::string &where);
} // namespace scree
