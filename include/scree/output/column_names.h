#pragma once

#include <deal.II/base/symmetric_tensor.h>

#include <string>
#include <vector>

namespace scree
{
inline const std::vector<std::string> axes = {"x", "y", "z"};

/** Names of the components of a vector: prefix_x, prefix_y and in 3D prefix_z. */
template <int dim>
void
add_vector_names(const std::string &prefix, std::vector<std::string> &names)
{
  for (unsigned int d = 0; d < dim; ++d)
    names.push_back(prefix + "_" + axes[d]);
}

/** Names of the components of a moment or a rotation; 2D: only prefix_z. */
template <int dim>
void
add_axial_names(const std::string &prefix, std::vector<std::string> &names)
{
  for (unsigned int d = dim == 2 ? 2 : 0; d < 3; ++d)
    names.push_back(prefix + "_" + axes[d]);
}

/** Column names of a force and its moment. */
template <int dim>
void
add_resultant_names(const std::string &prefix, std::vector<std::string> &names)
{
  add_vector_names<dim>(prefix + ".force", names);
  add_axial_names<dim>(prefix + ".moment", names);
}

/** Column names of where a rigid body is and what drives it. */
template <int dim>
void
add_rigid_names(const std::string &prefix, std::vector<std::string> &names)
{
  add_vector_names<dim>(prefix + ".displacement", names);
  add_axial_names<dim>(prefix + ".rotation", names);
  add_resultant_names<dim>(prefix, names);
}

/** Names of the components of a symmetric tensor: prefix_xx, prefix_xy, ... */
template <int dim>
void
add_symmetric_names(const std::string &prefix, std::vector<std::string> &names)
{
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = i; j < dim; ++j)
      names.push_back(prefix + "_" + axes[i] + axes[j]);
}

/** Its components in that order. */
template <int dim>
void
add_symmetric(const dealii::SymmetricTensor<2, dim> &tensor, std::vector<double> &values)
{
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = i; j < dim; ++j)
      values.push_back(tensor[i][j]);
}
} // namespace scree
