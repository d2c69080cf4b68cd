#include <scree/contact/interior_contact.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace scree
{
namespace
{
// The constants that interior_contact.h documents.
constexpr double pressure_factor = 0.3;
constexpr double least_length    = 0.1;  // cells
constexpr double sticking_slide  = 1e-3; // cells
/** Part of the way to p = 0 or s = 0 that a step may go. */
constexpr double to_boundary = 0.99;
/** Of eps: less stiffness is none, so that factors stay sparse. */
constexpr double negligible = 1e-8;
} // namespace

template <int dim>
InteriorContact<dim>::InteriorContact(ContactPoints<dim>        &contact,
                                      const ContactHistory<dim> &history,
                                      const std::vector<double> &lengths,
                                      const MPI_Comm             communicator)
    : contact(contact)
    , history(history)
    , communicator(communicator)
    , all_points(contact.points().size())
    , constant(all_points.size())
    , pressure_step(all_points.size())
    , slack_step(all_points.size())
{
  std::iota(all_points.begin(), all_points.end(), 0u);
  look();
  double              overlap = 0.;
  std::vector<double> sums    = {0., 0.}; // of weights, of w E/L
  for (const unsigned int i : all_points)
    {
      const ContactPoint<dim> &point = contact.points()[i];
      overlap                        = std::max({overlap, -gap[i], least_length * point.cell_size});
      sums[0] += point.weight;
      sums[1] += point.weight * contact.modulus(point.pair) / lengths[point.pair];
    }
  overlap = dealii::Utilities::MPI::max(overlap, communicator);
  dealii::Utilities::MPI::sum(sums, communicator, sums);
  area            = sums[0];
  const double mu = area > 0. ? pressure_factor * overlap * overlap * sums[1] / area : 0.;
  for (const unsigned int i : all_points)
    {
      slack.push_back(std::max(gap[i], overlap));
      pressure.push_back(mu / slack[i]);
    }
}

template <int dim>
void
InteriorContact<dim>::look()
{
  auto motions = contact.laws().motions(contact.points(), all_points, contact.jumps(), history);
  for (ContactMotion<dim> &motion : motions)
    motion.kept_closed_part = 1.;
  trials = contact.enforcement().trial_tractions(all_points, motions, history);
  gap.clear();
  for (const TrialTraction<dim> &trial : trials)
    gap.push_back(-trial.pressure / trial.normal_stiffness);
}

template <int dim>
bool
InteriorContact<dim>::is_idle(const unsigned int i) const
{
  return contact.pairs()[contact.points()[i].pair].law.kind->glues && !is_spring(i);
}

template <int dim>
double
InteriorContact<dim>::complementarity() const
{
  double sum = 0.;
  for (const unsigned int i : all_points)
    if (has_slack(i))
      sum += contact.points()[i].weight * pressure[i] * slack[i];
  sum = dealii::Utilities::MPI::sum(sum, communicator);
  return area > 0. ? sum / area : 0.;
}

template <int dim>
double
InteriorContact<dim>::infeasibility() const
{
  double largest = 0.;
  for (const unsigned int i : all_points)
    if (has_slack(i))
      largest
        = std::max(largest, std::abs(gap[i] + pressure[i] / trials[i].normal_stiffness - slack[i]));
  return dealii::Utilities::MPI::max(largest, communicator);
}

template <int dim>
double
InteriorContact<dim>::friction_secant(const unsigned int i, const double bound) const
{
  const double least = sticking_slide * contact.points()[i].cell_size;
  const double size  = std::max(trials[i].tau.norm(), trials[i].tangential_stiffness * least);
  return is_spring(i) ? 1. : std::min(1., bound / size);
}

template <int dim>
typename InteriorContact<dim>::Tangent
InteriorContact<dim>::tangent(const double mu)
{
  Tangent result;
  result.forces.resize(all_points.size());
  result.changes.resize(all_points.size());
  result.stiffness.resize(all_points.size());
  old_jumps         = contact.jumps();
  const auto bounds = contact.laws().bounds(contact.points(), all_points, pressure);
  for (const unsigned int i : all_points)
    {
      if (is_idle(i))
        continue;
      const auto  &n   = contact.points()[i].normal;
      const double w   = contact.points()[i].weight;
      const auto   nn  = dealii::outer_product(n, n);
      const auto  &t   = trials[i];
      const double eps = t.normal_stiffness;
      const double f   = friction_secant(i, bounds[i].value);
      double       p = t.pressure, k = eps;
      constant[i] = 0.;
      if (!is_spring(i))
        {
          p                         = pressure[i];
          const double compliance   = slack[i] + p / eps;
          const double inconsistent = gap[i] + p / eps - slack[i];
          constant[i]               = (mu - p * slack[i] - p * inconsistent) / compliance;
          k                         = p / compliance;
        }
      result.forces[i]  = w * (p * n + f * t.tau);
      result.changes[i] = w * constant[i] * n;
      if (k > negligible * eps)
        result.stiffness[i]
          = w * (k * nn + f * t.tangential_stiffness * (dealii::unit_symmetric_tensor<dim>() - nn));
    }
  return result;
}

template <int dim>
double
InteriorContact<dim>::step_length()
{
  double     alpha = 1.;
  const auto keep  = [&](const double value, const double change) {
    if (change < 0.)
      alpha = std::min(alpha, -to_boundary * value / change);
  };
  for (const unsigned int i : all_points)
    {
      if (!has_slack(i))
        continue;
      const double eps     = trials[i].normal_stiffness;
      const double opening = contact.points()[i].normal * (contact.jumps()[i] - old_jumps[i]);
      pressure_step[i]     = constant[i] - pressure[i] / (slack[i] + pressure[i] / eps) * opening;
      slack_step[i]        = opening + (pressure[i] + pressure_step[i]) / eps + gap[i] - slack[i];
      keep(pressure[i], pressure_step[i]);
      keep(slack[i], slack_step[i]);
    }
  return dealii::Utilities::MPI::min(alpha, communicator);
}

template <int dim>
void
InteriorContact<dim>::advance(const double alpha)
{
  for (const unsigned int i : all_points)
    {
      pressure[i] += alpha * pressure_step[i];
      slack[i] += alpha * slack_step[i];
    }
  look();
}

template class InteriorContact<2>;
template class InteriorContact<3>;
} // namespace scree
