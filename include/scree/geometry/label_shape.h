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
  unsigned int       smoothing = 4;  //!< passes of distance_from_labels()
  double             gap       = 0.; //!< between labels that touch: each loses half of it [L]

  /** The centre of a pixel. */
  dealii::Point<dim> centre(const typename LabelImage<dim>::Pixel &pixel) const;

  /** The area (2D) or volume of a piece. */
  double volume(const LabelPiece<dim> &piece) const;
};

/**
 * A piece of a label as a smooth signed distance that keeps its area (volume),
 * distance_from_labels(), shrunk by half the gap. Where the smoothing would cut a neck there is
 * less of it.
 *
 * @param where for messages
 * @throws UserError if the gap leaves nothing, or several pieces, of the label
 */
template <int dim>
ShapePointer<dim> shape_of_label(const LabelImage<dim> &image, const LabelPiece<dim> &piece,
                                 const LabelPlacement<dim> &placement, const std::string &where);
} // namespace scree
