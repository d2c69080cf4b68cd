#pragma once

#include <scree/base/enum_names.h>
#include <scree/geometry/smooth_piece.h>
#include <scree/parameters/section.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/point.h>

#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace scree
{
/** A body's geometry as a level set: negative inside. */
template <int dim>
class Shape
{
public:
  virtual ~Shape() = default;

  /** The signed distance of `x` to the boundary, or another level set if !is_distance(). */
  virtual double signed_distance(const dealii::Point<dim> &x) const = 0;

  /** Whether signed_distance() is a distance everywhere. */
  virtual bool is_distance() const;

  /** A box that contains the shape, `unbounded` in directions without an end. */
  virtual dealii::BoundingBox<dim> bounding_box() const = 0;

  /** Whether the boundary is a single piece without kinks: that of signed_distance(). */
  virtual bool is_smooth() const;

  /**
   * Appends the smooth pieces of the boundary that may pass through the closed `box`: where none
   * does, the box is inside or outside as a whole. Parts of them may not belong to the boundary.
   */
  virtual void append_pieces(const dealii::BoundingBox<dim> &box,
                             std::vector<SmoothPiece<dim>>  &pieces) const;

  static constexpr double unbounded = 1e300;
};

/**
 * The pieces that bound `shape` within `radius` of `x`: one at a point of a face, several at edges
 * and corners, none away from the boundary.
 */
template <int dim>
std::vector<SmoothPiece<dim>> active_pieces(const Shape<dim> &shape, const dealii::Point<dim> &x,
                                            const double radius);

template <int dim>
using ShapePointer = std::unique_ptr<const Shape<dim>>;

/** The kinds of shapes. */
enum class ShapeType
{
  ball,         // centre, radius
  box,          // lower and upper corner
  half_space,   // behind the plane through a point with an outward normal
  ellipse,      // centre, semi-axes
  ring,         // centre, inner and outer radius
  capsule,      // the points within a radius of a segment
  polygon,      // vertices, 2D only
  superellipse, // |x/a|^n + |y/b|^n (+ |z/c|^n) < 1
  expression,   // where a formula is negative
  union_of,     // of the parts
  intersection, // of the parts
  difference    // the first part without the others
};

/** Their names; "disc" and "ellipsoid" are other names of ball and ellipse. */
const EnumNames<ShapeType> &shape_type_names();

/**
 * The parameters of a shape, section "Shape" of a body. A list that is empty and a number that is
 * NaN are unset. All numbers are lengths in the body's reference coordinates unless said.
 */
template <int dim>
struct ShapeParameters
{
  ShapeType                     type = ShapeType::ball;
  std::vector<double>           centre;
  double                        radius = std::numeric_limits<double>::quiet_NaN();
  std::vector<double>           lower_corner;
  std::vector<double>           upper_corner;
  std::vector<double>           point;
  std::vector<double>           normal;
  std::vector<double>           semi_axes;
  double                        inner_radius = std::numeric_limits<double>::quiet_NaN();
  std::vector<double>           first_point;
  std::vector<double>           second_point;
  std::vector<dealii::Point<2>> vertices;
  double                        exponent = std::numeric_limits<double>::quiet_NaN();
  std::string                   expression;
  bool                          expression_is_distance = false;
  double                        rotation_angle         = 0; // degrees, counter-clockwise
  std::vector<double>           rotation_centre;            // unset: the origin
  std::vector<double>           rotation_axis;              // 3D
  std::vector<double>           translation;                // after the rotation

  std::vector<std::pair<std::string, ShapeParameters<dim>>> parts;

  /**
   * Declares and reads the entries. Records as problems of the section: entries missing for the
   * type, entries the type does not use, radii and axes that are not positive, corners in the wrong
   * order, a zero normal, polygons with less than 3 vertices or crossing sides, formulas that do
   * not parse.
   */
  void declare(const ParameterSection &section);
};

/** The shape described by parameters that declare() found no problem with. */
template <int dim>
ShapePointer<dim> make_shape(const ShapeParameters<dim> &parameters);
} // namespace scree
