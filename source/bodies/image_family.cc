#include <scree/base/enum_names.h>
#include <scree/base/exceptions.h>
#include <scree/base/log.h>
#include <scree/bodies/image_family.h>
#include <scree/geometry/label_readers.h>
#include <scree/geometry/label_shape.h>
#include <scree/geometry/shape_family.h>
#include <scree/parameters/data_file.h>

#include <algorithm>
#include <map>
#include <set>

namespace scree
{
using namespace dealii;

namespace
{
constexpr std::size_t largest_image_file = 4000000000; // bytes

/** What becomes of pieces that are too small. */
enum class SmallPieces
{
  drop,
  merge,
  refuse
};

const EnumNames<SmallPieces> small_piece_names
  = {{SmallPieces::drop, "drop"}, {SmallPieces::merge, "merge"}, {SmallPieces::refuse, "refuse"}};

/** What becomes of labels at the edge of the image. */
enum class CutLabels
{
  keep,
  drop
};

const EnumNames<CutLabels> cut_label_names = {{CutLabels::keep, "keep"}, {CutLabels::drop, "drop"}};

/** Section Image of a family. */
template <int dim>
struct ImageParameters
{
  using Pixel = typename LabelImage<dim>::Pixel;

  std::string               file, bytes, path;
  LabelPlacement<dim>       placement;
  std::vector<unsigned int> first_pixel, last_pixel;
  std::vector<unsigned int> labels;
  double                    smallest_volume = 0.;
  SmallPieces               small_pieces    = SmallPieces::drop;
  CutLabels                 cut_labels      = CutLabels::keep;

  void declare(const ParameterSection &section);

  /** "label 17 at (0.5, 1)". */
  std::string name_of(const LabelPiece<dim> &piece) const
  {
    return "label " + std::to_string(piece.label) + " at "
           + short_place(placement.centre(piece.first));
  }

  bool is_small(const LabelPiece<dim> &piece) const
  {
    return placement.volume(piece) < smallest_volume;
  }
};

/** "area" in two dimensions. */
template <int dim>
std::string
volume_name()
{
  return dim == 2 ? "area" : "volume";
}

template <int dim>
void
ImageParameters<dim>::declare(const ParameterSection &section)
{
  const std::string unit = dim == 2 ? " [L^2]." : " [L^3].";
  path                   = section.path();
  placement.pixel_size   = unset_number;
  bytes                  = read_data_file(section, "File", file, largest_image_file, "labels",
                         dim == 2 ? "Label image: PNG, PGM, TIFF, NRRD or MetaImage; 0 lies "
                                                     "between the bodies."
                                                   : "Volume of labels: TIFF of several pages, NRRD or MetaImage; 0 "
                                                     "lies between the bodies.",
                                          [](const std::string &header, const std::string &name) {
                           return with_data_attached(header, name, largest_image_file);
                         });
  section.entry("Pixel size", placement.pixel_size, positive_number(),
                "Edge of a pixel [L]; by default what the file tells (NRRD, MetaImage).");
  section.entry("Lower corner", placement.lower_corner,
                "Where the lower left corner of the image lies, or of the part of it [L].");
  section.entry("First pixel", first_pixel,
                "A part of the image: its first pixel in each direction, from 0 at the lower left "
                "corner of the image.");
  section.entry("Last pixel", last_pixel, "Its last pixel in each direction.");
  section.entry("Labels", labels, "The labels that become bodies; none: all but 0.");
  section.entry("Smallest " + volume_name<dim>(), smallest_volume, dealii::Patterns::Double(0.),
                "Pieces of labels with less " + volume_name<dim>() + " are no bodies" + unit);
  section.entry("Small pieces", small_pieces, small_piece_names,
                "What happens if there are such: they are left out and told, join the label that "
                "they share most sides of pixels with, or are refused.");
  section.entry("Cut labels", cut_labels, cut_label_names,
                "Whether labels at the edge of the image, or of the part of it, become bodies.");
  section.entry("Smoothing", placement.smoothing, dealii::Patterns::Integer(-1, 100),
                "Passes n of smoothing, which rounds what is smaller than sqrt(n/2) pixels; the "
                  + volume_name<dim>()
                  + " of each label stays. -1: 4, but more of labels without corners, whose steps "
                    "of pixels are wide.");
  section.entry("Gap", placement.gap, dealii::Patterns::Double(0.),
                "Every outline moves inwards by half of it, so that labels that touch are so far "
                "apart [L].");
}

/** The part of the image that entries First pixel and Last pixel choose. */
template <int dim>
LabelImage<dim>
chosen_part(const ImageParameters<dim> &p, LabelImage<dim> image)
{
  std::array<int, dim>       lower = {}, upper = image.last_pixel();
  const std::array<int, dim> last = upper;
  const auto choose = [&](const std::string &key, const std::vector<unsigned int> &entry,
                          std::array<int, dim> &pixel) {
    require(entry.empty() || entry.size() == dim, p.path + "/" + key,
            std::to_string(entry.size()) + " number(s)",
            "give " + std::to_string(dim) + ", or none for the whole image");
    for (unsigned int d = 0; d < entry.size(); ++d)
      {
        require(entry[d] <= static_cast<unsigned int>(last[d]), p.path + "/" + key,
                std::to_string(entry[d]) + " is not in the image",
                "the last pixel in direction " + std::to_string(d) + " is "
                  + std::to_string(last[d]));
        pixel[d] = entry[d];
      }
  };
  choose("First pixel", p.first_pixel, lower);
  choose("Last pixel", p.last_pixel, upper);
  for (unsigned int d = 0; d < dim; ++d)
    require(lower[d] <= upper[d], p.path + "/Last pixel", "it lies before First pixel",
            "exchange them");
  if (p.first_pixel.empty() && p.last_pixel.empty())
    return image;
  return image.part(lower, upper);
}

/** Gives small pieces to their neighbours, the smallest first. */
template <int dim>
void
merge_small_pieces(const ImageParameters<dim> &p, LabelImage<dim> &image,
                   const ParameterSection &section)
{
  auto pieces = pieces_of(image);
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const auto &a, const auto &b) { return a.n_pixels < b.n_pixels; });
  std::vector<std::string> merged;
  for (const LabelPiece<dim> &piece : pieces)
    if (p.is_small(piece))
      if (const auto label = merge_into_neighbour(piece, image); label != 0)
        merged.push_back(p.name_of(piece) + " (into " + std::to_string(label) + ")");
  if (!merged.empty())
    section.warning("Smallest " + volume_name<dim>(),
                    std::to_string(merged.size()) + " piece(s) of labels are smaller: "
                      + listed(merged) + "; they join their neighbours");
}

