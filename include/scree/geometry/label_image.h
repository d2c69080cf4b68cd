#pragma once

#include <deal.II/base/point.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace scree
{
/** An image whose pixels tell what they belong to: label 0 is what lies between the bodies. */
class LabelImage
{
public:
  using Label = std::uint32_t;
  using Pixel = std::array<int, 2>; //!< column from the left, row from below

  /**
   * Reads PNG (grey values of up to 16 bits or a palette, whose indices are the labels) or PGM (P2
   * and P5, 16 bits).
   *
   * @param bytes of the file
   * @param name  of the file, for messages
   * @throws UserError if it is damaged, of another kind, in colour, or has more than 2^26 pixels
   */
  static LabelImage read(const std::string &bytes, const std::string &name);

  /** @param labels row by row from above, as images have them */
  LabelImage(const std::array<int, 2> &n_pixels, std::vector<Label> labels);

  Label operator()(const Pixel &pixel) const
  {
    return labels[static_cast<std::size_t>(n[1] - 1 - pixel[1]) * n[0] + pixel[0]];
  }

  const std::array<int, 2> &n_pixels() const
  {
    return n;
  }

private:
  std::array<int, 2> n;
  std::vector<Label> labels;
};

/** Pixels of one label that are joined along their sides. */
struct LabelPiece
{
  LabelImage::Label label;
  LabelImage::Pixel first;        //!< one of them: the leftmost of the lowest row
  LabelImage::Pixel lower, upper; //!< their box, both ends included
  std::size_t       n_pixels;
};

/** The pieces of all labels but 0, by label, the largest first; in one pass over the image. */
std::vector<LabelPiece> pieces_of(const LabelImage &image);

/** The pixels of a piece, row by row in its box, x fastest: whether they belong to it. */
std::vector<bool> pixels_of(const LabelImage &image, const LabelPiece &piece);
} // namespace scree
