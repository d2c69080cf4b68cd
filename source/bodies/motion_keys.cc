#include <scree/bodies/motion_keys.h>
#include <scree/bodies/rigid_body.h>

namespace scree
{
template <int dim>
std::string
motion_key(const unsigned int component, const bool of_load)
{
  const std::string name = rigid_component_names<dim>()[component];
  if (component < dim)
    return (of_load ? "Force " : "Displacement ") + name;
  return (of_load ? "Moment" : "Rotation") + name.substr(std::string("rotation").size());
}

template std::string motion_key<2>(const unsigned int, const bool);
template std::string motion_key<3>(const unsigned int, const bool);
} // namespace scree
