#include <scree/mechanics/moving_geometry_parameters.h>

namespace scree
{
void
MovingGeometryParameters::declare(ParameterSection &section)
{
  const EnumNames<bool>        updates = {{false, "none"}, {true, "every step"}};
  const EnumNames<PointPlaces> place_names
    = {{PointPlaces::sub_grid, "sub-grid"}, {PointPlaces::quadrature_points, "quadrature points"}};
  const EnumNames<BulkIntegration> integration_names
    = {{BulkIntegration::cut_cells, "cut cells"},
       {BulkIntegration::material_points, "material points"}};
  const EnumNames<DeformationTransfer> deformation_names
    = {{DeformationTransfer::reference_map, "reference map"},
       {DeformationTransfer::moving_least_squares, "moving least squares"}};
  const EnumNames<IncrementMotion> motion_names
    = {{IncrementMotion::reference_map, "reference map"},
       {IncrementMotion::semi_lagrangian, "semi-Lagrangian"},
       {IncrementMotion::map_velocity, "map velocity"},
       {IncrementMotion::frozen_velocity, "frozen velocity"}};
  section.entry("Update", is_moving, updates,
                "none: displacements are small, the geometry stays; every step: bodies, material "
                "points and contact move after every load step, laws and contact are those of "
                "finite deformation.");
  section.entry("Points", places, place_names,
                "Where material points start: on a sub-grid of every cell, or at the quadrature "
                "points of the body.");
  section.entry("Points per direction", points_per_direction, dealii::Patterns::Integer(0, 10),
                "Of the sub-grid, m^dim points in a cell; 0: Degree + 1.");
  section.entry("Bulk integration", integration, integration_names,
                "Where the laws are integrated. cut cells: at Gauss points, up to the boundary; "
                "histories come from the material points. material points: at these, with their "
                "volumes and the F that they carry, as in the material point method: nothing is "
                "transferred, but cells with few points are integrated badly.");
  section.entry("Deformation gradient", deformation, deformation_names,
                "At the start of a step. reference map: from the displacement x - X of the points, "
                "fitted in the finite element space; moving least squares: of the gradients that "
                "the points carry.");
  section.entry("Least squares degree", degree_of_fits,
                EnumNames<int>{{as_displacement, "as displacement"}, {0, "0"}, {1, "1"}, {2, "2"}},
                "Of the polynomials of moving least squares.");
  section.entry("Support", support, dealii::Patterns::Double(1., 5.),
                "Radius of moving least squares, in cells or distances of points [-].");
  section.entry(
    "Level set motion", motion, motion_names,
    "reference map: the image of the initial level set by the displacement of the material "
    "points, no errors of steps add up; semi-Lagrangian: traced back through the increment, no "
    "bound on the step; map "
    "velocity: WENO5 with the velocity that belongs to the increment; frozen velocity: "
    "WENO5 with the increment as velocity, wrong for rotations, for comparison only.");
  section.entry("Slope tolerance", slope_tolerance, dealii::Patterns::Double(1e-3, 1.),
                "A level set becomes a distance again where ||grad phi| - 1| exceeds this [-].");
  section.entry("Largest motion", largest_motion, positive_number(),
                "A step in which a deformable body moves farther than this many finest cells is "
                "cut; without inertia a body that nothing holds or presses in the end may move by "
                "1.5 Contact/Shift, if that is more [-].");
  section.entry("Largest slip", largest_slip, positive_number(),
                "A step in which closed contact slides farther than this many finest cells is cut "
                "[-].");
  section.entry("Leaving the box", may_leave_box, {{false, "refused"}, {true, "allowed"}},
                "What happens when a deformable body moves out through a face of the background "
                "box, where its level set is cut off. refused: the run ends. allowed: it goes on, "
                "and the part outside is lost.");
  check_integration(section);
}

void
MovingGeometryParameters::check_integration(ParameterSection &section) const
{
  if (integration == BulkIntegration::material_points && !is_moving)
    section.error("Bulk integration", "there are no material points on a fixed geometry",
                  "set Update = every step, or integrate in cut cells");
  else if (integration == BulkIntegration::material_points)
    section.warning("Bulk integration",
                    "forces of material points change where these cross cells, which costs "
                    "stiffness in every step (energy.transfer tells how much)",
                    "compare with cut cells, or take fewer steps");
}
} // namespace scree
