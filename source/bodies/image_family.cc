#include <scree/base/enum_names.h>
#include <scree/base/exceptions.h>
#include <scree/base/log.h>
#include <scree/bodies/image_family.h>
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
constexpr std::size_t largest_image_file = 256000000; // bytes

/** What becomes of pieces that are too small. */
enum class SmallPieces
{
  drop,
  refuse
};

const EnumNames<SmallPieces> small_piece_names
  = {{SmallPieces::drop, "drop"}, {SmallPieces::refuse, "refuse"}};

/** Section Image of a family. */
struct ImageParameters
{
  std::string               file, bytes, path;
  LabelPlacement            placement;
  std::vector<unsigned int> labels;
  double                    smallest_area = 0.;
  SmallPieces               small_pieces  = SmallPieces::drop;

  void declare(const ParameterSection &section);

  double area(const LabelPiece &piece) const
  {
    return piece.n_pixels * placement.pixel_size * placement.pixel_size;
  }

  /** "label 17 at (0.5, 1)". */
  std::string name_of(const LabelPiece &piece) const
  {
    return "label " + std::to_string(piece.label) + " at "
           + short_place(placement.centre(piece.first));
  }
};

void
ImageParameters::declare(const ParameterSection &section)
{
  path                 = section.path();
  placement.pixel_size = unset_number;
  bytes                = read_data_file(
                   section, "File", file, largest_image_file, "labels",
                   "Label image: PNG or PGM, grey values of 8 or 16 bits; 0 lies between the bodies.");
  section.entry("Pixel size", placement.pixel_size, positive_number(), "Edge of a pixel [L].");
  section.entry("Lower corner", placement.lower_corner,
                "Where the lower left corner of the image lies [L].");
  section.entry("Labels", labels, "The labels that become bodies; none: all but 0.");
  section.entry("Smallest area", smallest_area, dealii::Patterns::Double(0.),
                "Pieces of labels with less area are no bodies [L^2].");
  section.entry("Small pieces", small_pieces, small_piece_names,
                "What happens if there are such: they are left out and told, or refused.");
  section.entry("Smoothing", placement.smoothing, dealii::Patterns::Integer(0, 100),
                "Passes n of smoothing, which rounds what is smaller than sqrt(n/2) pixels; the "
                "area of each label stays.");
  section.entry("Gap", placement.gap, dealii::Patterns::Double(0.),
                "Every outline moves inwards by half of it, so that labels that touch are so far "
                "apart [L].");
  if (std::isnan(placement.pixel_size))
    section.error("Pixel size", "is needed", "give the edge of a pixel");
}

/** The pieces that become bodies. What is too small is recorded. */
std::vector<LabelPiece>
chosen_pieces(const ImageParameters &p, const LabelImage &image, const ParameterSection &section)
{
  const std::set<unsigned int> chosen(p.labels.begin(), p.labels.end());
  std::set<unsigned int>       missing = chosen;
  std::vector<LabelPiece>      pieces;
  std::vector<std::string>     small;
  for (const LabelPiece &piece : pieces_of(image))
    {
      missing.erase(piece.label);
      if (!chosen.empty() && chosen.count(piece.label) == 0)
        continue;
      if (p.area(piece) < p.smallest_area)
        small.push_back(p.name_of(piece) + " (" + short_number(p.area(piece)) + ")");
      else
        pieces.push_back(piece);
    }
  if (!missing.empty())
    section.error("Labels", "label " + std::to_string(*missing.begin()) + " is not in the image",
                  "choose labels that are, or none for all of them");
  const std::string told
    = std::to_string(small.size()) + " piece(s) of labels are smaller: " + listed(small);
  if (!small.empty() && p.small_pieces == SmallPieces::refuse)
    section.error("Smallest area", told, "set Small pieces = drop, or choose a smaller area");
  else if (!small.empty())
    section.warning("Smallest area", told + "; they are left out");
  return pieces;
}

/** Throws UserError if a label has several pieces: which of them is the body? */
void
require_single_pieces(const ImageParameters &p, const std::vector<LabelPiece> &pieces)
{
  require(!pieces.empty(), p.path, "no label of the image becomes a body",
          "choose other Labels, or a smaller Smallest area");
  for (std::size_t i = 1; i < pieces.size(); ++i)
    require(pieces[i].label != pieces[i - 1].label, p.path,
            p.name_of(pieces[i]) + " is a piece of " + std::to_string(pieces[i].n_pixels)
              + " pixels (area " + short_number(p.area(pieces[i]))
              + ") that does not touch the larger one of " + std::to_string(pieces[i - 1].n_pixels)
              + " pixels at " + short_place(p.placement.centre(pieces[i - 1].first)),
            "give the pieces labels of their own, or raise Smallest area to leave small ones out");
}

std::vector<FamilyMember<2>>
members_of_image(const ImageParameters &p, const ParameterSection &section)
{
  const auto image  = std::make_shared<const LabelImage>(LabelImage::read(p.bytes, p.file));
  const auto pieces = chosen_pieces(p, *image, section);
  require_single_pieces(p, pieces);
  std::vector<FamilyMember<2>> members;
  for (const LabelPiece &piece : pieces)
    members.push_back(
      {member_name(piece.label), [image, piece, placement = p.placement, path = p.path]() {
         return shape_of_label(*image, piece, placement, path);
       }});
  return members;
}

template <int dim>
std::vector<FamilyMember<dim>>
declare_image(const ParameterSection &section, const ShapeParameters<dim> & /*shape*/)
{
  ImageParameters p;
  p.declare(section);
  if constexpr (dim == 2)
    {
      if (!p.bytes.empty() && !std::isnan(p.placement.pixel_size))
        return members_of_image(p, section);
    }
  else
    section.error("", "images of labels have two dimensions", "set Dimension = 2");
  return {};
}
} // namespace

template <int dim>
FamilyKind<dim>
image_family()
{
  return {"image", "Image", "A label image, each label of which is a body.", false,
          declare_image<dim>};
}

template FamilyKind<2> image_family();
template FamilyKind<3> image_family();
} // namespace scree
