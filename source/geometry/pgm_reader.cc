#include <scree/base/exceptions.h>
#include <scree/geometry/label_readers.h>

#include <algorithm>
#include <cctype>

namespace scree
{
namespace
{
/** The numbers of a PGM file: white space and comments stand between them. */
class PgmNumbers
{
public:
  PgmNumbers(const std::string &bytes, const std::string &name)
      : bytes(bytes)
      , name(name)
  {
  }

  std::uint32_t next(const std::string &what)
  {
    while (place < bytes.size() && (is_space() || bytes[place] == '#'))
      if (bytes[place] == '#')
        place = std::min(bytes.find_first_of("\r\n", place), bytes.size());
      else
        ++place;
    std::uint32_t     result = 0;
    const std::size_t first  = place;
    for (; place < bytes.size() && bytes[place] >= '0' && bytes[place] <= '9'; ++place)
      {
        if (place - first >= 9)
          throw UserError(where(), what + " of the PGM image is too large", label_remedy());
        result = 10 * result + (bytes[place] - '0');
      }
    if (place == first)
      throw UserError(where(),
                      place == bytes.size() ? "the PGM image ends before " + what
                                            : what + " of the PGM image is no number",
                      label_remedy());
    return result;
  }

  std::string where() const
  {
    return name + ", byte " + std::to_string(place);
  }

  std::size_t place = 2; // behind P2 or P5

private:
  bool is_space() const
  {
    return std::isspace(static_cast<unsigned char>(bytes[place])) != 0;
  }

  const std::string &bytes, &name;
};
} // namespace

LabelArray
read_pgm(const std::string &bytes, const std::string &name)
{
  PgmNumbers numbers(bytes, name);
  const auto width = numbers.next("the width"), height = numbers.next("the height"),
             largest = numbers.next("the largest value");
  LabelArray array;
  array.n_pixels        = {width, height};
  array.rows_from_above = true;
  require(largest > 0 && largest < 65536, name,
          "the largest value of the PGM image is " + std::to_string(largest),
          "it must be from 1 to 65535");
  const std::size_t n_pixels       = number_of_pixels(array.n_pixels, name),
                    bytes_of_label = largest < 256 ? 1 : 2;
  const bool        is_text        = bytes[1] == '2';
  const std::size_t n_left         = bytes.size() - std::min(bytes.size(), numbers.place + 1),
                    n_needed       = is_text ? 2 * n_pixels - 1 : bytes_of_label * n_pixels;
  require(n_left >= n_needed, name,
          "the PGM image ends too early: of " + std::to_string(n_needed) + " bytes there are "
            + std::to_string(n_left),
          label_remedy());
  std::vector<std::uint32_t> &labels = array.labels;
  labels.resize(n_pixels);
  const auto *content = reinterpret_cast<const unsigned char *>(bytes.data()) + numbers.place + 1;
  for (std::size_t k = 0; k < n_pixels; ++k)
    {
      labels[k] = is_text               ? numbers.next("a pixel")
                  : bytes_of_label == 1 ? content[k]
                                        : 256u * content[2 * k] + content[2 * k + 1];
      if (labels[k] > largest)
        throw UserError(is_text ? numbers.where() : name,
                        "a pixel of the PGM image is " + std::to_string(labels[k])
                          + ", its largest value should be " + std::to_string(largest),
                        label_remedy());
    }
  return array;
}
} // namespace scree
