#pragma once

#include <deal.II/base/data_out_base.h>
#include <deal.II/numerics/data_component_interpretation.h>

#include <string>
#include <tuple>
#include <vector>

namespace scree
{
/** Points with values made elsewhere, written by deal.II. Columns NAME_x ... are vectors. */
template <int dim>
class PointPatches : public dealii::DataOutInterface<0, dim>
{
public:
  std::vector<std::string> names;

  /** @param values in the order of `names` */
  void add(const dealii::Point<dim> &position, const std::vector<double> &values)
  {
    dealii::DataOutBase::Patch<0, dim> patch;
    patch.vertices[0] = position;
    patch.patch_index = patches.size();
    patch.data.reinit(values.size(), 1);
    for (unsigned int c = 0; c < values.size(); ++c)
      patch.data(c, 0) = values[c];
    patches.push_back(patch);
  }

protected:
  const std::vector<dealii::DataOutBase::Patch<0, dim>> &get_patches() const override
  {
    return patches;
  }
  std::vector<std::string> get_dataset_names() const override
  {
    return names;
  }
  std::vector<std::tuple<unsigned int, unsigned int, std::string,
                         dealii::DataComponentInterpretation::DataComponentInterpretation>>
  get_nonscalar_data_ranges() const override
  {
    using namespace dealii::DataComponentInterpretation;
    std::vector<std::tuple<unsigned int, unsigned int, std::string, DataComponentInterpretation>>
      ranges;
    for (unsigned int c = 0; c < names.size(); ++c)
      if (c + dim <= names.size() && names[c].size() > 2
          && names[c].substr(names[c].size() - 2) == "_x")
        ranges.emplace_back(c, c + dim - 1, names[c].substr(0, names[c].size() - 2),
                            component_is_part_of_vector);
    return ranges;
  }

private:
  std::vector<dealii::DataOutBase::Patch<0, dim>> patches;
};
} // namespace scree