/** Whether a piece reaches the edge of the image. */
template <int dim>
bool
is_cut(const LabelPiece<dim> &piece, const LabelImage<dim> &image)
{
  for (unsigned int d = 0; d < dim; ++d)
    if (piece.lower[d] == 0 || piece.upper[d] == image.last_pixel()[d])
      return true;
  return false;
}

/** The pieces that become bodies. What is too small is recorded. */
template <int dim>
std::vector<LabelPiece<dim>>
chosen_pieces(const ImageParameters<dim> &p, const LabelImage<dim> &image,
              const ParameterSection &section)
{
  const std::set<unsigned int> chosen(p.labels.begin(), p.labels.end());
  std::set<unsigned int>       missing = chosen;
  std::vector<LabelPiece<dim>> pieces;
  std::vector<std::string>     small;
  for (const LabelPiece<dim> &piece : pieces_of(image))
    {
      missing.erase(piece.label);
      if (!chosen.empty() && chosen.count(piece.label) == 0)
        continue;
      if (p.cut_labels == CutLabels::drop && is_cut(piece, image))
        continue;
      if (p.is_small(piece))
        small.push_back(p.name_of(piece) + " (" + short_number(p.placement.volume(piece)) + ")");
      else
        pieces.push_back(piece);
    }
  if (!missing.empty())
    section.error("Labels", "label " + std::to_string(*missing.begin()) + " is not in the image",
                  "choose labels that are, or none for all of them");
  const std::string told
    = std::to_string(small.size()) + " piece(s) of labels are smaller: " + listed(small);
  if (!small.empty() && p.small_pieces == SmallPieces::refuse)
    section.error("Smallest " + volume_name<dim>(), told,
                  "set Small pieces = drop, or choose a smaller " + volume_name<dim>());
  else if (!small.empty())
    section.warning("Smallest " + volume_name<dim>(), told + "; they are left out");
  return pieces;
}

/** Throws UserError if a label has several pieces: which of them is the body? */
template <int dim>
void
require_single_pieces(const ImageParameters<dim> &p, const std::vector<LabelPiece<dim>> &pieces)
{
  require(!pieces.empty(), p.path, "no label of the image becomes a body",
          "choose other Labels, or a smaller Smallest " + volume_name<dim>());
  for (std::size_t i = 1; i < pieces.size(); ++i)
    require(pieces[i].label != pieces[i - 1].label, p.path,
            p.name_of(pieces[i]) + " is a piece of " + std::to_string(pieces[i].n_pixels)
              + " pixels (" + volume_name<dim>() + " " + short_number(p.placement.volume(pieces[i]))
              + ") that does not touch the larger one of " + std::to_string(pieces[i - 1].n_pixels)
              + " pixels at " + short_place(p.placement.centre(pieces[i - 1].first)),
            "give the pieces labels of their own, or raise Smallest " + volume_name<dim>()
              + " to leave small ones out");
}

template <int dim>
std::vector<FamilyMember<dim>>
members_of_image(ImageParameters<dim> &p, const ParameterSection &section)
{
  auto image = chosen_part(p, LabelImage<dim>::read(p.bytes, p.file));
  if (std::isnan(p.placement.pixel_size))
    {
      require(image.pixel_size.has_value(), p.path + "/Pixel size", "is needed",
              "give the edge of a pixel: the file does not tell it");
      p.placement.pixel_size = *image.pixel_size;
    }
  if (p.small_pieces == SmallPieces::merge)
    merge_small_pieces(p, image, section);
  const auto pieces = chosen_pieces(p, image, section);
  require_single_pieces(p, pieces);
  const auto                     shared = std::make_shared<const LabelImage<dim>>(std::move(image));
  std::vector<FamilyMember<dim>> members;
  members.reserve(pieces.size());
  for (const LabelPiece<dim> &piece : pieces)
    members.push_back(
      {member_name(piece.label), [shared, piece, placement = p.placement, path = p.path]() {
         return shape_of_label(*shared, piece, placement, path);
       }});
  return members;
}

template <int dim>
std::vector<FamilyMember<dim>>
declare_image(const ParameterSection &section, const ShapeParameters<dim> & /*shape*/)
{
  ImageParameters<dim> p;
  p.declare(section);
  return p.bytes.empty() ? std::vector<FamilyMember<dim>>() : members_of_image(p, section);
}
} // namespace

template <int dim>
FamilyKind<dim>
image_family()
{
  return {"image", "Image", "A label image or volume, each label of which is a body.", false,
          declare_image<dim>};
}

template FamilyKind<2> image_family();
template FamilyKind<3> image_family();
} // namespace scree
