#include <scree/base/exceptions.h>
#include <scree/bodies/array_family.h>
#include <scree/bodies/image_family.h>
#include <scree/bodies/list_family.h>
#include <scree/bodies/packing_family.h>

namespace scree
{
template <int dim>
const std::vector<FamilyKind<dim>> &
registered_families()
{
  static const std::vector<FamilyKind<dim>> kinds
    = {image_family<dim>(), list_family<dim>(), array_family<dim>(), packing_family<dim>()};
  return kinds;
}

std::string
member_name(const std::size_t number)
{
  constexpr std::size_t n_digits = 4;
  const std::string     digits   = std::to_string(number);
  return std::string(n_digits - std::min(n_digits, digits.size()), '0') + digits;
}

template <int dim>
FamilyMember<dim>
member_of_shape(const std::string &name, const ShapeParameters<dim> &shape,
                const std::string &material)
{
  const auto shared = std::make_shared<const ShapeParameters<dim>>(shape);
  return {name, [shared]() { return make_shape(*shared); }, material,
          [shared]() { return *shared; }};
}

template <int dim>
const FamilyKind<dim> *
declare_family_kind(const ParameterSection &section)
{
  std::vector<std::string> names = {"none"};
  std::string              sections;
  for (const auto &kind : registered_families<dim>())
    {
      names.push_back(kind.name);
      sections += (sections.empty() ? "" : ", ") + kind.section;
    }
  const std::string chosen = section.choice(
    "Family", names[0], names,
    "What the section makes. none: one body. Otherwise many, called NAME-0001 and so on, as the "
    "section of the same name says ("
      + sections + "); they share what else stands here.");
  for (const auto &kind : registered_families<dim>())
    if (kind.name == chosen)
      return &kind;
  return nullptr;
}

namespace
{
template <int dim>
std::vector<FamilyMember<dim>>
members_of(const FamilyKind<dim> &family, const ParameterSection &section,
           const ParameterSection &own, const ShapeParameters<dim> &shape)
{
  std::vector<FamilyMember<dim>> members;
  try
    {
      members = family.declare(own, shape);
      require(members.size() <= most_members, own.path(),
              std::to_string(members.size()) + " bodies are too many",
              "make at most " + std::to_string(most_members));
    }
  catch (const UserError &error)
    {
      section.error(family.section, error.what());
      members.clear();
    }
  if (members.empty()) // two, which contact laws between members find
    for (const unsigned int number : {0, 1})
      members.push_back({member_name(number), nullptr});
  return members;
}
} // namespace

template <int dim>
std::optional<std::vector<FamilyMember<dim>>>
declare_members(const ParameterSection &section, const FamilyKind<dim> *family,
                const ShapeParameters<dim> &shape)
{
  std::optional<std::vector<FamilyMember<dim>>> members;
  for (const auto &kind : registered_families<dim>())
    if (&kind == family || section.is_documentation())
      members
        = members_of(kind, section, section.subsection(kind.section, kind.description), shape);
    else
      section.refuse(kind.section, "the section is not used",
                     "set Family = " + kind.name + ", or remove it");
  return family == nullptr ? std::nullopt : members;
}

#define SCREE_INSTANTIATE(dim)                                                                       \
  template const std::vector<FamilyKind<dim>> &registered_families();                                \
  template FamilyMember<dim>      member_of_shape(const std::string &, const ShapeParameters<dim> &, \
                                                  const std::string &);                              \
  template const FamilyKind<dim> *declare_family_kind(const ParameterSection &);                     \
  template std::optional<std::vector<FamilyMember<dim>>> declare_members(                            \
    const ParameterSection &, const FamilyKind<dim> *, const ShapeParameters<dim> &);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
