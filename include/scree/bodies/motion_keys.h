#pragma once

#include <string>

namespace scree
{
/**
 * The entry of a parameter file for a component of a rigid body's motion, "Displacement x" or
 * "Rotation" ("Rotation x" in 3D), or of its load, "Force x" or "Moment".
 *
 * @param component of n_rigid_components<dim>, translations first
 */
template <int dim>
std::string motion_key(const unsigned int component, const bool of_load);
} // namespace scree
