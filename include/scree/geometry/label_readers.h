#pragma once

#include <scree/geometry/number_type.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace scree
{
/** Labels as a file has them. */
struct LabelArray
{
  std::vector<std::size_t>   n_pixels;                //!< columns, rows and, of a volume, pages
  std::vector<std::uint32_t> labels;                  //!< x fastest
  bool                       rows_from_above = false; //!< as pictures have them
  std::optional<double>      pixel_size;              //!< [L], if the file tells it
};

/** What to do about a file that cannot be read. */
std::string label_remedy();

/**
 * The product of the numbers of pixels.
 *
 * @throws UserError if there is none, or more than 2^26 in a picture or 2^29 in a volume
 */
std::size_t number_of_pixels(const std::vector<std::size_t> &n_pixels, const std::string &name);

/**
 * Throws UserError if so many bytes of labels cannot be packed in a file of `n_file_bytes`: a byte
 * of a compressed file holds 1032 bytes at most.
 */
void require_enough_bytes(const std::size_t n_label_bytes, const std::size_t n_file_bytes,
                          const std::string &name);

/**
 * Appends `n` labels from numbers.
 *
 * @param swaps whether the bytes of each stand in the other order
 * @throws UserError if one is no whole number from 0 to 2^32 - 1
 */
void append_labels(const char *numbers, const std::size_t n, const NumberType type,
                   const bool swaps, const std::string &name, std::vector<std::uint32_t> &labels);

/**
 * Grey values of up to 16 bits, or a palette, whose indices are the labels.
 *
 * @throws UserError, as the others do, if it is damaged, of another kind or too large
 */
LabelArray read_png(const std::string &bytes, const std::string &name);

/** PGM: P2 and P5, 16 bits. */
LabelArray read_pgm(const std::string &bytes, const std::string &name);

/** TIFF: one value a pixel of 8, 16 or 32 bits (whole numbers, also as floating point numbers).
 * Several pages are a volume. */
LabelArray read_tiff(const std::string &bytes, const std::string &name);

/** NRRD, two or three dimensions, raw, gzip or text. */
LabelArray read_nrrd(const std::string &bytes, const std::string &name);

/** MetaImage (MHD with its data appended, MHA), two or three dimensions, raw or compressed. */
LabelArray read_meta_image(const std::string &bytes, const std::string &name);

/** Whichever of these the bytes begin as. */
LabelArray read_labels(const std::string &bytes, const std::string &name);

/**
 * The bytes of a header of NRRD or MetaImage with those of the file appended that it names, so that
 * it names none any more; other bytes as they are.
 *
 * @param path         of the header: the other file is sought beside it
 * @param largest_size the most bytes that are read
 * @throws UserError if that file cannot be read
 */
std::string with_data_attached(const std::string &bytes, const std::string &path,
                               const std::size_t largest_size);
} // namespace scree
