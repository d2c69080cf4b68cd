#include <scree/base/exceptions.h>
#include <scree/geometry/label_readers.h>

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <memory>
#include <tiffio.h>

namespace scree
{
namespace
{
/** A file in memory, and what libtiff complained of first. */
struct TiffSource
{
  const std::string &bytes;
  toff_t             position = 0;
  std::string        message  = {};
};

TiffSource &
source_of(thandle_t handle)
{
  return *static_cast<TiffSource *>(handle);
}

tmsize_t
read_bytes_of(thandle_t handle, void *target, tmsize_t n)
{
  TiffSource       &source = source_of(handle);
  const std::size_t size
    = source.bytes.size(),
    n_read = source.position >= size ? 0 : std::min<std::size_t>(n, size - source.position);
  std::memcpy(target, source.bytes.data() + (n_read == 0 ? 0 : source.position), n_read);
  source.position += n_read;
  return n_read;
}

tmsize_t
write_nothing(thandle_t /*handle*/, void * /*bytes*/, tmsize_t /*n*/)
{
  return 0;
}

toff_t
seek_in(thandle_t handle, toff_t offset, int whence)
{
  TiffSource &source = source_of(handle);
  source.position    = whence == SEEK_SET   ? offset
                       : whence == SEEK_CUR ? source.position + offset
                                            : source.bytes.size() + offset;
  return source.position;
}

int
close_nothing(thandle_t /*handle*/)
{
  return 0;
}

toff_t
size_of_source(thandle_t handle)
{
  return source_of(handle).bytes.size();
}

int
keep_message(TIFF * /*tiff*/, void *source, const char * /*module*/, const char *format,
             va_list arguments)
{
  std::array<char, 200> text{};
  std::vsnprintf(text.data(), text.size(), format, arguments);
  if (auto &message = static_cast<TiffSource *>(source)->message; message.empty())
    message = text.data();
  return 1;
}

int
ignore_warning(TIFF * /*tiff*/, void * /*source*/, const char * /*module*/, const char * /*format*/,
               va_list /*arguments*/)
{
  return 1;
}

using TiffPointer = std::unique_ptr<TIFF, void (*)(TIFF *)>;

TiffPointer
open_tiff(TiffSource &source)
{
  const std::unique_ptr<TIFFOpenOptions, void (*)(TIFFOpenOptions *)> options(
    TIFFOpenOptionsAlloc(), TIFFOpenOptionsFree);
  TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), 1 << 30);
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), keep_message, &source);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), ignore_warning, nullptr);
  return {TIFFClientOpenExt("labels", "rm", &source, read_bytes_of, write_nothing, seek_in,
                            close_nothing, size_of_source, nullptr, nullptr, options.get()),
          TIFFClose};
}

/** Throws UserError with what libtiff said, unless `is_read`. */
void
require_read(const bool is_read, const TiffSource &source, const std::string &name)
{
  require(is_read, name, "the TIFF image is damaged: " + source.message, label_remedy());
}

/** What a page holds. */
struct TiffPage
{
  TiffPage(TIFF *tiff, const std::string &name);

  std::uint32_t width = 0, height = 0;
  NumberType    type = NumberType::uint8;
};

TiffPage::TiffPage(TIFF *tiff, const std::string &name)
{
  std::uint16_t bits = 1, format = SAMPLEFORMAT_UINT, n_values = 1,
                colours = PHOTOMETRIC_MINISBLACK;
  TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &width);
  TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &height);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &bits);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLEFORMAT, &format);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &n_values);
  TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &colours);
  require(n_values == 1
            && (colours == PHOTOMETRIC_MINISBLACK || colours == PHOTOMETRIC_MINISWHITE
                || colours == PHOTOMETRIC_PALETTE),
          name, "the image has colours or transparency, which are no labels", label_remedy());
  if (format == SAMPLEFORMAT_VOID)
    format = SAMPLEFORMAT_UINT;
  const bool is_whole = format == SAMPLEFORMAT_UINT || format == SAMPLEFORMAT_INT,
             is_real  = format == SAMPLEFORMAT_IEEEFP;
  require((is_whole && (bits == 8 || bits == 16 || bits == 32)) || (is_real && bits == 32), name,
          "a pixel of the TIFF image has " + std::to_string(bits) + " bits"
            + (is_real ? " of a floating point number" : ""),
          "write labels of 8, 16 or 32 bits");
  const bool has_sign = format == SAMPLEFORMAT_INT;
  type                = is_real      ? NumberType::float32
                        : bits == 8  ? (has_sign ? NumberType::int8 : NumberType::uint8)
                        : bits == 16 ? (has_sign ? NumberType::int16 : NumberType::uint16)
                                     : (has_sign ? NumberType::int32 : NumberType::uint32);
}

