// Files of labels: what is read, what is refused, and damage.
#include <gtest/gtest.h>

#include <scree/base/exceptions.h>
#include <scree/geometry/label_image.h>
#include <scree/geometry/label_readers.h>

#include <cstring>
#include <functional>
#include <png.h>
#include <random>
#include <tiffio.h>
#include <zlib.h>

#include "../messages.h"
#include "../temporary_file.h"

namespace scree
{
namespace
{
using Label = LabelImage<2>::Label;

/** The bytes of a PNG file, rows from above. */
template <typename Grey>
std::string
png_of(const std::vector<Grey> &pixels, const unsigned int width)
{
  png_image image{};
  image.version      = PNG_IMAGE_VERSION;
  image.width        = width;
  image.height       = pixels.size() / width;
  image.format       = sizeof(Grey) == 1 ? PNG_FORMAT_GRAY : PNG_FORMAT_LINEAR_Y;
  png_alloc_size_t n = 0;
  EXPECT_TRUE(png_image_write_to_memory(&image, nullptr, &n, 0, pixels.data(), 0, nullptr));
  std::string bytes(n, '\0');
  EXPECT_TRUE(png_image_write_to_memory(&image, bytes.data(), &n, 0, pixels.data(), 0, nullptr));
  bytes.resize(n);
  return bytes;
}

/** A file of libtiff in memory. */
struct TiffTarget
{
  std::string bytes;
  std::size_t position = 0;
};

/** A TIFF file that is written to memory. */
TIFF *
open_for_writing(TiffTarget &target)
{
  return TIFFClientOpen(
    "labels", "w", &target,
    [](thandle_t handle, void *bytes, tmsize_t n) -> tmsize_t {
      auto             &t      = *static_cast<TiffTarget *>(handle);
      const std::size_t left   = t.bytes.size() - std::min(t.bytes.size(), t.position);
      const std::size_t n_read = std::min<std::size_t>(n, left);
      std::memcpy(bytes, t.bytes.data() + t.position, n_read);
      t.position += n_read;
      return n_read;
    },
    [](thandle_t handle, void *bytes, tmsize_t n) -> tmsize_t {
      auto &t = *static_cast<TiffTarget *>(handle);
      t.bytes.resize(std::max(t.bytes.size(), t.position + n));
      std::memcpy(t.bytes.data() + t.position, bytes, n);
      t.position += n;
      return n;
    },
    [](thandle_t handle, toff_t offset, int whence) -> toff_t {
      auto &t    = *static_cast<TiffTarget *>(handle);
      t.position = offset
                   + (whence == SEEK_CUR   ? t.position
                      : whence == SEEK_END ? t.bytes.size()
                                           : 0);
      return t.position;
    },
    [](thandle_t) { return 0; },
    [](thandle_t handle) -> toff_t { return static_cast<TiffTarget *>(handle)->bytes.size(); },
    nullptr, nullptr);
}

/** Writes tiles of `edge` x `edge` pixels. */
template <typename Number>
void
write_tiles(TIFF *tiff, const std::vector<Number> &page, const unsigned int width,
            const unsigned int edge)
{
  const unsigned int height = page.size() / width;
  TIFFSetField(tiff, TIFFTAG_TILEWIDTH, edge);
  TIFFSetField(tiff, TIFFTAG_TILELENGTH, edge);
  for (unsigned int y = 0; y < height; y += edge)
    for (unsigned int x = 0; x < width; x += edge)
      {
        std::vector<Number> numbers(edge * edge);
        for (unsigned int j = y; j < std::min(y + edge, height); ++j)
          for (unsigned int i = x; i < std::min(x + edge, width); ++i)
            numbers[(j - y) * edge + i - x] = page[j * width + i];
        TIFFWriteTile(tiff, numbers.data(), x, y, 0, 0);
      }
}

/** Writes pages of a TIFF file; `set` sets what is not usual. */
template <typename Number>
std::string
tiff_of(const std::vector<std::vector<Number>> &pages, const unsigned int width,
        const std::function<void(TIFF *)> &set = {}, const unsigned int tile = 0)
{
  TiffTarget target;
  TIFF      *tiff = open_for_writing(target);
  for (const std::vector<Number> &page : pages)
    {
      const unsigned int height = page.size() / width;
      TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, width);
      TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, height);
      TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 8 * sizeof(Number));
      TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, 1);
      TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
      TIFFSetField(tiff, TIFFTAG_COMPRESSION, COMPRESSION_LZW);
      if (std::is_floating_point<Number>::value)
        TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_IEEEFP);
      if (set)
        set(tiff);
      if (tile > 0)
        write_tiles(tiff, page, width, tile);
      else
        for (unsigned int j = 0; j < height; ++j)
          TIFFWriteScanline(tiff, const_cast<Number *>(&page[j * width]), j, 0);
      TIFFWriteDirectory(tiff);
    }
  TIFFClose(tiff);
  return target.bytes;
}

