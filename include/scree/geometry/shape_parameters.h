#pragma once

#include <scree/geometry/shape.h>
#include <scree/parameters/section.h>

#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace scree
{
/**
 * The value of an entry: a number, coordinates, vertices, a text or a flag. Unset are NaN, what is
 * empty, and false.
 */
using ShapeValue
  = std::variant<double, std::vector<double>, std::vector<dealii::Point<2>>, std::string, bool>;

/**
 * The parameters of a shape, section "Shape" of a body. All numbers are lengths in the body's
 * reference coordinates unless said.
 */
template <int dim>
struct ShapeParameters
{
  std::string                       type = "disc";      //!< one of ShapeFamily::types
  std::map<std::string, ShapeValue> values;             //!< by the keys of all families
  double                            rotation_angle = 0; //!< degrees, counter-clockwise
  std::vector<double>               rotation_centre;    //!< empty: the origin
  std::vector<double>               rotation_axis;      //!< 3D
  std::vector<double>               translation;        //!< after the rotation

  std::vector<std::pair<std::string, ShapeParameters<dim>>> parts; //!< with their names

  /**
   * Declares and reads the entries of all families. Records as problems of the section: entries
   * missing for the type, entries the type does not use, coordinates that are not `dim` numbers,
   * numbers that must be positive, and what the family checks.
   *
   * @param instead what makes the shape if the section does not, as "Family = image": then every
   *   entry that is given is a problem
   */
  void declare(const ParameterSection &section, const std::string &instead = "");

  /** Those of a type without any value: what makes shapes sets its entries. */
  static ShapeParameters of_type(const std::string &type);

  /**
   * What was given, as columns and cells of a table: the type, the entries, rotation and
   * translation; coordinates one by one, as "Centre x". Not the parts.
   */
  std::vector<std::pair<std::string, std::string>> cells() const;

  double                               number(const std::string &key) const;
  const std::vector<double>           &coordinates(const std::string &key) const;
  const std::vector<dealii::Point<2>> &vertices(const std::string &key) const;
  const std::string                   &text(const std::string &key) const;
  bool                                 flag(const std::string &key) const;

  /** The `dim` coordinates as a point. */
  dealii::Point<dim> point(const std::string &key) const;
};

/** The shape described by parameters that declare() found no problem with. */
template <int dim>
ShapePointer<dim> make_shape(const ShapeParameters<dim> &parameters);
} // namespace scree
