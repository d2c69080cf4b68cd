#pragma once

#include <scree/discretization/point_evaluator.h>

#include <vector>

namespace scree
{
/** The mass of the deformable bodies on this process: points of owned cells that carry it. */
template <int dim>
struct MassPoints
{
  std::vector<PointInCell<dim>>   places;
  std::vector<dealii::Point<dim>> positions; //!< at the start of the step [L]
  std::vector<double>             masses;    //!< [M], per thickness in 2D
};
} // namespace scree
