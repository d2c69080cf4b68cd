#pragma once

#include <scree/contact/contact_surface.h>
#include <scree/contact/enforcement.h>
#include <scree/contact/enforcement_parameters.h>

#include <deal.II/base/mpi.h>

#include <memory>
#include <vector>

namespace scree
{
/** The enforcement of that type, with these penalties, for these points. */
template <int dim>
std::unique_ptr<Enforcement<dim>> make_enforcement(const EnforcementParameters          &parameters,
                                                   const std::vector<ContactPoint<dim>> &points,
                                                   const std::vector<ContactStiffness>  &penalties,
                                                   const MPI_Comm communicator);
} // namespace scree