/** The bytes of numbers as this machine has them. */
template <typename Number>
std::string
bytes_of(const std::vector<Number> &numbers)
{
  return {reinterpret_cast<const char *>(numbers.data()), numbers.size() * sizeof(Number)};
}

/** What zlib makes of bytes; `bits` 31: gzip, 15: zlib. */
std::string
packed(const std::string &bytes, const int bits)
{
  std::string result(bytes.size() + 1000, '\0');
  z_stream    stream{};
  deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, bits, 8, Z_DEFAULT_STRATEGY);
  stream.next_in   = reinterpret_cast<Bytef *>(const_cast<char *>(bytes.data()));
  stream.avail_in  = bytes.size();
  stream.next_out  = reinterpret_cast<Bytef *>(result.data());
  stream.avail_out = result.size();
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  result.resize(stream.total_out);
  deflateEnd(&stream);
  return result;
}

std::string
nrrd(const std::string &fields, const std::string &data)
{
  return "NRRD0004\n# a comment\ndimension: 3\nsizes: 3 2 2\n" + fields + "\n" + data;
}

std::string
meta_image(const std::string &fields, const std::string &data)
{
  return "ObjectType = Image\nNDims = 3\nDimSize = 3 2 2\n" + fields + "ElementDataFile = LOCAL\n"
         + data;
}

std::string
message(const std::string &bytes)
{
  return complaint([&]() { LabelImage<2>::read(bytes, "stones"); });
}

void
expect_pixels(const std::string &bytes, const std::vector<Label> &rows_from_below)
{
  const LabelImage<2> image = LabelImage<2>::read(bytes, "stones");
  std::vector<Label>  labels;
  for (int j = 0; j < image.n_pixels()[1]; ++j)
    for (int i = 0; i < image.n_pixels()[0]; ++i)
      labels.push_back(image({{i, j}}));
  EXPECT_EQ(labels, rows_from_below);
}

TEST(LabelFiles, PicturesAreRead)
{
  expect_pixels("P2 # a comment\n3 2\n300\n1 2 3\n# another\n0 0 300", {0, 0, 300, 1, 2, 3});
  expect_pixels("P5 3 2 255\n\x01\x02\x03\x04\x05\x06", {4, 5, 6, 1, 2, 3});
  expect_pixels(std::string("P5 1 2 65535\n\x01\x02\x00\x07", 17), {7, 258});
  expect_pixels(png_of<std::uint8_t>({1, 2, 3, 4, 5, 255}, 3), {4, 5, 255, 1, 2, 3});
  expect_pixels(png_of<std::uint16_t>({1, 2, 3, 0, 800, 65535}, 3), {0, 800, 65535, 1, 2, 3});
}

/** The labels of a file, x fastest, as the file has them. */
std::vector<Label>
labels_in(const std::string &bytes, const std::vector<std::size_t> &n_pixels = {3, 2, 2})
{
  const LabelArray array = read_labels(bytes, "stones");
  EXPECT_EQ(array.n_pixels, n_pixels);
  return array.labels;
}

