#pragma once

#include <scree/geometry/shape_parameters.h>

#include <limits>
#include <string>
#include <vector>

namespace scree
{
/** An entry of section Shape. Families with the same key share the entry. */
struct ShapeEntry
{
  std::string key;
  /**
   * What it is, for the documentation; "%" becomes the first types of all families whose entry has
   * this key and text, as in "a disc or ring".
   */
  std::string text;
  std::string unit;                //!< as "[L]", or empty
  ShapeValue  unset;               //!< tells the kind of value
  bool        is_positive = false; //!< all its numbers must be
  bool        is_required = true;
  bool        is_file     = false; //!< a text that names one
};

constexpr double unset_number = std::numeric_limits<double>::quiet_NaN();

/** A number [L] greater than zero. */
ShapeEntry positive_length(const std::string &key, const std::string &text);

/** A point or, with another unit, a vector. */
ShapeEntry coordinates(const std::string &key, const std::string &text,
                       const std::string &unit = "[L]");

/** What declare_checksum() reads. */
ShapeEntry checksum_entry();

/** The radius of corners, which are sharp where it is not set. */
ShapeEntry corner_radius();

/** The entry of the factor of what a file has; not a number without one. */
ShapeEntry scale_of_file();

/** Positive half widths along the axes. */
ShapeEntry semi_axes_entry();

/**
 * What section Shape offers of a kind of shape, made by a static function `family()` of its class.
 * A new shape is a header and a source with that class, and a line in registered_shapes().
 */
template <int dim>
struct ShapeFamily
{
  /** The values of entry Type that choose it. */
  std::vector<std::string> types;

  /** How the documentation lists them. */
  std::string summary;

  /**
   * Its entries. In the section, one that no family before has stands behind the one before it
   * here; the first, at the end.
   */
  std::vector<ShapeEntry> entries;

  /** Makes the shape, without rotation and translation, from parameters without a problem. */
  ShapePointer<dim> (*make)(const ShapeParameters<dim> &parameters);

  /** Records what else is wrong with the values, any of which may be unset; null: nothing. */
  void (*check)(const ShapeParameters<dim> &parameters, const ParameterSection &section) = nullptr;

  /** Whether the shape is made of the parts. */
  bool takes_parts = false;
};

/** All families, in the order of the documentation. */
template <int dim>
const std::vector<ShapeFamily<dim>> &registered_shapes();
} // namespace scree
