#include <scree/bodies/array_family.h>
#include <scree/geometry/moved_shape.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>

namespace scree
{
using namespace dealii;

namespace
{
/** Section Array of a family. */
template <int dim>
struct ArrayParameters
{
  std::vector<unsigned int> counts;
  std::vector<double>       spacing;
  double                    shift = 0.;

  /** Whether there is no problem. */
  bool declare(const ParameterSection &section);
};

template <int dim>
bool
ArrayParameters<dim>::declare(const ParameterSection &section)
{
  section.entry("Counts", counts, "Numbers of copies along x, y (and z).");
  section.entry("Spacing", spacing,
                "Distances of copies along x, y (and z); the first stands where Shape says [L].");
  section.entry(
    "Shift", shift,
    "Moves every other row along x, in 3D every other layer too: half the spacing makes "
    "triangles of squares [L].");
  const std::string numbers = "give " + std::to_string(dim) + " numbers, separated by commas";
  if (counts.size() != dim || std::count(counts.begin(), counts.end(), 0u) > 0)
    section.error("Counts", "needs " + std::to_string(dim) + " numbers greater than zero", numbers);
  else if (spacing.size() != dim)
    section.error("Spacing", "needs " + std::to_string(dim) + " lengths", numbers);
  else
    return true;
  return false;
}

template <int dim>
std::vector<FamilyMember<dim>>
declare_array(const ParameterSection &section, const ShapeParameters<dim> &shape)
{
  ArrayParameters<dim> p;
  if (!p.declare(section))
    return {};
  double n_copies = 1.;
  for (const unsigned int count : p.counts)
    n_copies *= count;
  if (n_copies > most_members)
    {
      section.error("Counts", "these are too many bodies",
                    "make at most " + std::to_string(most_members));
      return {};
    }
  // All copies refer to one shape, made when the first is needed.
  const auto                     original = std::make_shared<std::shared_ptr<const Shape<dim>>>();
  const auto                     of_one   = std::make_shared<const ShapeParameters<dim>>(shape);
  std::vector<FamilyMember<dim>> members;
  for (std::size_t n = 0; n < n_copies; ++n)
    {
      std::size_t    rest = n, rows = n / p.counts[0];
      Tensor<1, dim> translation;
      for (unsigned int d = 0; d < dim; ++d)
        {
          translation[d] = rest % p.counts[d] * p.spacing[d];
          rest /= p.counts[d];
        }
      translation[0] += rows % 2 * p.shift;
      members.push_back(
        {member_name(n + 1), [original, of_one, translation]() -> ShapePointer<dim> {
           if (!*original)
             *original = make_shape(*of_one);
           return std::make_unique<MovedShape<dim>>(*original, unit_symmetric_tensor<dim>(),
                                                    Point<dim>(), translation);
         }});
      if (shape.parts.empty()) // parts are in no list
        members.back().listed_shape = [of_one, translation]() {
          ShapeParameters<dim> moved = *of_one;
          moved.translation.resize(dim);
          for (unsigned int d = 0; d < dim; ++d)
            moved.translation[d] += translation[d];
          return moved;
        };
    }
  return members;
}
} // namespace

template <int dim>
FamilyKind<dim>
array_family()
{
  return {"array", "Array", "Copies of the shape on a lattice.", true, declare_array<dim>};
}

template FamilyKind<2> array_family();
template FamilyKind<3> array_family();
} // namespace scree
