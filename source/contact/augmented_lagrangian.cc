#include <scree/contact/augmented_lagrangian.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree
{
template <int dim>
AugmentedLagrangian<dim>::AugmentedLagrangian(const std::vector<ContactStiffness>  &penalties,
                                              const std::vector<ContactPoint<dim>> &points,
                                              const EnforcementParameters          &parameters,
                                              const MPI_Comm                        communicator)
    : Enforcement<dim>(penalties)
    , parameters(parameters)
    , normal(points, communicator)
    , tangential(normal)
{
  constexpr double smallest_part = MultiplierField<dim>::smallest_part;
  for (const ContactPoint<dim> &point : points)
    this->points.push_back(
      {point.normal, point.initial_gap, point.cell_size,
       !point.is_node || point.weight >= smallest_part * std::pow(point.cell_size, dim - 1)});
}

template <int dim>
void
AugmentedLagrangian<dim>::start_step(const ContactHistory<dim> &history)
{
  std::vector<dealii::Tensor<1, dim>> tractions;
  for (unsigned int p = 0; p < points.size(); ++p)
    {
      Point       &point       = points[p];
      const double gap         = point.initial_gap + point.normal * history.jump[p];
      const bool   is_pressed  = history.pressure[p] != 0.;
      point.has_multiplier     = is_pressed && point.may_have_multiplier;
      point.is_closed_at_start = is_pressed || gap <= parameters.largest_gap * point.cell_size;
      point.has_opened         = false;
      tractions.push_back(history.pressure[p] * point.normal + history.tau[p]);
    }
  const auto of_traction = parts(tractions);
  const auto with        = masks();
  normal.clear();
  normal.add_fit(of_traction[0], with[0]);
  tangential.clear();
  tangential.add_fit(of_traction[1], with[1]);
  last_mean = std::numeric_limits<double>::infinity();
  stiffen(1. / growth);
}

template <int dim>
dealii::Tensor<1, dim>
AugmentedLagrangian<dim>::multiplier(const unsigned int point) const
{
  if (!points[point].has_multiplier)
    return {};
  const auto            &n      = points[point].normal;
  dealii::Tensor<1, dim> result = (normal(point) * n) * n;
  if (points[point].is_closed_at_start)
    {
      const dealii::Tensor<1, dim> lambda_t = tangential(point);
      result += lambda_t - (lambda_t * n) * n;
    }
  return result;
}

template <int dim>
void
AugmentedLagrangian<dim>::choose_points(const std::vector<ContactResponse<dim>> &responses)
{
  for (unsigned int p = 0; p < points.size(); ++p)
    if (responses[p].pressure != 0.)
      points[p].has_multiplier = points[p].may_have_multiplier;
    else if (points[p].has_multiplier && !points[p].has_opened)
      {
        points[p].has_multiplier = false;
        points[p].has_opened     = true;
      }
}

template <int dim>
std::array<std::vector<bool>, 2>
AugmentedLagrangian<dim>::masks() const
{
  std::array<std::vector<bool>, 2> result;
  for (const Point &point : points)
    {
      result[0].push_back(point.has_multiplier);
      result[1].push_back(point.has_multiplier && point.is_closed_at_start);
    }
  return result;
}

template <int dim>
std::array<std::vector<dealii::Tensor<1, dim>>, 2>
AugmentedLagrangian<dim>::parts(const std::vector<dealii::Tensor<1, dim>> &vectors) const
{
  std::array<std::vector<dealii::Tensor<1, dim>>, 2> result;
  for (unsigned int p = 0; p < points.size(); ++p)
    {
      result[0].push_back((vectors[p] * points[p].normal) * points[p].normal);
      result[1].push_back(vectors[p] - result[0].back());
    }
  return result;
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
  const std::vector<Point> last = points;
  choose_points(responses);
  std::vector<dealii::Tensor<1, dim>> changes;
  for (unsigned int p = 0; p < points.size(); ++p)
    changes.push_back(responses[p].traction(points[p].normal) - multiplier(p));
  const auto of_changes = parts(changes);
  auto       motions    = of_changes; // gaps and slides, in cells
  for (unsigned int p = 0; p < points.size(); ++p)
    {
      motions[0][p] /= penalties[p].normal * points[p].cell_size;
      motions[1][p] /= penalties[p].tangential * points[p].cell_size;
    }
  const auto   with = masks();
  const double mean = std::max(normal.largest_mean(motions[0], with[0]),
                               tangential.largest_mean(motions[1], with[1]));
  if (mean <= parameters.largest_gap)
    {
      points = last; // this equilibrium is of these
      return true;
    }
  normal.add_fit(of_changes[0], with[0]);
  tangential.add_fit(of_changes[1], with[1]);
  if (mean > 0.25 * last_mean)
    stiffen(std::min(parameters.growth, parameters.largest_growth / growth));
  last_mean = mean;
  return false;
}

template class AugmentedLagrangian<2>;
template class AugmentedLagrangian<3>;
} // namespace scree
