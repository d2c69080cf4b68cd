#include <scree/base/exceptions.h>
#include <scree/geometry/label_readers.h>

#include <csetjmp>
#include <cstring>
#include <png.h>

namespace scree
{
namespace
{
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
} // namespace

LabelArray
read_png(const std::string &bytes, const std::string &name)
{
  PngSource source(bytes);
  PngReader reader(source);
  require(reader.info != nullptr, name, "there is no memory to read the image", "make room");
  const auto require_read = [&](const bool is_read) {
    require(is_read, name + ", byte " + std::to_string(source.position),
            "the PNG image is damaged: " + std::string(source.message), label_remedy());
  };
  require_read(read_png_header(reader, source));
  const auto width  = png_get_image_width(reader.png, reader.info),
             height = png_get_image_height(reader.png, reader.info);
  const auto colour = png_get_color_type(reader.png, reader.info);
  LabelArray array;
  array.n_pixels             = {width, height};
  array.rows_from_above      = true;
  const std::size_t n_pixels = number_of_pixels(array.n_pixels, name);
  require(colour == PNG_COLOR_TYPE_GRAY || colour == PNG_COLOR_TYPE_PALETTE, name,
          "the image has colours or transparency, which are no labels", label_remedy());
  const std::size_t bytes_of_row   = png_get_rowbytes(reader.png, reader.info),
                    bytes_of_label = png_get_bit_depth(reader.png, reader.info) == 16 ? 2 : 1;
  require_enough_bytes(bytes_of_row * height / 8, bytes.size(), name); // up to eight in a byte
  std::vector<png_byte>  content(bytes_of_row * height);
  std::vector<png_bytep> rows(height);
  for (std::size_t j = 0; j < height; ++j)
    rows[j] = &content[j * bytes_of_row];
  require_read(read_png_rows(reader, source, rows));
  append_labels(reinterpret_cast<const char *>(content.data()), n_pixels,
                bytes_of_label == 1 ? NumberType::uint8 : NumberType::uint16,
                machine_is_little_endian(), name, array.labels);
  return array;
}
} // namespace scree
