#include <scree/contact/interior_contact.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace scree
{
namespace
{
// The constants that interior_contact.h documents.
constexpr double reach           = 1.; // cells
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
{
  const std::vector<unsigned int> places    = take(taken_or_near());
  double                          stiffness = 0.; // integral of E/L
  for (unsigned int k = 0; k < numbers.size(); ++k)
    {
      const ContactPoint<dim> &point = contact.points()[numbers[k]];
      overlap                        = std::max({overlap, -gap[k], least_length * point.cell_size});
      stiffness += point.weight * contact.modulus(point.pair) / lengths[point.pair];
    }
  overlap   = dealii::Utilities::MPI::max(overlap, communicator);
  stiffness = dealii::Utilities::MPI::sum(stiffness, communicator);
  start(places, area > 0. ? pressure_factor * overlap * overlap * stiffness / area : 0.);
}

template <int dim>
std::vector<unsigned int>
InteriorContact<dim>::taken_or_near() const
{
  const std::vector<bool>   is_near = contact.points_within(reach), is_taken = taken();
  std::vector<unsigned int> result;
  for (unsigned int i = 0; i < is_near.size(); ++i)
    if (is_taken[i] || is_near[i] || is_spring(i))
      result.push_back(i);
  return result;
}

template <int dim>
std::vector<unsigned int>
InteriorContact<dim>::take(std::vector<unsigned int> &&grown)
{
  std::vector<unsigned int> added;
  std::vector<double>       grown_pressure, grown_slack;
  double                    weights = 0.;
  for (unsigned int place = 0, k = 0; place < grown.size(); ++place)
    {
      const bool was_taken = k < numbers.size() && numbers[k] == grown[place];
      if (!was_taken)
        added.push_back(place);
      grown_pressure.push_back(was_taken ? pressure[k] : 0.);
      grown_slack.push_back(was_taken ? slack[k] : 0.);
      weights += contact.points()[grown[place]].weight;
      k += was_taken;
    }
  area     = dealii::Utilities::MPI::sum(weights, communicator);
  numbers  = std::move(grown);
  pressure = std::move(grown_pressure);
  slack    = std::move(grown_slack);
  constant.assign(numbers.size(), 0.);
  pressure_step = slack_step = constant;
  look();
  return added;
}

template <int dim>
void
InteriorContact<dim>::start(const std::vector<unsigned int> &places, const double mu)
{
  for (const unsigned int k : places)
    {
      slack[k]    = std::max(gap[k], overlap);
      pressure[k] = mu / slack[k];
    }
}

template <int dim>
bool
InteriorContact<dim>::take_near()
{
  auto               grown = taken_or_near();
  const unsigned int grows = grown.size() > numbers.size();
  if (dealii::Utilities::MPI::max(grows, communicator) == 0)
    return false;
  const double mu = complementarity();
  start(take(std::move(grown)), mu);
  return true;
}

template <int dim>
std::vector<bool>
InteriorContact<dim>::taken() const
{
  std::vector<bool> result(contact.points().size(), false);
  for (const unsigned int i : numbers)
    result[i] = true;
  return result;
}

template <int dim>
void
InteriorContact<dim>::look()
{
  std::vector<dealii::Tensor<1, dim>> jumps;
  for (const unsigned int i : numbers)
    jumps.push_back(contact.jumps()[i]);
  auto motions = contact.laws().motions(contact.points(), numbers, jumps, history);
  for (ContactMotion<dim> &motion : motions)
    motion.kept_closed_part = 1.;
  trials = contact.enforcement().trial_tractions(numbers, motions, history);
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
  for (unsigned int k = 0; k < numbers.size(); ++k)
    if (has_slack(numbers[k]))
      sum += contact.points()[numbers[k]].weight * pressure[k] * slack[k];
  sum = dealii::Utilities::MPI::sum(sum, communicator);
  return area > 0. ? sum / area : 0.;
}

template <int dim>
double
InteriorContact<dim>::infeasibility() const
{
  double largest = 0.;
  for (unsigned int k = 0; k < numbers.size(); ++k)
    if (has_slack(numbers[k]))
      largest
        = std::max(largest, std::abs(gap[k] + pressure[k] / trials[k].normal_stiffness - slack[k]));
  return dealii::Utilities::MPI::max(largest, communicator);
}

template <int dim>
double
InteriorContact<dim>::friction_secant(const unsigned int k, const double bound) const
{
  const double least = sticking_slide * contact.points()[numbers[k]].cell_size;
  const double size  = std::max(trials[k].tau.norm(), trials[k].tangential_stiffness * least);
  return is_spring(numbers[k]) ? 1. : std::min(1., bound / size);
}

template <int dim>
typename InteriorContact<dim>::Tangent
InteriorContact<dim>::tangent(const double mu)
{
  const std::size_t n_points = contact.points().size();
  Tangent           result;
  result.forces.resize(n_points);
  result.changes.resize(n_points);
  result.stiffness.resize(n_points);
  old_jumps         = contact.jumps();
  const auto bounds = contact.laws().bounds(contact.points(), numbers, pressure);
  for (unsigned int k = 0; k < numbers.size(); ++k)
    {
      const unsigned int i = numbers[k];
      if (is_idle(i))
        continue;
      const auto  &n   = contact.points()[i].normal;
      const double w   = contact.points()[i].weight;
      const auto   nn  = dealii::outer_product(n, n);
      const auto  &t   = trials[k];
      const double eps = t.normal_stiffness;
      const double f   = friction_secant(k, bounds[k].value);
      double       p = t.pressure, stiffness = eps;
      constant[k] = 0.;
      if (!is_spring(i))
        {
          p                         = pressure[k];
          const double compliance   = slack[k] + p / eps;
          const double inconsistent = gap[k] + p / eps - slack[k];
          constant[k]               = (mu - p * slack[k] - p * inconsistent) / compliance;
          stiffness                 = p / compliance;
        }
      result.forces[i]  = w * (p * n + f * t.tau);
      result.changes[i] = w * constant[k] * n;
      if (stiffness > negligible * eps)
        result.stiffness[i]
          = w
            * (stiffness * nn
               + f * t.tangential_stiffness * (dealii::unit_symmetric_tensor<dim>() - nn));
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
  const auto opening_of = [&](const unsigned int i) {
    return contact.points()[i].normal * (contact.jumps()[i] - old_jumps[i]);
  };
  const std::vector<bool> is_taken = taken();
  for (unsigned int i = 0; i < is_taken.size(); ++i)
    if (!is_taken[i] && has_slack(i))
      keep(contact.gap(i) - opening_of(i), opening_of(i));
  for (unsigned int k = 0; k < numbers.size(); ++k)
    {
      const unsigned int i = numbers[k];
      if (!has_slack(i))
        continue;
      const double eps     = trials[k].normal_stiffness;
      const double opening = opening_of(i);
      pressure_step[k]     = constant[k] - pressure[k] / (slack[k] + pressure[k] / eps) * opening;
      slack_step[k]        = opening + (pressure[k] + pressure_step[k]) / eps + gap[k] - slack[k];
      keep(pressure[k], pressure_step[k]);
      keep(slack[k], slack_step[k]);
    }
  return dealii::Utilities::MPI::min(alpha, communicator);
}

template <int dim>
void
InteriorContact<dim>::advance(const double alpha)
{
  for (unsigned int k = 0; k < numbers.size(); ++k)
    {
      pressure[k] += alpha * pressure_step[k];
      slack[k] += alpha * slack_step[k];
    }
  look();
}

template class InteriorContact<2>;
template class InteriorContact<3>;
} // namespace scree
