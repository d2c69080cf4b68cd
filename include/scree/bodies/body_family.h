#pragma once

#include <scree/geometry/shape_parameters.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace scree
{
/** A family has at most as many bodies: files of a few megabytes can hold more than is meant. */
constexpr std::size_t most_members = 100000;

/** A body of a family. */
template <int dim>
struct FamilyMember
{
  std::string                        name;          //!< what follows "family-", as 0017
  std::function<ShapePointer<dim>()> make_shape;    //!< may throw UserError
  std::string                        material = {}; //!< empty: that of the section
  /** Makes what a section Shape says about it; empty: none can. */
  std::function<ShapeParameters<dim>()> listed_shape = {};
};

/** The member whose shape `shape` describes. */
template <int dim>
FamilyMember<dim> member_of_shape(const std::string &name, const ShapeParameters<dim> &shape,
                                  const std::string &material = "");

/**
 * A way to make many bodies of one section of Bodies, by entry Family and a subsection of its own.
 * They share what else the section says. A new one is a function that makes its FamilyKind, and a
 * line in registered_families().
 */
template <int dim>
struct FamilyKind
{
  std::string name;        //!< in entry Family
  std::string section;     //!< of its entries
  std::string description; //!< of the section

  /** Whether section Shape describes what the family is made of. */
  bool takes_shape;

  /**
   * Declares the entries and makes the members. Problems are recorded, or thrown as UserError; then
   * the members count for nothing.
   */
  std::vector<FamilyMember<dim>> (*declare)(const ParameterSection     &section,
                                            const ShapeParameters<dim> &shape);
};

/** All kinds, in the order of the documentation. */
template <int dim>
const std::vector<FamilyKind<dim>> &registered_families();

/** Declares entry Family. Returns the kind that is chosen, null for a single body. */
template <int dim>
const FamilyKind<dim> *declare_family_kind(const ParameterSection &section);

/**
 * Declares the subsection of the family, and records those of other kinds. Returns its members, at
 * least one; nothing for a single body.
 */
template <int dim>
std::optional<std::vector<FamilyMember<dim>>> declare_members(const ParameterSection     &section,
                                                              const FamilyKind<dim>      *family,
                                                              const ShapeParameters<dim> &shape);

/** Numbers as names of members: 17 becomes "0017", which sorts up to 9999. */
std::string member_name(const std::size_t number);
} // namespace scree
