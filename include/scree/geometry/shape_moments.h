#pragma once

#include <scree/geometry/shape.h>
#include <scree/level_set/lattice.h>

#include <deal.II/base/symmetric_tensor.h>

namespace scree
{
/** Volume, centre and second moments of a region. */
template <int dim>
struct ShapeMoments
{
  double                          volume = 0.; //!< [L^dim]
  dealii::Point<dim>              centre;      //!< int x/V [L]
  dealii::SymmetricTensor<2, dim> second;      //!< int (x - c)(x - c)^T [L^(dim + 2)]
};

/**
 * The moments of a shape within a dense lattice of its level set. Cells of the lattice that the
 * surface crosses are divided by four in each direction, by 32 at edges; of those parts that it
 * crosses a plane cuts off what is inside: second order in the size of the parts.
 */
template <int dim>
ShapeMoments<dim> moments_of(const Shape<dim> &shape, const Lattice<dim> &lattice);
} // namespace scree
