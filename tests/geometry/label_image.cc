// Label images: what is read, what is refused, and the shapes of labels.
#include <gtest/gtest.h>

#include <scree/base/exceptions.h>
#include <scree/geometry/label_shape.h>
#include <scree/geometry/level_set_from_shape.h>
#include <scree/level_set/binary_field.h>

#include <cmath>
#include <functional>

#include "../messages.h"

namespace scree
{
namespace
{
using namespace dealii;

using Label = LabelImage<2>::Label;

/** An image of a function of the centres of pixels, in pixels from the lower left corner. */
LabelImage<2>
image_of(const int width, const int height, const std::function<Label(const Point<2> &)> &label)
{
  std::vector<Label> labels;
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i)
      labels.push_back(label({i + 0.5, j + 0.5}));
  return LabelImage<2>({{width, height}}, labels);
}

TEST(LabelPieces, AreJoinedAlongSides)
{
  const LabelImage<2> image  = LabelImage<2>::read("P2 6 5 9\n"
                                                    "0 3 3 3 0 3\n"
                                                    "0 3 0 3 0 0\n"
                                                    "0 3 3 0 3 0\n"
                                                    "5 0 0 0 0 9\n"
                                                    "0 5 0 9 9 9\n",
                                                   "stones");
  const auto          pieces = pieces_of(image);
  ASSERT_EQ(pieces.size(), 6);
  EXPECT_EQ(pieces[0].label, 3);
  EXPECT_EQ(pieces[0].n_pixels, 7);
  EXPECT_EQ(pieces[0].lower, (LabelImage<2>::Pixel{{1, 2}}));
  EXPECT_EQ(pieces[0].upper, (LabelImage<2>::Pixel{{3, 4}}));
  EXPECT_EQ(pieces[0].first, (LabelImage<2>::Pixel{{1, 2}}));
  EXPECT_EQ(pieces[1].n_pixels, 1);
  EXPECT_EQ(pieces[5].label, 9);
  EXPECT_EQ(pieces[5].n_pixels, 4);
  const std::vector<bool> ring = pixels_of(image, pieces[0]);
  EXPECT_EQ(ring, (std::vector<bool>{true, true, false, true, false, true, true, true, true}));
}

TEST(LabelPieces, OfVolumesAreJoinedAcrossPages)
{
  // Pages of 3 x 2: a bar of label 1 goes up and turns, label 2 has two pieces.
  const LabelImage<3> image({{3, 2, 3}}, {1, 0, 2, //
                                          0, 0, 0, //
                                          1, 0, 0, //
                                          1, 0, 0, //
                                          0, 0, 0, //
                                          1, 1, 2});
  const auto          pieces = pieces_of(image);
  ASSERT_EQ(pieces.size(), 3u);
  EXPECT_EQ(pieces[0].n_pixels, 5u);
  EXPECT_EQ(pieces[0].first, (std::array<int, 3>{{0, 0, 0}}));
  EXPECT_EQ(pieces[0].lower, (std::array<int, 3>{{0, 0, 0}}));
  EXPECT_EQ(pieces[0].upper, (std::array<int, 3>{{1, 1, 2}}));
  EXPECT_EQ(pieces[2].first, (std::array<int, 3>{{2, 1, 2}}));
  EXPECT_EQ(pixels_of(image, pieces[0]),
            (std::vector<bool>{true, false, false, false, true, false, true, false, false, false,
                               true, true}));
}

TEST(LabelPieces, MergeIntoTheNeighbourWithMostSides)
{
  LabelImage<2> image  = LabelImage<2>::read("P2 4 3 9\n"
                                              "4 3 3 0\n"
                                              "4 7 3 0\n"
                                              "4 4 0 8\n",
                                             "stones");
  const auto    pieces = pieces_of(image);
  ASSERT_EQ(pieces.size(), 4u);
  EXPECT_EQ(merge_into_neighbour(pieces[2], image), 3u); // two sides each: the lower label
  EXPECT_EQ(image({{1, 1}}), 3u);
  EXPECT_EQ(merge_into_neighbour(pieces[3], image), 0u);
  EXPECT_EQ(image({{3, 0}}), 8u);
  const LabelImage<2> part = image.part({{1, 1}}, {{2, 2}});
  EXPECT_EQ(part.n_pixels(), (std::array<int, 2>{{2, 2}}));
  EXPECT_EQ(part({{0, 0}}), 3u);
  EXPECT_EQ(part({{1, 1}}), 3u);
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
  const Point<2>    centre(30, 31);
  const auto        image = image_of(60, 60, [&](const Point<2> &x) {
    const Tensor<1, 2> r = x - centre;
    return r.norm() < outline(std::atan2(r[1], r[0])) ? 4 : 0;
  });
  const auto        piece = pieces_of(image).at(0);
  LabelPlacement<2> placement;
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

TEST(LabelShape, RoundLabelsLoseTheirWideStepsAndSquaresKeepTheirCorners)
{
  const Point<2> centre(30., 30.);
  const auto disc   = image_of(60, 60, [&](const Point<2> &x) { return x.distance(centre) < 25; }),
             square = image_of(60, 60, [&](const Point<2> &x) {
               return std::max(std::abs(x[0] - 30), std::abs(x[1] - 30)) < 20;
             });
  LabelPlacement<2> placement;
  placement.pixel_size = 1.;
  const auto shape     = [&](const LabelImage<2> &image, const int smoothing) {
    placement.smoothing = smoothing;
    return shape_of_label(image, pieces_of(image).at(0), placement, "Image");
  };
  // The outline of the disc, off its circle by this many pixels.
  const auto off = [&](const int smoothing) {
    const auto of_disc = shape(disc, smoothing);
    double     largest = 0.;
    for (double angle = 0.; angle < 6.28; angle += 0.01)
      largest = std::max(largest, std::abs(of_disc->signed_distance(
                                    centre + 25. * Point<2>(std::cos(angle), std::sin(angle)))));
    return largest;
  };
  const double by_default = off(-1), by_four = off(4);
  std::cout << "off the circle by " << by_default << " pixels, " << by_four << " with 4 passes\n";
  EXPECT_LT(by_default, 0.1);
  EXPECT_GT(by_four, 1.5 * by_default);
  const auto a = shape(square, -1), b = shape(square, 4);
  for (double x = 30.; x < 55.; x += 0.5)
    EXPECT_EQ(a->signed_distance({x, x}), b->signed_distance({x, x}));
}

// An ellipsoid of 24 x 20 x 16 voxels.
TEST(LabelShape, KeepsVolumeAndSurfaceOfAVolume)
{
  const Point<3> centre(15.3, 14.6, 13.8);
  const auto     distance = [&](const Point<3> &x) {
    const Tensor<1, 3> r = x - centre;
    return std::sqrt(r[0] * r[0] / 144. + r[1] * r[1] / 100. + r[2] * r[2] / 64.);
  };
  std::vector<Label> labels;
  for (int k = 0; k < 28; ++k)
    for (int j = 0; j < 29; ++j)
      for (int i = 0; i < 30; ++i)
        labels.push_back(distance({i + 0.5, j + 0.5, k + 0.5}) < 1. ? 6 : 0);
  const LabelImage<3> image({{30, 29, 28}}, labels);
  const auto          piece = pieces_of(image).at(0);
  const double        pixel = 0.1;
  LabelPlacement<3>   placement;
  placement.pixel_size                        = pixel;
  placement.lower_corner                      = Point<3>(-1.5, -1.4, -1.3);
  const std::shared_ptr<const Shape<3>> shape = shape_of_label(image, piece, placement, "Image");
  const LatticeFrame<3>                 frame{Point<3>(-3., -3., -3.), 0.07,
                              BoundingBox<3>({Point<3>(-3, -3, -3), Point<3>(3, 3, 3)})};
  const double                          exact = piece.n_pixels * pixel * pixel * pixel;
  EXPECT_NEAR(volume_below(make_lattice<3>(shape, frame, 0.), 0.), exact, 5e-3 * exact);
  double largest = 0;
  for (unsigned int i = 0; i < 200; ++i)
    {
      const double       cosine = -1. + (i + 0.5) / 100., sine = std::sqrt(1. - cosine * cosine);
      const Tensor<1, 3> r
        = Point<3>(12. * sine * std::cos(2.4 * i), 10. * sine * std::sin(2.4 * i), 8. * cosine);
      largest = std::max(
        largest, std::abs(shape->signed_distance(placement.lower_corner + pixel * (centre + r))));
    }
  EXPECT_LT(largest, 0.5 * pixel);
}

TEST(LabelShape, NeighboursOverlapByLessThanAPixelAndNotWithAGap)
{
  const auto image  = image_of(60, 40, [](const Point<2> &x) {
    const bool left = x[0] < 30 + 2 * std::sin(0.3 * (x[1] - 20));
    return x.distance(Point<2>(30, 20)) > 19 ? 0 : left ? 1 : 2;
  });
  const auto pieces = pieces_of(image);
  ASSERT_EQ(pieces.size(), 2);
  LabelPlacement<2> placement;
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
  LabelPlacement<2> placement;
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
