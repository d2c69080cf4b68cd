#include <scree/contact/augmented_lagrangian.h>

#include <algorithm>
#include <limits>

namespace scree
{
template <int dim>
AugmentedLagrangian<dim>::AugmentedLagrangian(const std::vector<ContactStiffness>  &penalties,
                                              const std::vector<ContactPoint<dim>> &points,
                                              const EnforcementParameters          &parameters,
                                              const MPI_Comm                        communicator)
    : parameters(parameters)
    , lambda(points, communicator)
    , penalties(penalties)
{
  for (const ContactPoint<dim> &point : points)
    this->points.push_back({point.normal, point.initial_gap, point.cell_size});
}

template <int dim>
void
AugmentedLagrangian<dim>::start_step(const ContactHistory<dim> &history)
{
  std::vector<dealii::Tensor<1, dim>> tractions;
  closed.clear();
  for (unsigned int p = 0; p < points.size(); ++p)
    {
      Point       &point = points[p];
      const double gap   = point.initial_gap + point.normal * history.jump[p];
      point.is_closed_at_start
        = history.pressure[p] != 0. || gap <= parameters.largest_gap * point.cell_size;
      tractions.push_back(history.pressure[p] * points[p].normal + history.tau[p]);
      closed.push_back(history.pressure[p] != 0.);
    }
  lambda.clear();
  lambda.add_fit(tractions, closed);
  closed.assign(points.size(), false);
  last_mean = std::numeric_limits<double>::infinity();
  stiffen(1. / growth);
}

template <int dim>
dealii::Tensor<1, dim>
AugmentedLagrangian<dim>::multiplier(const unsigned int point) const
{
  const dealii::Tensor<1, dim> all = lambda(point);
  const auto                  &n   = points[point].normal;
  return points[point].is_closed_at_start ? all : (all * n) * n;
}

template <int dim>
std::vector<TrialTraction<dim>>
AugmentedLagrangian<dim>::trial_tractions(const std::vector<unsigned int>       &numbers,
                                          const std::vector<ContactMotion<dim>> &motions,
                                          const ContactHistory<dim> &) const
{
  std::vector<TrialTraction<dim>> result;
  result.reserve(numbers.size());
  for (unsigned int i = 0; i < numbers.size(); ++i)
    {
      const unsigned int           p        = numbers[i];
      const ContactMotion<dim>    &motion   = motions[i];
      const dealii::Tensor<1, dim> lambda_p = multiplier(p);
      const double                 lambda_n = lambda_p * motion.normal;
      const auto [eps_n, eps_t]             = penalties[p];
      const double pressure = lambda_n - eps_n * (motion.is_glued ? motion.opening : motion.gap);
      const ClosedPart f    = motion.closed_part(pressure / eps_n);
      result.push_back({pressure,
                        lambda_p - lambda_n * motion.normal - eps_t * f.value * motion.slide, eps_n,
                        eps_t, f});
    }
  return result;
}

template <int dim>
void
AugmentedLagrangian<dim>::stiffen(const double factor)
{
  for (ContactStiffness &penalty : penalties)
    {
      penalty.normal *= factor;
      penalty.tangential *= factor;
    }
  growth *= factor;
}

template <int dim>
bool
AugmentedLagrangian<dim>::update(const std::vector<ContactResponse<dim>> &responses)
{
  std::vector<dealii::Tensor<1, dim>> changes, motions; // motions: gaps and slides, in cells
  for (unsigned int p = 0; p < points.size(); ++p)
    {
      const dealii::Tensor<1, dim> &n           = points[p].normal;
      dealii::Tensor<1, dim>        change      = responses[p].traction(n) - multiplier(p);
      const dealii::Tensor<1, dim>  normal_part = (change * n) * n;
      if (!points[p].is_closed_at_start)
        change = normal_part;
      changes.push_back(change);
      motions.push_back(
        (normal_part / penalties[p].normal + (change - normal_part) / penalties[p].tangential)
        / points[p].cell_size);
      closed[p] = closed[p] || responses[p].pressure != 0.;
    }
  const double mean = lambda.largest_mean(motions, closed);
  if (mean <= parameters.largest_gap)
    return true;
  lambda.add_fit(changes, closed);
  if (mean > 0.25 * last_mean)
    stiffen(std::min(parameters.growth, parameters.largest_growth / growth));
  last_mean = mean;
  return false;
}

template class AugmentedLagrangian<2>;
template class AugmentedLagrangian<3>;
} // namespace scree
