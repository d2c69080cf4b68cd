#pragma once

#include <scree/bodies/body.h>
#include <scree/discretization/cut_quadrature.h>
#include <scree/discretization/displacement_space.h>
#include <scree/discretization/level_set_nodes.h>

namespace scree
{
/**
 * The region that an assembly of grains fills: the smallest box, with edges along the axes, around
 * all deformable bodies, but where a flat face of a rigid body bounds them up to that face. So it
 * is the room between flat walls, which may lean, and grains that rattle there do not change it.
 * A face bounds them if none of them is behind it by more than two finest cells, and its body is at
 * least half as wide as they are. Walls that lean by more than 25 degrees cut the box only.
 */
template <int dim>
struct AssemblyRegion
{
  double                 volume = 0.; //!< [L^dim]
  dealii::Tensor<1, dim> lengths;     //!< along the axes, through the middle [L]
};

/** Where the ghosted displacement `u` of the step brings the bodies (collective). */
template <int dim>
AssemblyRegion<dim>
assembly_region(const DisplacementSpace<dim> &space, const LevelSetNodes<dim> &level_set_nodes,
                const std::vector<Body<dim>> &bodies, const CutQuadrature<dim> &quadrature,
                const dealii::TrilinosWrappers::MPI::Vector &u);
} // namespace scree
