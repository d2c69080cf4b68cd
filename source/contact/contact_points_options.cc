#include <scree/contact/contact_points.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>

// What the solver may change in the contact for a while.
namespace scree
{
template <int dim>
void
ContactPoints<dim>::set_touching_holds(const bool holds)
{
  touching_holds = holds;
}

template <int dim>
void
ContactPoints<dim>::set_sticks(const bool sticks)
{
  all_stick = sticks;
}

template <int dim>
void
ContactPoints<dim>::freeze_friction(const bool freeze)
{
  frozen_limits.clear();
  frozen_closed_parts.clear();
  for (unsigned int i = 0; freeze && i < contact_points.size(); ++i)
    {
      const auto  &law      = contact_pairs[contact_points[i].pair].law;
      const double pressure = contact_responses[i].pressure;
      frozen_limits.push_back(law.law != ContactLaw::stick ? law.friction_coefficient * pressure
                              : pressure == 0.             ? 0.
                                                           : std::numeric_limits<double>::max());
      frozen_closed_parts.push_back(contact_responses[i].closed_part);
    }
}

template <int dim>
std::vector<double>
ContactPoints<dim>::overlaps(const MPI_Comm communicator) const
{
  std::vector<double> result(contact_pairs.size(), 0.);
  for (const ContactPoint<dim> &point : contact_points)
    if (contact_pairs[point.pair].law.law != ContactLaw::tied)
      result[point.pair] = std::max(result[point.pair], -point.initial_gap);
  dealii::Utilities::MPI::max(result, communicator, result);
  return result;
}

template <int dim>
void
ContactPoints<dim>::resolve_overlap(const std::vector<double> &allowances)
{
  pair_allowances = allowances;
}

#define SCREE_INSTANTIATE(dim)                                                     \
  template void                ContactPoints<dim>::set_touching_holds(const bool); \
  template void                ContactPoints<dim>::set_sticks(const bool);         \
  template void                ContactPoints<dim>::freeze_friction(const bool);    \
  template std::vector<double> ContactPoints<dim>::overlaps(const MPI_Comm) const;

template void ContactPoints<2>::resolve_overlap(const std::vector<double> &);
template void ContactPoints<3>::resolve_overlap(const std::vector<double> &);
SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