/** Whether the numbers of a page, row by row, could be read. */
bool
read_rows(TIFF *tiff, const TiffPage &page, std::string &numbers)
{
  const std::size_t bytes_of_row = page.width * size_of(page.type);
  if (static_cast<std::size_t>(TIFFScanlineSize64(tiff)) != bytes_of_row)
    return false;
  for (std::uint32_t j = 0; j < page.height; ++j)
    if (TIFFReadScanline(tiff, numbers.data() + j * bytes_of_row, j, 0) < 0)
      return false;
  return true;
}

bool
read_tiles(TIFF *tiff, const TiffPage &page, std::string &numbers)
{
  std::uint32_t tile_width = 0, tile_height = 0;
  TIFFGetField(tiff, TIFFTAG_TILEWIDTH, &tile_width);
  TIFFGetField(tiff, TIFFTAG_TILELENGTH, &tile_height);
  const std::size_t size = size_of(page.type), n_bytes = TIFFTileSize64(tiff);
  if (tile_width == 0 || tile_height == 0 || n_bytes > 1 << 30
      || n_bytes != size * tile_width * tile_height)
    return false;
  std::vector<char> tile(n_bytes);
  for (std::size_t y = 0; y < page.height; y += tile_height)
    for (std::size_t x = 0; x < page.width; x += tile_width)
      {
        if (TIFFReadTile(tiff, tile.data(), x, y, 0, 0) < 0)
          return false;
        const std::size_t n_columns = std::min<std::size_t>(tile_width, page.width - x),
                          n_rows    = std::min<std::size_t>(tile_height, page.height - y);
        for (std::size_t j = 0; j < n_rows; ++j)
          std::memcpy(numbers.data() + ((y + j) * page.width + x) * size,
                      tile.data() + j * tile_width * size, n_columns * size);
      }
  return true;
}
} // namespace

LabelArray
read_tiff(const std::string &bytes, const std::string &name)
{
  TiffSource        source{bytes};
  const TiffPointer tiff = open_tiff(source);
  require_read(tiff != nullptr, source, name);
  LabelArray array;
  array.rows_from_above = true;
  std::size_t n_pages   = 0;
  do
    {
      std::uint32_t kind = 0;
      if (TIFFGetField(tiff.get(), TIFFTAG_SUBFILETYPE, &kind) != 0
          && (kind & FILETYPE_REDUCEDIMAGE) != 0)
        continue;
      const TiffPage page(tiff.get(), name);
      if (n_pages++ == 0)
        array.n_pixels = {page.width, page.height};
      require(page.width == array.n_pixels[0] && page.height == array.n_pixels[1], name,
              "page " + std::to_string(n_pages) + " has another size than the first one",
              "write pages of one size");
      number_of_pixels({page.width, page.height, n_pages}, name);
      const std::size_t n_bytes = number_of_pixels(array.n_pixels, name) * size_of(page.type);
      require_enough_bytes(n_bytes, bytes.size(), name);
      std::string numbers(n_bytes, '\0');
      require_read(TIFFIsTiled(tiff.get()) != 0 ? read_tiles(tiff.get(), page, numbers)
                                                : read_rows(tiff.get(), page, numbers),
                   source, name);
      append_labels(numbers.data(), n_bytes / size_of(page.type), page.type, false, name,
                    array.labels);
    }
  while (TIFFReadDirectory(tiff.get()) != 0);
  require_read(n_pages > 0 && source.message.empty(), source, name);
  if (n_pages > 1)
    array.n_pixels.push_back(n_pages);
  return array;
}
} // namespace scree
