#include <scree/contact/augmented_lagrangian.h>
#include <scree/contact/make_enforcement.h>
#include <scree/contact/penalty.h>

namespace scree
{
template <int dim>
std::unique_ptr<Enforcement<dim>>
make_enforcement(const EnforcementParameters          &parameters,
                 const std::vector<ContactPoint<dim>> &points,
                 const std::vector<ContactStiffness> &penalties, const MPI_Comm communicator)
{
  if (parameters.type == "penalty")
    return std::make_unique<Penalty<dim>>(penalties);
  return std::make_unique<AugmentedLagrangian<dim>>(penalties, points, parameters, communicator);
}

#define SCREE_INSTANTIATE(dim)                                             \
  template std::unique_ptr<Enforcement<dim>> make_enforcement(             \
    const EnforcementParameters &, const std::vector<ContactPoint<dim>> &, \
    const std::vector<ContactStiffness> &, const MPI_Comm);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
