#pragma once

#include <deal.II/base/point.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace scree
{
/**
 * An image (2D) or volume (3D) whose pixels tell what they belong to: label 0 is what lies between
 * the bodies.
 */
template <int dim>
class LabelImage
{
public:
  using Label = std::uint32_t;
  using Pixel = std::array<int, dim>; //!< column from the left, row from below; page

  /**
   * Reads what read_labels() reads. The rows of a picture (PNG, PGM, TIFF) count from above and
   * are turned here; those of a volume count as they are, with its columns and pages.
   *
   * @param bytes of the file
   * @param name  of the file, for messages
   * @throws UserError if it is damaged, of another kind or dimension, in colour, or too large
   */
  static LabelImage read(const std::string &bytes, const std::string &name);

  /** @param labels x fastest, from the lower corner */
  LabelImage(const Pixel &n_pixels, std::vector<Label> labels);

  Label operator()(const Pixel &pixel) const
  {
    return labels[offset(pixel)];
  }

  /** Gives a pixel another label. */
  void set(const Pixel &pixel, const Label label)
  {
    labels[offset(pixel)] = label;
  }

  bool contains(const Pixel &pixel) const
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (pixel[d] < 0 || pixel[d] >= n[d])
        return false;
    return true;
  }

  const Pixel &n_pixels() const
  {
    return n;
  }

  Pixel last_pixel() const
  {
    Pixel result = n;
    for (int &number : result)
      --number;
    return result;
  }

  /** The pixels from `lower` to `upper`, both ends included and in the image. */
  LabelImage part(const Pixel &lower, const Pixel &upper) const;

  std::optional<double> pixel_size; //!< [L], if the file tells it

private:
  std::size_t offset(const Pixel &pixel) const
  {
    std::size_t result = pixel[dim - 1];
    for (int d = dim - 2; d >= 0; --d)
      result = result * n[d] + pixel[d];
    return result;
  }

  Pixel              n;
  std::vector<Label> labels;
};

/** Pixels of one label that are joined along their sides. */
template <int dim>
struct LabelPiece
{
  using Pixel = typename LabelImage<dim>::Pixel;

  std::uint32_t label;
  Pixel         first;        //!< one of them: the leftmost of the lowest row (of the first page)
  Pixel         lower, upper; //!< their box, both ends included
  std::size_t   n_pixels;
};

/** The pieces of all labels but 0, by label, the largest first; in one pass over the image. */
template <int dim>
std::vector<LabelPiece<dim>> pieces_of(const LabelImage<dim> &image);

/** The pixels of a piece in its box, x fastest: whether they belong to it. */
template <int dim>
std::vector<bool> pixels_of(const LabelImage<dim> &image, const LabelPiece<dim> &piece);

/** The same as a list, in this order. */
template <int dim>
std::vector<typename LabelImage<dim>::Pixel> list_of_pixels(const LabelImage<dim> &image,
                                                            const LabelPiece<dim> &piece);

/**
 * Gives a piece the label with which it has most sides of pixels in common, the lowest of several.
 * Returns that label; 0, and leaves it, if no other label touches it.
 */
template <int dim>
std::uint32_t merge_into_neighbour(const LabelPiece<dim> &piece, LabelImage<dim> &image);
} // namespace scree