TEST(LabelFiles, TiffIsRead)
{
  expect_pixels(tiff_of<std::uint8_t>({{1, 2, 3, 4, 5, 255}}, 3), {4, 5, 255, 1, 2, 3});
  expect_pixels(tiff_of<std::uint16_t>({{1, 2, 3, 0, 800, 65535}}, 3), {0, 800, 65535, 1, 2, 3});
  expect_pixels(tiff_of<std::uint32_t>({{1, 2, 3, 0, 800, 4294967295u}}, 3),
                {0, 800, 4294967295u, 1, 2, 3});
  expect_pixels(tiff_of<float>({{1, 2, 3, 0, 800, 65537}}, 3), {0, 800, 65537, 1, 2, 3});
  const std::vector<Label>                      labels = {1, 2, 3, 0, 800, 7, 8, 9, 10, 11, 0, 12};
  const std::vector<std::vector<std::uint16_t>> pages
    = {{1, 2, 3, 0, 800, 7}, {8, 9, 10, 11, 0, 12}};
  EXPECT_EQ(labels_in(tiff_of(pages, 3)), labels);
  EXPECT_EQ(labels_in(tiff_of(pages, 3, {}, 16)), labels);
  const LabelImage<3> image = LabelImage<3>::read(tiff_of(pages, 3), "stones");
  EXPECT_EQ(image({{1, 1, 0}}), 800u);
  EXPECT_EQ(image({{2, 0, 1}}), 10u);
}

TEST(LabelFiles, VolumesAreRead)
{
  const std::vector<std::uint16_t> numbers = {1, 2, 3, 0, 800, 7, 8, 9, 10, 11, 0, 12};
  const std::vector<Label>         labels(numbers.begin(), numbers.end());
  std::vector<std::uint16_t>       swapped;
  std::string                      text;
  for (const unsigned int number : numbers)
    {
      swapped.push_back(256 * (number % 256) + number / 256);
      text += std::to_string(number) + "\n";
    }
  const std::string raw    = bytes_of(numbers),
                    little = "type: ushort\nencoding: raw\nendian: little\n";
  EXPECT_EQ(labels_in(nrrd(little, raw)), labels);
  EXPECT_EQ(labels_in(nrrd("type: uint16\nencoding: raw\nendian: big\n", bytes_of(swapped))),
            labels);
  EXPECT_EQ(labels_in(nrrd("type: short\nencoding: gzip\nendian: little\n", packed(raw, 31))),
            labels);
  EXPECT_EQ(labels_in(nrrd("type: int\nencoding: text\n", text)), labels);
  EXPECT_EQ(labels_in(nrrd(little + "byte skip: -1\n", "other things" + raw)), labels);
  EXPECT_EQ(labels_in(nrrd(little + "line skip: 1\nbyte skip: 2\n", "one line\nab" + raw)), labels);
  EXPECT_EQ(labels_in(meta_image("ElementType = MET_USHORT\n", raw)), labels);
  EXPECT_EQ(labels_in(meta_image("BinaryDataByteOrderMSB = True\nElementType = MET_USHORT\n",
                                 bytes_of(swapped))),
            labels);
  EXPECT_EQ(
    labels_in(meta_image("CompressedData = True\nElementType = MET_USHORT\n", packed(raw, 15))),
    labels);
  EXPECT_EQ(labels_in(meta_image("BinaryData = False\nElementType = MET_INT\n", text)), labels);
  const std::vector<float> reals(numbers.begin(), numbers.end());
  EXPECT_EQ(labels_in(meta_image("ElementType = MET_FLOAT\n", bytes_of(reals))), labels);
}

TEST(LabelFiles, TellTheSizeOfPixels)
{
  const auto size = [](const std::string &bytes) {
    return read_labels(bytes, "stones").pixel_size.value_or(-1.);
  };
  const std::string data(12, '\1'), fields = "type: uchar\nencoding: raw\n";
  EXPECT_EQ(size(nrrd(fields, data)), -1.);
  EXPECT_EQ(size(nrrd(fields + "spacings: nan nan nan\n", data)), -1.);
  EXPECT_EQ(size(nrrd(fields + "spacings: 0.5 0.5 0.5\n", data)), 0.5);
  EXPECT_EQ(size(nrrd(fields + "space directions: (3,4,0) (-4,3,0) (0,0,5)\n", data)), 5.);
  EXPECT_EQ(size(meta_image("ElementType = MET_UCHAR\nElementSpacing = 2 2 2\n", data)), 2.);
  expect_contains(message(nrrd(fields + "spacings: 1 1 2\n", data)),
                  "sides of different lengths, 1 and 2");
}

