#pragma once

#include <deal.II/base/point.h>

namespace scree
{
/** Where the bulk is integrated in an owned active cell. */
template <int dim>
struct CellRule
{
  const dealii::Point<dim> *points; //!< in unit coordinates
  const double             *weights;
  unsigned int              n_points;
  double                    weight_scale; //!< of weights to volumes [L^dim]
};
} // namespace scree
