#pragma once

#include <scree/base/sparse_rows.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>

namespace scree
{
/** K = K_0 + B^T E B with the contact points glued in K_0, whatever the contact does. */
struct Condensation
{
  const dealii::TrilinosWrappers::SparseMatrix &glued; //!< K_0, valid until the next tangent()
  SparseRows jumps;     //!< B on the unknowns that are not prescribed
  bool       symmetric; //!< K_0
};
} // namespace scree
