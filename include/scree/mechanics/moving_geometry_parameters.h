#pragma once

#include <scree/base/enum_names.h>
#include <scree/discretization/discretization_parameters.h>
#include <scree/level_set/advection.h>
#include <scree/parameters/section.h>

namespace scree
{
/** Where material points start. */
enum class PointPlaces
{
  sub_grid,         // m^dim per cell
  quadrature_points // of the cut cells
};

/** Where the deformation gradient at the start of a step comes from. */
enum class DeformationTransfer
{
  reference_map,       // F = (I - grad u)^{-1}, u = x - X fitted to the points
  moving_least_squares // of the F that the points carry
};

/** Where the laws of the bulk are integrated. */
enum class BulkIntegration
{
  cut_cells,      // at the Gauss points of cut cells
  material_points // at the material points, with their volumes
};

/** Section Moving geometry: whether and how bodies move through the grid. */
struct MovingGeometryParameters
{
  bool                is_moving            = false;
  PointPlaces         places               = PointPlaces::sub_grid;
  unsigned int        points_per_direction = 0; //!< of a cell; 0: degree + 1
  BulkIntegration     integration          = BulkIntegration::cut_cells;
  DeformationTransfer deformation          = DeformationTransfer::reference_map;
  int                 degree_of_fits       = as_displacement; //!< of moving least squares
  double              support              = 1.75;            //!< of moving least squares, in cells
  IncrementMotion     motion               = IncrementMotion::reference_map;
  double              slope_tolerance      = 0.1;   //!< of ||grad phi| - 1| before reinitialisation
  double              largest_motion       = 2.;    //!< of a body in a step, in finest cells
  double              largest_slip         = 1.;    //!< of contact in a step, in finest cells
  bool                may_leave_box        = false; //!< whether bodies may be cut off by the box

  void declare(ParameterSection &section);

  /** m of the m^dim points of a cell, with displacements of a degree. */
  unsigned int points_of_cell(const unsigned int degree) const
  {
    return points_per_direction > 0 ? points_per_direction : degree + 1;
  }

  /** Of moving least squares, with displacements of a degree. */
  unsigned int least_squares_degree(const unsigned int degree) const
  {
    return degree_of_fits == as_displacement ? degree : degree_of_fits;
  }

private:
  /** Records a problem with `integration`, or what it costs. */
  void check_integration(ParameterSection &section) const;
};
} // namespace scree