TEST(LabelFiles, HeadersNameTheirData)
{
  const std::string   data(12, '\5');
  const TemporaryFile file("labels.raw", data);
  const std::string   whole = nrrd("type: uchar\nencoding: raw\n", data),
                    named   = nrrd("type: uchar\nencoding: raw\ndata file: labels.raw\n", ""),
                    meta    = "NDims = 3\nDimSize = 3 2 2\nElementType = MET_UCHAR\n"
                              "ElementDataFile = labels.raw\n",
                    beside  = file.name.substr(0, file.name.rfind('/') + 1) + "volume.nhdr";
  const std::vector<Label> labels(12, 5);
  EXPECT_EQ(labels_in(with_data_attached(named, beside, 1000)), labels);
  EXPECT_EQ(labels_in(with_data_attached(meta, beside, 1000)), labels);
  EXPECT_EQ(with_data_attached(whole, beside, 1000), whole);
  const auto complaint_of = [&](const std::string &bytes, const std::size_t largest = 1000) {
    return complaint([&]() { with_data_attached(bytes, beside, largest); });
  };
  expect_contains(complaint_of("NDims = 2\nElementDataFile = nowhere.raw\n"), "nowhere.raw");
  expect_contains(complaint_of("NDims = 2\nElementDataFile = LIST\n"), "in several files");
  expect_contains(complaint_of("NDims = 2\nElementDataFile = .\n"), "names no file of data");
  expect_contains(complaint_of(meta, 5), "volume.nhdr");
  expect_contains(message(meta), "the data are in another file");
}

TEST(LabelFiles, WhatIsNoVolumeIsRefused)
{
  const std::string data(12, '\1'), fields = "type: uchar\nencoding: raw\n";
  expect_contains(message(nrrd(fields, "123")), "of 12 bytes of labels there are 3");
  expect_contains(message(nrrd("encoding: raw\n", data)), "has no field 'type'");
  expect_contains(message(nrrd("type: block\nencoding: raw\n", data)),
                  "'block' is no type of labels");
  expect_contains(message(nrrd("type: uchar\nencoding: bzip2\n", data)),
                  "the encoding 'bzip2' is not read");
  expect_contains(message(nrrd("type: uchar\nencoding: gzip\n", data)),
                  "compressed labels are damaged");
  expect_contains(message(nrrd("type: signed char\nencoding: raw\n", std::string(12, '\xff'))),
                  "the value -1");
  expect_contains(message("NRRD0004\ndimension: 3\nsizes: 9999 9999 9999\n" + fields + "\n"),
                  "too large");
  expect_contains(message("NRRD0004\ndimension: 4\nsizes: 1 1 1 1\n\n"), "has dimension 4");
  expect_contains(message("NDims = 3\nDimSize = 1 1\nElementDataFile = LOCAL\n"),
                  "holds no 3 numbers");
  expect_contains(message("NDims = 3\n"), "has no ElementDataFile");
  expect_contains(complaint([]() { LabelImage<3>::read("P2 1 1 1\n1\n", "stones"); }),
                  "set Dimension = 2");
  expect_contains(message(nrrd(fields, data)), "set Dimension = 3");
}

TEST(LabelFiles, WhatIsNoLabelTiffIsRefused)
{
  expect_contains(message(tiff_of<float>({{0.5f, 1.f}}, 2)), "the value 0.5");
  expect_contains(message(tiff_of<double>({{0.5, 1.}}, 2)), "64 bits of a floating point number");
  expect_contains(message(tiff_of<std::uint8_t>({{1, 2, 3, 4}, {1, 2}}, 2)),
                  "page 2 has another size");
  expect_contains(message(tiff_of<std::uint8_t>({{1, 2, 3}}, 3).substr(0, 60)), "stones");
  const auto is_colour
    = [](TIFF *tiff) { TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_CIELAB); };
  expect_contains(message(tiff_of<std::uint8_t>({{1, 2, 3}}, 3, is_colour)),
                  "colours or transparency");
}

