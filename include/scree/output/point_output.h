#pragma once

#include <scree/bodies/body.h>
#include <scree/output/field_parameters.h>
#include <scree/points/material_points.h>

#include <string>
#include <vector>

namespace scree
{
/**
 * Writes the material points of all processes where they are to DIR/points_NNNN.vtu or .pvtu, see
 * write_vtu_files(): body, displacement since the start, with inertia velocity, volume, volume
 * ratio det F, Cauchy stress, in 2D with sigma_zz, F, where a material has a yield stress the
 * equivalent plastic strain and the plastic zone, and where laws carry them internal variables (see
 * StepStart::n_internal).
 */
template <int dim>
std::string write_points_vtu(const MaterialPoints<dim>    &points,
                             const std::vector<Body<dim>> &bodies,
                             const FieldParameters &parameters, const bool has_inertia,
                             const MPI_Comm communicator, const std::string &directory,
                             const unsigned int number, const double time);
} // namespace scree
