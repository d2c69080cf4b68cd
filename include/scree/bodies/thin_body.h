#pragma once

#include <scree/bodies/body.h>

#include <optional>

namespace scree
{
/**
 * The point next to `x` on the side of a thin body that looks in `direction`, where a side that
 * looks away is within `reach` [L] too: there the level set of the lattice knows them badly. None
 * if the body is not thin at `x`.
 */
template <int dim>
std::optional<dealii::Point<dim>>
foot_on_thin_body(const Body<dim> &body, const dealii::Point<dim> &x,
                  const dealii::Tensor<1, dim> &direction, const double reach);
} // namespace scree
