#include <scree/base/exceptions.h>
#include <scree/base/log.h>
#include <scree/geometry/volume_header.h>

#include <boost/algorithm/string/predicate.hpp>
#include <cmath>

namespace scree
{
std::string
label_remedy()
{
  return "write the labels anew: as PNG, PGM or TIFF, a volume as TIFF of several pages, NRRD or "
         "MetaImage";
}

std::size_t
number_of_pixels(const std::vector<std::size_t> &n_pixels, const std::string &name)
{
  const std::size_t most   = n_pixels.size() == 2 ? 1 << 26 : 1 << 29;
  std::size_t       result = 1;
  std::string       size;
  for (const std::size_t n : n_pixels)
    {
      size += (size.empty() ? "" : " x ") + std::to_string(n);
      result = n == 0 || result == 0 ? 0 : n > most / result ? most + 1 : n * result;
    }
  require(result > 0, name, "the image of " + size + " has no pixels", label_remedy());
  require(result <= most, name, "the image of " + size + " pixels is too large",
          "crop or coarsen it: at most " + std::to_string(most) + " pixels are read");
  return result;
}

void
require_enough_bytes(const std::size_t n_label_bytes, const std::size_t n_file_bytes,
                     const std::string &name)
{
  require(n_label_bytes / 1040 <= n_file_bytes, name,
          "the file ends too early: " + std::to_string(n_file_bytes)
            + " bytes cannot hold the labels of its pixels",
          label_remedy());
}

void
append_labels(const char *numbers, const std::size_t n, const NumberType type, const bool swaps,
              const std::string &name, std::vector<std::uint32_t> &labels)
{
  labels.reserve(labels.size() + n);
  for (std::size_t i = 0; i < n; ++i)
    {
      const double number = number_at(numbers + i * size_of(type), type, swaps);
      // A comparison with NaN is false.
      if (!(number >= 0. && number <= 4294967295. && number == std::floor(number)))
        throw UserError(name, "a pixel has the value " + short_number(number),
                        "labels are whole numbers from 0 to 4294967295");
      labels.push_back(static_cast<std::uint32_t>(number));
    }
}

LabelArray
read_labels(const std::string &bytes, const std::string &name)
{
  const auto begins
    = [&](const std::string &mark) { return boost::algorithm::starts_with(bytes, mark); };
  if (begins("\x89PNG"))
    return read_png(bytes, name);
  if (begins("P2") || begins("P5"))
    return read_pgm(bytes, name);
  if (begins("II") || begins("MM"))
    return read_tiff(bytes, name);
  require(has_volume_header(bytes), name,
          "this is no PNG, PGM or TIFF image, no NRRD file and no MetaImage", label_remedy());
  return begins("NRRD") ? read_nrrd(bytes, name) : read_meta_image(bytes, name);
}
} // namespace scree
