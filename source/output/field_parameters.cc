#include <scree/output/field_parameters.h>

#include <algorithm>
#include <utility>

namespace scree
{
void
FieldParameters::declare(ParameterSection &section)
{
  section.entry(
    "Fields", chosen,
    dealii::Patterns::Selection("stress|strain|principal stretches|plastic strain|plastic zone|"
                                "strain energy|volume ratio"),
    "Fields of the bodies' VTU besides displacement and body. Stress comes with von Mises and "
    "principal stresses, principal stretches on a moving geometry, plastic strain and the plastic "
    "zone where a material has a yield stress.");
}

bool
FieldParameters::has(const std::string &field) const
{
  return std::find(chosen.begin(), chosen.end(), field) != chosen.end();
}

std::string
FieldParameters::unit(const Quantity quantity, const unsigned int dim) const
{
  if (units.size() != 3 || quantity == Quantity::number)
    return "";
  const std::string &length  = units[0];
  const std::string  power[] = {"", length, length + "^2", length + "^3"};
  switch (quantity)
    {
    case Quantity::area:
      return power[dim - 1];
    case Quantity::volume:
      return power[dim];
    case Quantity::velocity:
      return length + "/time";
    case Quantity::stress:
      return units[1];
    default:
      return length;
    }
}

std::map<std::string, std::string>
unit_labels(const FieldParameters                               &parameters,
            const std::vector<std::pair<std::string, Quantity>> &fields, const unsigned int dim)
{
  std::map<std::string, std::string> labels;
  for (const auto &[name, quantity] : fields)
    {
      const std::string unit   = parameters.unit(quantity, dim);
      const std::string ending = name.substr(name.size() - std::min<std::size_t>(name.size(), 2));
      if (!unit.empty())
        labels[ending == "_x" ? name.substr(0, name.size() - 2) : name] = unit;
    }
  return labels;
}
} // namespace scree
