#pragma once

#include <scree/geometry/label_image.h>
#include <scree/geometry/shape.h>

#include <string>

namespace scree
{
/** Where an image lies, and how its steps of pixels become smooth outlines. */
struct LabelPlacement
{
  dealii::Point<2> lower_corner;   //!< of the image [L]
  double           pixel_size;     //!< [L]
  unsigned int     smoothing = 4;  //!< passes of distance_from_labels()
  double           gap       = 0.; //!< between labels that touch: each loses half of it [L]

  /** The centre of a pixel. */
  dealii::Point<2> centre(const LabelImage::Pixel &pixel) const;
};

/**
 * A piece of a label as a smooth signed distance that keeps its area, distance_from_labels(),
 * shrunk by half the gap. Where the smoothing would cut a neck there is less of it.
 *
 * @param where for messages
 * @throws UserError if the gap leaves nothing, or several pieces, of the label
 */
ShapePointer<2> shape_of_label(const LabelImage &image, const LabelPiece &piece,
                               const LabelPlacement &placement, const std::string &where);
} // namespace scree
