#include <scree/base/exceptions.h>
#include <scree/geometry/label_image.h>

#include <algorithm>
#include <cctype>
#include <csetjmp>
#include <cstring>
#include <png.h>

namespace scree
{
namespace
{
const std::string image_remedy = "write the image anew, as PNG or PGM with a grey value per label";

/** Throws UserError unless an image may have that size. */
void
require_size(const std::uint64_t width, const std::uint64_t height, const std::string &name)
{
  constexpr std::uint64_t most_pixels = 1 << 26;
  require(width > 0 && height > 0, name, "the image has no pixels", image_remedy);
  require(width <= most_pixels && height <= most_pixels / width, name,
          "the image of " + std::to_string(width) + " x " + std::to_string(height)
            + " pixels is too large",
          "crop or coarsen it: at most " + std::to_string(most_pixels) + " pixels are read");
}

/** What libpng reads from, and what it complained of. */
struct PngSource
{
  explicit PngSource(const std::string &bytes)
      : bytes(bytes)
  {
  }

  const std::string &bytes;
  std::size_t        position     = 0;
  char               message[200] = "";
  std::jmp_buf       back;
};

void
read_png_bytes(png_structp png, png_bytep target, std::size_t n)
{
  auto &source = *static_cast<PngSource *>(png_get_io_ptr(png));
  if (n > source.bytes.size() - source.position)
    png_error(png, "the file ends too early");
  std::memcpy(target, source.bytes.data() + source.position, n);
  source.position += n;
}

[[noreturn]] void
png_failed(png_structp png, png_const_charp message)
{
  auto &source = *static_cast<PngSource *>(png_get_error_ptr(png));
  std::strncpy(source.message, message, sizeof source.message - 1);
  std::longjmp(source.back, 1);
}

void
png_warned(png_structp /*png*/, png_const_charp /*message*/)
{
}

/** libpng's own structures, which end with this. */
struct PngReader
{
  explicit PngReader(PngSource &source)
      : png(png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, png_failed, png_warned))
      , info(png == nullptr ? nullptr : png_create_info_struct(png))
  {
  }
  PngReader(const PngReader &) = delete;
  ~PngReader()
  {
    png_destroy_read_struct(&png, &info, nullptr);
  }

  png_structp png;
  png_infop   info;
};

/** Reads the header. Returns false where libpng complains. (No destructor may be jumped over.) */
bool
read_png_header(PngReader &reader, PngSource &source)
{
  if (setjmp(source.back) != 0)
    return false;
  png_set_user_limits(reader.png, 1 << 26, 1 << 26);
  png_set_chunk_cache_max(reader.png, 100);
  png_set_chunk_malloc_max(reader.png, 1 << 20);
  png_set_read_fn(reader.png, &source, read_png_bytes);
  png_read_info(reader.png, reader.info);
  png_set_packing(reader.png);
  png_set_interlace_handling(reader.png);
  png_read_update_info(reader.png, reader.info);
  return true;
}

bool
read_png_rows(PngReader &reader, PngSource &source, std::vector<png_bytep> &rows)
{
  if (setjmp(source.back) != 0)
    return false;
  png_read_image(reader.png, rows.data());
  png_read_end(reader.png, nullptr);
  return true;
}

LabelImage
read_png(const std::string &bytes, const std::string &name)
{
  PngSource source(bytes);
  PngReader reader(source);
  require(reader.info != nullptr, name, "there is no memory to read the image", "make room");
  const auto require_read = [&](const bool is_read) {
    require(is_read, name + ", byte " + std::to_string(source.position),
            "the PNG image is damaged: " + std::string(source.message), image_remedy);
  };
  require_read(read_png_header(reader, source));
  const auto width  = png_get_image_width(reader.png, reader.info),
             height = png_get_image_height(reader.png, reader.info);
  const auto colour = png_get_color_type(reader.png, reader.info);
  require_size(width, height, name);
  require(colour == PNG_COLOR_TYPE_GRAY || colour == PNG_COLOR_TYPE_PALETTE, name,
          "the image has colours or transparency, which are no labels", image_remedy);
  const std::size_t bytes_of_row   = png_get_rowbytes(reader.png, reader.info),
                    bytes_of_label = png_get_bit_depth(reader.png, reader.info) == 16 ? 2 : 1;
  // A byte of a PNG file holds at most 1032 bytes, of which packed labels have eight.
  require(bytes_of_row * height <= 8 * 1040 * bytes.size(), name,
          "the PNG image ends too early: " + std::to_string(width) + " x " + std::to_string(height)
            + " pixels are in no " + std::to_string(bytes.size()) + " bytes",
          image_remedy);
  std::vector<png_byte>  content(bytes_of_row * height);
  std::vector<png_bytep> rows(height);
  for (std::size_t j = 0; j < height; ++j)
    rows[j] = &content[j * bytes_of_row];
  require_read(read_png_rows(reader, source, rows));
  std::vector<LabelImage::Label> labels(static_cast<std::size_t>(width) * height);
  for (std::size_t j = 0, k = 0; j < height; ++j)
    for (std::size_t i = 0; i < width; ++i, ++k)
      {
        const png_byte *first = rows[j] + i * bytes_of_label;
        labels[k]             = bytes_of_label == 1 ? first[0] : 256u * first[0] + first[1];
      }
  return LabelImage({{static_cast<int>(width), static_cast<int>(height)}}, std::move(labels));
}

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
          throw UserError(where(), what + " of the PGM image is too large", image_remedy);
        result = 10 * result + (bytes[place] - '0');
      }
    if (place == first)
      throw UserError(where(),
                      place == bytes.size() ? "the PGM image ends before " + what
                                            : what + " of the PGM image is no number",
                      image_remedy);
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

LabelImage
read_pgm(const std::string &bytes, const std::string &name)
{
  PgmNumbers numbers(bytes, name);
  const auto width = numbers.next("the width"), height = numbers.next("the height"),
             largest = numbers.next("the largest value");
  require_size(width, height, name);
  require(largest > 0 && largest < 65536, name,
          "the largest value of the PGM image is " + std::to_string(largest),
          "it must be from 1 to 65535");
  const std::size_t n_pixels       = static_cast<std::size_t>(width) * height,
                    bytes_of_label = largest < 256 ? 1 : 2;
  const bool        is_text        = bytes[1] == '2';
  const std::size_t n_left         = bytes.size() - std::min(bytes.size(), numbers.place + 1),
                    n_needed       = is_text ? 2 * n_pixels - 1 : bytes_of_label * n_pixels;
  require(n_left >= n_needed, name,
          "the PGM image ends too early: of " + std::to_string(n_needed) + " bytes there are "
            + std::to_string(n_left),
          image_remedy);
  std::vector<LabelImage::Label> labels(n_pixels);
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
                        image_remedy);
    }
  return LabelImage({{static_cast<int>(width), static_cast<int>(height)}}, std::move(labels));
}
} // namespace

LabelImage
LabelImage::read(const std::string &bytes, const std::string &name)
{
  const auto begins
    = [&](const std::string &mark) { return bytes.compare(0, mark.size(), mark) == 0; };
  if (begins("\x89PNG"))
    return read_png(bytes, name);
  require(begins("P2") || begins("P5"), name, "this is no PNG and no PGM image", image_remedy);
  return read_pgm(bytes, name);
}
} // namespace scree
