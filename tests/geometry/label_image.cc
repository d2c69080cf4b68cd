// Label images: what is read, what is refused, and the shapes of labels.
#include <gtest/gtest.h>

#include <scree/base/exceptions.h>
#include <scree/geometry/label_shape.h>
#include <scree/geometry/level_set_from_shape.h>
#include <scree/level_set/binary_field.h>

#include <cmath>
#include <functional>
#include <png.h>
#include <random>

#include "../messages.h"

namespace scree
{
namespace
{
using namespace dealii;

using Label = LabelImage::Label;

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

/** An image of a function of the centres of pixels, in pixels from the lower left corner. */
LabelImage
image_of(const int width, const int height, const std::function<Label(const Point<2> &)> &label)
{
  std::vector<Label> labels;
  for (int row = 0; row < height; ++row)
    for (int i = 0; i < width; ++i)
      labels.push_back(label({i + 0.5, height - row - 0.5}));
  return LabelImage({{width, height}}, labels);
}

std::string
message(const std::string &bytes)
{
  return complaint([&]() { LabelImage::read(bytes, "stones"); });
}

void
expect_pixels(const std::string &bytes, const std::vector<Label> &rows_from_below)
{
  const LabelImage   image = LabelImage::read(bytes, "stones");
  std::vector<Label> labels;
  for (int j = 0; j < image.n_pixels()[1]; ++j)
    for (int i = 0; i < image.n_pixels()[0]; ++i)
      labels.push_back(image({{i, j}}));
  EXPECT_EQ(labels, rows_from_below);
}

TEST(LabelImage, ReadsEachKind)
{
  expect_pixels("P2 # a comment\n3 2\n300\n1 2 3\n# another\n0 0 300", {0, 0, 300, 1, 2, 3});
  expect_pixels("P5 3 2 255\n\x01\x02\x03\x04\x05\x06", {4, 5, 6, 1, 2, 3});
  expect_pixels(std::string("P5 1 2 65535\n\x01\x02\x00\x07", 17), {7, 258});
  expect_pixels(png_of<std::uint8_t>({1, 2, 3, 4, 5, 255}, 3), {4, 5, 255, 1, 2, 3});
  expect_pixels(png_of<std::uint16_t>({1, 2, 3, 0, 800, 65535}, 3), {0, 800, 65535, 1, 2, 3});
}

TEST(LabelImage, RefusesWhatIsNoLabelImage)
{
  expect_contains(message(""), "no PNG and no PGM");
  expect_contains(message("GIF89a"), "no PNG and no PGM");
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

// Whatever the bytes are, there is an image or a message.
TEST(LabelImage, SurvivesDamage)
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
  std::mt19937_64   random(7);
  unsigned int      n_read = 0, n_refused = 0;
  for (const std::string &original : {png_of(narrow, 40), png_of(wide, 40), text, binary})
    for (unsigned int i = 0; i < 2500; ++i)
      {
        std::string bytes = original;
        for (unsigned int k = 0; k <= random() % 4; ++k)
          {
            // Headers get half of the changes.
            const std::size_t place = random() % (random() % 2 ? bytes.size() : 40) % bytes.size();
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
        try
          {
            const LabelImage image = LabelImage::read(bytes, "stones");
            pieces_of(image);
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

TEST(LabelPieces, AreJoinedAlongSides)
{
  const LabelImage image  = LabelImage::read("P2 6 5 9\n"
                                              "0 3 3 3 0 3\n"
                                              "0 3 0 3 0 0\n"
                                              "0 3 3 0 3 0\n"
                                              "5 0 0 0 0 9\n"
                                              "0 5 0 9 9 9\n",
                                             "stones");
  const auto       pieces = pieces_of(image);
  ASSERT_EQ(pieces.size(), 6);
  EXPECT_EQ(pieces[0].label, 3);
  EXPECT_EQ(pieces[0].n_pixels, 7);
  EXPECT_EQ(pieces[0].lower, (LabelImage::Pixel{{1, 2}}));
  EXPECT_EQ(pieces[0].upper, (LabelImage::Pixel{{3, 4}}));
  EXPECT_EQ(pieces[0].first, (LabelImage::Pixel{{1, 2}}));
  EXPECT_EQ(pieces[1].n_pixels, 1);
  EXPECT_EQ(pieces[5].label, 9);
  EXPECT_EQ(pieces[5].n_pixels, 4);
  const std::vector<bool> ring = pixels_of(image, pieces[0]);
  EXPECT_EQ(ring, (std::vector<bool>{true, true, false, true, false, true, true, true, true}));
}

/** The area of a shape on a lattice of this spacing. */
double
area(std::shared_ptr<const Shape<2>> shape, const double spacing)
{
  const LatticeFrame<2> frame{Point<2>(-3., -3.), spacing,
                              BoundingBox<2>({Point<2>(-3, -3), Point<2>(9, 9)})};
  return volume_below(make_lattice(shape, frame, 0.), 0.);
}

TEST(LabelShape, KeepsAreaAndOutlineOnAnyGrid)
{
  // A stone of about 40 pixels, rough by a pixel, in a picture of edge 6.
  const double radius = 20, pixel = 0.1;
  const auto   outline = [&](const double angle) {
    return radius * (1 + 0.15 * std::cos(3 * angle) + 0.1 * std::sin(2 * angle));
  };
  const Point<2> centre(30, 31);
  const auto     image = image_of(60, 60, [&](const Point<2> &x) {
    const Tensor<1, 2> r = x - centre;
    return r.norm() < outline(std::atan2(r[1], r[0])) ? 4 : 0;
  });
  const auto     piece = pieces_of(image).at(0);
  LabelPlacement placement;
  placement.pixel_size                        = pixel;
  placement.lower_corner                      = Point<2>(0.03, -0.07);
  const std::shared_ptr<const Shape<2>> shape = shape_of_label(image, piece, placement, "Image");
  const double                          exact = piece.n_pixels * pixel * pixel;
  for (const double spacing : {0.02, 0.05, 0.1, 0.13, 0.2})
    EXPECT_NEAR(area(shape, spacing), exact, 5e-3 * exact) << "spacing " << spacing;
  double largest = 0;
  for (unsigned int i = 0; i < 200; ++i)
    {
      const double   angle = 0.01 * numbers::PI * i;
      const Point<2> x
        = placement.lower_corner
          + pixel * (centre + outline(angle) * Point<2>(std::cos(angle), std::sin(angle)));
      largest = std::max(largest, std::abs(shape->signed_distance(x)));
    }
  EXPECT_LT(largest, 0.5 * pixel);
  // Far off: the distance to the box of the stone is a bound.
  const Point<2> far(20., 9.);
  const auto     box = shape->bounding_box();
  EXPECT_GT(shape->signed_distance(far), far.distance(box.get_boundary_points().second) - 1e-12);
  EXPECT_LT(shape->signed_distance(far), far.distance(box.center()));
}

TEST(LabelShape, NeighboursOverlapByLessThanAPixelAndNotWithAGap)
{
  const auto image  = image_of(60, 40, [](const Point<2> &x) {
    const bool left = x[0] < 30 + 2 * std::sin(0.3 * (x[1] - 20));
    return x.distance(Point<2>(30, 20)) > 19 ? 0 : left ? 1 : 2;
  });
  const auto pieces = pieces_of(image);
  ASSERT_EQ(pieces.size(), 2);
  LabelPlacement placement;
  placement.pixel_size = 1.;
  const auto overlap   = [&]() {
    const auto a   = shape_of_label(image, pieces[0], placement, "Image"),
               b   = shape_of_label(image, pieces[1], placement, "Image");
    double largest = 0;
    for (double x = 20; x < 40; x += 0.1)
      for (double y = 0; y < 40; y += 0.1)
        largest
          = std::max(largest, -std::max(a->signed_distance({x, y}), b->signed_distance({x, y})));
    return 2 * largest;
  };
  EXPECT_LT(overlap(), 1.);
  placement.gap = 1.;
  EXPECT_EQ(overlap(), 0.);
}

TEST(LabelShape, KeepsThinNecks)
{
  const auto image  = image_of(60, 24, [](const Point<2> &x) {
    const bool in_neck = std::abs(x[1] - 12) < 1 && x[0] > 10 && x[0] < 50;
    return in_neck || x.distance(Point<2>(12, 12)) < 9 || x.distance(Point<2>(48, 12)) < 9 ? 1 : 0;
  });
  const auto pieces = pieces_of(image);
  ASSERT_EQ(pieces.size(), 1);
  LabelPlacement placement;
  placement.pixel_size = 1.;
  const auto shape     = shape_of_label(image, pieces[0], placement, "Image");
  for (double x = 12; x < 48; x += 0.25)
    EXPECT_LT(shape->signed_distance({x, 12}), 0.) << "at " << x;
  placement.gap = 3.;
  try
    {
      shape_of_label(image, pieces[0], placement, "Bodies/stone/Image");
      FAIL() << "there is no message";
    }
  catch (const UserError &error)
    {
      expect_contains(error.what(), "Bodies/stone/Image: shrunk by half of Gap = 3, label 1");
      expect_contains(error.what(), "falls into pieces");
    }
}
} // namespace
} // namespace scree
