#include <scree/solver/partition.h>

#include <deal.II/base/mpi.h>

namespace scree
{
std::vector<double>
Partition::products(const Vector &a, const Vector &b) const
{
  if (n_parts == 1)
    return {a * b};
  std::vector<double> result(n_parts);
  const double       *of_a = a.trilinos_vector()[0], *of_b = b.trilinos_vector()[0];
  for (std::size_t i = 0; i < parts.size(); ++i)
    result[parts[i]] += of_a[i] * of_b[i];
  dealii::Utilities::MPI::sum(result, a.get_mpi_communicator(), result);
  return result;
}

void
Partition::scale(const std::vector<double> &factors, Vector &v) const
{
  if (n_parts == 1)
    {
      v *= factors[0];
      return;
    }
  double *values = v.trilinos_vector()[0];
  for (std::size_t i = 0; i < parts.size(); ++i)
    values[i] *= factors[parts[i]];
}
} // namespace scree
