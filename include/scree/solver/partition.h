#pragma once

#include <deal.II/lac/trilinos_vector.h>

#include <vector>

namespace scree
{
/** Parts of the unknowns between which no forces act, as bodies that do not touch. */
struct Partition
{
  using Vector = dealii::TrilinosWrappers::MPI::Vector;

  unsigned int              n_parts = 1;
  std::vector<unsigned int> parts; //!< of the owned unknowns in their order; of one part: empty

  /** sum a_i b_i over the unknowns of each part (collective). */
  std::vector<double> products(const Vector &a, const Vector &b) const;

  /** v times the factor of each part. */
  void scale(const std::vector<double> &factors, Vector &v) const;
};
} // namespace scree
