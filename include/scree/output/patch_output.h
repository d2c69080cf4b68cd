#pragma once

#include <deal.II/base/data_out_base.h>
#include <deal.II/numerics/data_component_interpretation.h>

#include <string>
#include <tuple>
#include <vector>

namespace scree
{
/** Patches made elsewhere, written by deal.II. */
template <int patch_dim, int dim>
class PatchOutput : public dealii::DataOutInterface<patch_dim, dim>
{
public:
  std::vector<dealii::DataOutBase::Patch<patch_dim, dim>> patches;
  std::vector<std::string>                                names; //!< of the rows of their data

  /** The rows from `first` on are the components of a vector. */
  void add_vector(const unsigned int first, const std::string &name)
  {
    vectors.emplace_back(first, first + dim - 1, name,
                         dealii::DataComponentInterpretation::component_is_part_of_vector);
  }

protected:
  using Vectors
    = std::vector<std::tuple<unsigned int, unsigned int, std::string,
                             dealii::DataComponentInterpretation::DataComponentInterpretation>>;

  const std::vector<dealii::DataOutBase::Patch<patch_dim, dim>> &get_patches() const override
  {
    return patches;
  }
  std::vector<std::string> get_dataset_names() const override
  {
    return names;
  }
  Vectors get_nonscalar_data_ranges() const override
  {
    return vectors;
  }

private:
  Vectors vectors;
};

/** Points with values; columns NAME_x ... are vectors. */
template <int dim>
class PointPatches : public PatchOutput<0, dim>
{
public:
  explicit PointPatches(const std::vector<std::string> &columns)
  {
    this->names = columns;
    for (unsigned int c = 0; c + dim <= columns.size(); ++c)
      if (const std::string &name = columns[c];
          name.size() > 2 && name.substr(name.size() - 2) == "_x")
        this->add_vector(c, name.substr(0, name.size() - 2));
  }

  /** @param values in the order of the columns */
  void add(const dealii::Point<dim> &position, const std::vector<double> &values)
  {
    dealii::DataOutBase::Patch<0, dim> patch;
    patch.vertices[0] = position;
    patch.patch_index = this->patches.size();
    patch.data.reinit(values.size(), 1);
    for (unsigned int c = 0; c < values.size(); ++c)
      patch.data(c, 0) = values[c];
    this->patches.push_back(patch);
  }
};
} // namespace scree
