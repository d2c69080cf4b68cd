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

template <int dim>
Point<dim>
LabelPlacement<dim>::centre(const typename LabelImage<dim>::Pixel &pixel) const
{
  Point<dim> result = lower_corner;
  for (unsigned int d = 0; d < dim; ++d)
    result[d] += pixel_size * (pixel[d] + 0.5);
  return result;
}

template <int dim>
double
LabelPlacement<dim>::volume(const LabelPiece<dim> &piece) const
{
  return piece.n_pixels * std::pow(pixel_size, dim);
}

namespace
{
/** -1 at the pixels of a piece and 1 around them, nodes at their centres. */
template <int dim>
Lattice<dim>
signs_of(const LabelImage<dim> &image, const LabelPiece<dim> &piece,
         const LabelPlacement<dim> &placement)
{
  int widest = 0;
  for (unsigned int d = 0; d < dim; ++d)
    widest = std::max(widest, piece.upper[d] - piece.lower[d] + 1);
  // Beyond it distances are less exact; contact asks for them some cells away.
  const int            margin = 8 + widest / 8;
  std::array<int, dim> lower, n_nodes;
  for (unsigned int d = 0; d < dim; ++d)
    {
      lower[d]   = piece.lower[d] - margin;
      n_nodes[d] = piece.upper[d] - piece.lower[d] + 1 + 2 * margin;
    }
  Lattice<dim> lattice({placement.centre({}), placement.pixel_size, unbounded_box<dim>()}, lower,
                       n_nodes);
  std::fill(lattice.values().begin(), lattice.values().end(), 1.);
  for (const auto &pixel : list_of_pixels(image, piece))
    lattice(pixel) = -1.;
  return lattice;
}

/**
 * The volumes below three levels of the cubic interpolant, of parts of a quarter of the spacing
 * (a third in three dimensions).
 */
template <int dim>
std::array<double, 3>
volumes_below(const Lattice<dim> &lattice, const std::array<double, 3> &levels)
{
  using Index           = typename Lattice<dim>::Index;
  constexpr int n_parts = dim == 2 ? 4 : 3;
  const double  spacing = lattice.spacing(), near = (dim == 2 ? 1.5 : 1.8) * spacing,
               of_cell = std::pow(spacing, dim);
  std::array<double, 3> volumes{};
  Index                 n_of_parts;
  n_of_parts.fill(n_parts + 1);
  for (std::size_t k = 0; k < lattice.values().size(); ++k)
    {
      const Index corner = lattice.index(k);
      bool        is_end = false;
      for (unsigned int d = 0; d < dim; ++d)
        is_end = is_end || corner[d] + 1 == lattice.lower()[d] + lattice.n_nodes()[d];
      if (is_end)
        continue;
      std::optional<Lattice<dim>> parts;
      for (unsigned int l = 0; l < levels.size(); ++l)
        {
          const double value = lattice.values()[k] - levels[l];
          if (value < -near)
            volumes[l] += of_cell;
          if (std::abs(value) > near)
            continue;
          if (!parts)
            {
              parts.emplace(
                LatticeFrame<dim>{lattice.node(corner), spacing / n_parts, lattice.frame().box},
                Index{}, n_of_parts);
              for (std::size_t i = 0; i < parts->values().size(); ++i)
                parts->values()[i] = lattice.value(parts->node(parts->index(i)), 3);
            }
          volumes[l] += volume_below(*parts, levels[l]);
        }
    }
  return volumes;
}

/** Shifts distances so that the volume of their cubic interpolant is `volume`. */
template <int dim>
void
keep_volume(Lattice<dim> &lattice, const double volume)
{
  const double step = 0.1 * lattice.spacing();
  for (unsigned int iteration = 0; iteration < 2; ++iteration)
    {
      const auto   volumes = volumes_below<dim>(lattice, {{-step, 0., step}});
      const double excess = volumes[1] - volume, surface = (volumes[2] - volumes[0]) / (2 * step);
      for (double &value : lattice.values())
        value += excess / surface;
    }
}

/** A distance from labels by so many passes, or fewer where they would cut a neck. */
template <int dim>
Lattice<dim>
smoothed(const Lattice<dim> &signs, const unsigned int most_passes)
{
  Lattice<dim> result = signs;
  for (unsigned int n_passes = most_passes + 1; n_passes-- > 0;)
    {
      result = signs;
      distance_from_labels(result, n_passes);
      if (negative_pieces(result).n == 1)
        break;
    }
  return result;
}

/** Whether two distances differ by at most `tolerance` next to their contours. */
template <int dim>
bool
is_near(const Lattice<dim> &a, const Lattice<dim> &b, const double tolerance)
{
  const double beside = a.spacing() + tolerance;
  for (std::size_t i = 0; i < a.values().size(); ++i)
    if (std::abs(a.values()[i]) < beside && std::abs(a.values()[i] - b.values()[i]) > tolerance)
      return false;
  return true;
}

/** A distance from the labels of `n_pixels`, see shape_of_label(). */
template <int dim>
Lattice<dim>
smoothed_by_default(const Lattice<dim> &signs, const std::size_t n_pixels)
{
  constexpr unsigned int few_passes = 4;
  constexpr double       tolerance  = 0.25; // pixels
  Lattice<dim>           result     = smoothed(signs, few_passes);
  const double           unit_ball  = dim == 2 ? numbers::PI : 4. / 3. * numbers::PI,
               radius               = std::pow(n_pixels / unit_ball, 1. / dim);
  const auto n_passes               = std::lround(2.5 * std::max(0., radius - 3.));
  if (n_passes <= few_passes)
    return result;
  Lattice<dim> smooth = signs;
  distance_from_labels(smooth, n_passes, true);
  return is_near(result, smooth, tolerance * signs.spacing()) ? smooth : result;
}

/** Throws UserError unless the label is still there, in one piece. */
template <int dim>
void
require_one_piece(const Lattice<dim> &lattice, const LabelPiece<dim> &piece,
                  const LabelPlacement<dim> &placement, const std::string &where)
{
  const std::string begin = "shrunk by half of Gap = " + short_number(placement.gap) + ", label "
                            + std::to_string(piece.label) + ", at "
                            + short_place(placement.centre(piece.first)) + ", ",
                    remedy = "choose a smaller Gap, or leave the label out (Labels, Smallest "
                             + std::string(dim == 2 ? "area)" : "volume)");
  require(has_contour(lattice), where, begin + "is nothing", remedy);
  require(negative_pieces(lattice).n == 1, where, begin + "falls into pieces", remedy);
}
} // namespace

template <int dim>
ShapePointer<dim>
shape_of_label(const LabelImage<dim> &image, const LabelPiece<dim> &piece,
               const LabelPlacement<dim> &placement, const std::string &where)
{
  const Lattice<dim> signs   = signs_of(image, piece, placement);
  Lattice<dim>       lattice = placement.smoothing < 0 ? smoothed_by_default(signs, piece.n_pixels)
                                                       : smoothed(signs, placement.smoothing);
  keep_volume(lattice, placement.volume(piece));
  if (placement.gap > 0.)
    {
      for (double &value : lattice.values())
        value += 0.5 * placement.gap;
      require_one_piece(lattice, piece, placement, where);
    }
  return std::make_unique<LatticeShape<dim>>(std::move(lattice));
}

#define SCREE_INSTANTIATE(dim)                                                                \
  template struct LabelPlacement<dim>;                                                        \
  template ShapePointer<dim> shape_of_label(const LabelImage<dim> &, const LabelPiece<dim> &, \
                                            const LabelPlacement<dim> &, const std::string &);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
