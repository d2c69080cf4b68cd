#include <scree/contact/contact_energy.h>

#include <deal.II/base/mpi.h>

namespace scree
{
template <int dim>
double
stored_energy(const ContactPoints<dim> &contact, const MPI_Comm communicator)
{
  const ContactHistory<dim> state = contact.current_history();
  const std::vector<double> of_points
    = contact.enforcement().stored_energy(state.pressure, state.tau);
  double sum = 0.;
  for (unsigned int i = 0; i < of_points.size(); ++i)
    sum += contact.points()[i].weight * of_points[i];
  return dealii::Utilities::MPI::sum(sum, communicator);
}

template <int dim>
double
cut_energy(const ContactPoints<dim> &contact, const ContactHistory<dim> &history,
           const MPI_Comm communicator)
{
  const std::vector<double> zeros(contact.points().size());
  const auto                before = contact.enforcement().stored_energy(zeros, history.tau);
  const auto after = contact.enforcement().stored_energy(zeros, contact.current_history().tau);
  double     sum   = 0.;
  for (unsigned int i = 0; i < zeros.size(); ++i)
    sum += contact.points()[i].weight * (before[i] - after[i]);
  return dealii::Utilities::MPI::sum(sum, communicator);
}

template <int dim>
double
dissipation(const ContactPoints<dim> &contact, const ContactHistory<dim> &history,
            const double share, const MPI_Comm communicator)
{
  const ContactHistory<dim> state   = contact.current_history();
  const auto                elastic = contact.enforcement().elastic_slides(history.tau, state.tau);
  double                    dissipated = 0., not_negative = 0.;
  for (unsigned int i = 0; i < contact.points().size(); ++i)
    {
      const ContactPoint<dim> &point = contact.points()[i];
      auto                     slip  = state.jump[i] - history.jump[i];
      slip -= (slip * point.normal) * point.normal;
      slip -= elastic[i];
      const double at_end = -point.weight * (state.tau[i] * slip);
      const double mean   = (1. - share) * at_end - share * point.weight * (history.tau[i] * slip);
      dissipated += mean;
      not_negative += mean < 0. ? at_end : mean;
    }
  dissipated   = dealii::Utilities::MPI::sum(dissipated, communicator);
  not_negative = dealii::Utilities::MPI::sum(not_negative, communicator);
  return dissipated < 0. ? not_negative : dissipated;
}

#define SCREE_INSTANTIATE(dim)                                                         \
  template double stored_energy(const ContactPoints<dim> &, const MPI_Comm);           \
  template double cut_energy(const ContactPoints<dim> &, const ContactHistory<dim> &,  \
                             const MPI_Comm);                                          \
  template double dissipation(const ContactPoints<dim> &, const ContactHistory<dim> &, \
                              const double, const MPI_Comm);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