TEST(LabelFiles, WhatIsNoPictureIsRefused)
{
  expect_contains(message(""), "this is no PNG, PGM or TIFF image");
  expect_contains(message("GIF89a"), "this is no PNG, PGM or TIFF image");
  expect_contains(message("P5 3 2 255\n\x01\x02\x03"), "of 6 bytes there are 3");
  expect_contains(message("P5 100000 100000 255\n"), "at most 67108864 pixels");
  expect_contains(message("P5 0 3 255\n"), "no pixels");
  expect_contains(message("P2 2 x 255\n"),
                  "stones, byte 5: the height of the PGM image is no number");
  expect_contains(message("P2 2 1 3\n1 4\n"), "is 4, its largest value should be 3");
  expect_contains(message("P2 2 1 70000\n1 4\n"), "from 1 to 65535");
  const std::string png = png_of<std::uint8_t>(std::vector<std::uint8_t>(600, 7), 20);
  expect_contains(message(png.substr(0, png.size() - 20)), "the PNG image is damaged");
  std::string large = png;
  large[17]         = 1; // the second byte of the width
  expect_contains(message(large), "stones");
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = image.height  = 1;
  image.format                = PNG_FORMAT_RGB;
  const std::uint8_t colour[] = {1, 2, 3};
  std::string        bytes(1000, '\0');
  png_alloc_size_t   n = bytes.size();
  EXPECT_TRUE(png_image_write_to_memory(&image, bytes.data(), &n, 0, colour, 0, nullptr));
  expect_contains(message(bytes.substr(0, n)), "colours or transparency");
}

/** One file of each kind. */
std::vector<std::string>
files_of_labels()
{
  const auto                 stone = [](const int k) { return k % 37 < 9 ? 0 : k / 100; };
  std::vector<std::uint8_t>  narrow;
  std::vector<std::uint16_t> wide;
  std::string                text = "P2 40 30 300\n";
  for (int k = 0; k < 1200; ++k)
    {
      narrow.push_back(stone(k));
      wide.push_back(25 * stone(k));
      text += std::to_string(stone(k)) + (k % 20 == 19 ? "\n" : " ");
    }
  const std::string binary = "P5 40 30 255\n" + std::string(narrow.begin(), narrow.end());
  const std::string raw(narrow.begin(), narrow.end());
  const std::string sizes = "NRRD0004\ndimension: 3\nsizes: 10 30 4\ntype: uchar\n";
  std::vector<std::vector<std::uint16_t>> pages;
  for (int k = 0; k < 4; ++k)
    pages.emplace_back(wide.begin() + 300 * k, wide.begin() + 300 * (k + 1));
  return {png_of(narrow, 40),
          png_of(wide, 40),
          text,
          binary,
          tiff_of(pages, 10),
          tiff_of(pages, 10, {}, 16),
          tiff_of<std::uint16_t>(
            {wide}, 40,
            [](TIFF *tiff) { TIFFSetField(tiff, TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE); }),
          sizes + "encoding: raw\nspacings: 1 1 1\n\n" + raw,
          sizes + "encoding: gzip\n\n" + packed(raw, 31),
          "NDims = 3\nDimSize = 10 30 4\nElementSpacing = 1 1 1\nElementType = MET_UCHAR\n"
          "CompressedData = True\nElementDataFile = LOCAL\n"
            + packed(raw, 15)};
}

/** The bytes with some changes; headers get half of them. */
std::string
damaged(std::string bytes, std::mt19937_64 &random)
{
  for (unsigned int k = 0; k <= random() % 4; ++k)
    {
      const std::size_t place = random() % (random() % 2 ? bytes.size() : 100) % bytes.size();
      switch (random() % 4)
        {
        case 0:
          bytes[place] = static_cast<char>(random());
          break;
        case 1:
          bytes[place] ^= static_cast<char>(1u << random() % 8);
          break;
        case 2:
          bytes.erase(place, random() % 20);
          break;
        default:
          bytes.insert(place, bytes.substr(random() % bytes.size(), random() % 20));
        }
      if (bytes.empty())
        bytes = "P";
    }
  return bytes;
}

// Whatever the bytes are, there is an image or a message.
TEST(LabelFiles, SurviveDamage)
{
  std::mt19937_64 random(7);
  unsigned int    n_read = 0, n_refused = 0;
  for (const std::string &original : files_of_labels())
    for (unsigned int i = 0; i < 1000; ++i)
      {
        const std::string bytes = damaged(original, random);
        try
          {
            const LabelArray array = read_labels(bytes, "stones");
            if (array.n_pixels.size() == 2)
              pieces_of(LabelImage<2>::read(bytes, "stones"));
            else
              pieces_of(LabelImage<3>::read(bytes, "stones"));
            ++n_read;
          }
        catch (const UserError &error)
          {
            expect_contains(error.what(), "stones");
            ++n_refused;
          }
      }
  EXPECT_GT(n_read, 500);
  EXPECT_GT(n_refused, 2000);
}
} // namespace
} // namespace scree
