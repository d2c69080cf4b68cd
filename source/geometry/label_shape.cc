#include <scree/base/exceptions.h>
#include <scree/base/log.h>
#include <scree/geometry/label_shape.h>
#include <scree/geometry/lattice_shape.h>
#include <scree/level_set/binary_field.h>
#include <scree/level_set/fast_marching.h>
#include <scree/level_set/pieces.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace scree
{
using namespace dealii;

Point<2>
LabelPlacement::centre(const LabelImage::Pixel &pixel) const
{
  return lower_corner + pixel_size * Point<2>(pixel[0] + 0.5, pixel[1] + 0.5);
}

namespace
{
/** -1 at the pixels of a piece and 1 around them, nodes at their centres. */
Lattice<2>
signs_of(const LabelImage &image, const LabelPiece &piece, const LabelPlacement &placement)
{
  const std::vector<bool> belongs = pixels_of(image, piece);
  const int               width   = piece.upper[0] - piece.lower[0] + 1,
            height                = piece.upper[1] - piece.lower[1] + 1;
  // Beyond it distances are less exact; contact asks for them some cells away.
  const int  margin = 8 + std::max(width, height) / 8;
  Lattice<2> lattice({placement.centre({{0, 0}}), placement.pixel_size, unbounded_box<2>()},
                     {{piece.lower[0] - margin, piece.lower[1] - margin}},
                     {{width + 2 * margin, height + 2 * margin}});
  std::fill(lattice.values().begin(), lattice.values().end(), 1.);
  for (int j = 0, k = 0; j < height; ++j)
    for (int i = 0; i < width; ++i, ++k)
      if (belongs[k])
        lattice({{piece.lower[0] + i, piece.lower[1] + j}}) = -1.;
  return lattice;
}

/** The areas below three levels of the cubic interpolant, of parts of a quarter of the spacing. */
std::array<double, 3>
areas_below(const Lattice<2> &lattice, const std::array<double, 3> &levels)
{
  constexpr int         n_parts = 4;
  const double          spacing = lattice.spacing(), near = 1.5 * spacing;
  std::array<double, 3> areas{};
  for (int j = 0; j + 1 < lattice.n_nodes()[1]; ++j)
    for (int i = 0; i + 1 < lattice.n_nodes()[0]; ++i)
      {
        const typename Lattice<2>::Index corner{{lattice.lower()[0] + i, lattice.lower()[1] + j}};
        std::optional<Lattice<2>>        parts;
        for (unsigned int l = 0; l < levels.size(); ++l)
          {
            const double value = lattice(corner) - levels[l];
            if (value < -near)
              areas[l] += spacing * spacing;
            if (std::abs(value) > near)
              continue;
            if (!parts)
              {
                parts.emplace(
                  LatticeFrame<2>{lattice.node(corner), spacing / n_parts, lattice.frame().box},
                  Lattice<2>::Index{{0, 0}}, Lattice<2>::Index{{n_parts + 1, n_parts + 1}});
                for (std::size_t k = 0; k < parts->values().size(); ++k)
                  parts->values()[k] = lattice.value(parts->node(parts->index(k)), 3);
              }
            areas[l] += volume_below(*parts, levels[l]);
          }
      }
  return areas;
}

/** Shifts distances so that the area of their cubic interpolant is `area`. */
void
keep_area(Lattice<2> &lattice, const double area)
{
  const double step = 0.1 * lattice.spacing();
  for (unsigned int iteration = 0; iteration < 2; ++iteration)
    {
      const auto   areas  = areas_below(lattice, {{-step, 0., step}});
      const double excess = areas[1] - area, perimeter = (areas[2] - areas[0]) / (2 * step);
      for (double &value : lattice.values())
        value += excess / perimeter;
    }
}

/** Throws UserError unless the label is still there, in one piece. */
void
require_one_piece(const Lattice<2> &lattice, const LabelPiece &piece,
                  const LabelPlacement &placement, const std::string &where)
{
  const std::string begin = "shrunk by half of Gap = " + short_number(placement.gap) + ", label "
                            + std::to_string(piece.label) + ", at "
                            + short_place(placement.centre(piece.first)) + ", ",
                    remedy = "choose a smaller Gap, or leave the label out (Labels, Smallest area)";
  require(has_contour(lattice), where, begin + "is nothing", remedy);
  require(negative_pieces(lattice).n == 1, where, begin + "falls into pieces", remedy);
}
} // namespace

ShapePointer<2>
shape_of_label(const LabelImage &image, const LabelPiece &piece, const LabelPlacement &placement,
               const std::string &where)
{
  const Lattice<2> signs   = signs_of(image, piece, placement);
  Lattice<2>       lattice = signs;
  for (unsigned int n_passes = placement.smoothing + 1; n_passes-- > 0;)
    {
      lattice = signs;
      distance_from_labels(lattice, n_passes);
      if (negative_pieces(lattice).n == 1)
        break;
    }
  keep_area(lattice, piece.n_pixels * placement.pixel_size * placement.pixel_size);
  if (placement.gap > 0.)
    {
      for (double &value : lattice.values())
        value += 0.5 * placement.gap;
      require_one_piece(lattice, piece, placement, where);
    }
  return std::make_unique<LatticeShape<2>>(std::move(lattice));
}
} // namespace scree
