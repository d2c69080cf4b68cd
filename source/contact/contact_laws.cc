#include <scree/contact/contact_laws.h>

#include <algorithm>
#include <numeric>

namespace scree
{
namespace
{
/** Consecutive entries of arrays. */
struct Range
{
  std::size_t first, n;

  template <typename Array>
  auto of(Array &values) const
  {
    return dealii::make_array_view(values, first, n);
  }
};

/** Calls f(pair, range) for the ranges of `numbers` that name points of the same pair. */
template <int dim, typename F>
void
for_each_pair(const std::vector<ContactPoint<dim>> &points,
              const std::vector<unsigned int> &numbers, const F &f)
{
  for (std::size_t i = 0, end = 0; i < numbers.size(); i = end)
    {
      const unsigned int pair = points[numbers[i]].pair;
      while (end < numbers.size() && points[numbers[end]].pair == pair)
        ++end;
      f(pair, Range{i, end - i});
    }
}
} // namespace

template <int dim>
const ContactLaw &
ContactLaws<dim>::acting_law(const unsigned int pair) const
{
  static const ContactLaw &frictionless = contact_law("frictionless"),
                          &stick        = contact_law("stick");
  const ContactLaw &law                 = *of_pairs[pair].law.kind;
  if (law.glues)
    return law;
  if (!pair_allowances.empty())
    return frictionless;
  return all_stick && law.bound && law.slides ? stick : law;
}

template <int dim>
bool
ContactLaws<dim>::have_friction() const
{
  return std::any_of(of_pairs.begin(), of_pairs.end(),
                     [](const ContactPair &pair) { return pair.law.friction() > 0.; });
}

template <int dim>
std::vector<ContactMotion<dim>>
ContactLaws<dim>::motions(const std::vector<ContactPoint<dim>>      &points,
                          const std::vector<unsigned int>           &numbers,
                          const std::vector<dealii::Tensor<1, dim>> &jumps,
                          const ContactHistory<dim>                 &history) const
{
  std::vector<ContactMotion<dim>> result;
  result.reserve(numbers.size());
  for (unsigned int i = 0; i < numbers.size(); ++i)
    {
      const ContactPoint<dim> &point = points[numbers[i]];
      const double             gap
        = point.initial_gap + (pair_allowances.empty() ? 0. : pair_allowances[point.pair]);
      auto motion         = ContactMotion<dim>::between(gap, point.normal, history.jump[numbers[i]],
                                                        jumps[i], point.is_glued);
      motion.touching_gap = touching_holds ? 1e-8 * point.cell_size : 0.;
      if (!frozen_bounds.empty() && !point.is_glued && acting_law(point.pair).bound)
        {
          motion.kept_closed_part = frozen_closed_parts[numbers[i]];
          motion.touching_gap     = -1.;
        }
      result.push_back(motion);
    }
  return result;
}

template <int dim>
std::vector<unsigned int>
ContactLaws<dim>::acting(const std::vector<ContactPoint<dim>>      &points,
                         const std::vector<dealii::Tensor<1, dim>> &jumps,
                         const Enforcement<dim>                    &enforcement) const
{
  std::vector<unsigned int> result;
  unsigned int              pair            = dealii::numbers::invalid_unsigned_int;
  bool                      acts_when_apart = false;
  for (unsigned int i = 0; i < points.size(); ++i)
    {
      const ContactPoint<dim> &point = points[i];
      if (point.pair != pair)
        {
          pair            = point.pair;
          acts_when_apart = !acting_law(pair).glues // what is not glued does nothing
                            && bounds(points, {i}, {0.})[0].value > 0.;
        }
      const double gap = point.initial_gap + point.normal * jumps[i];
      if (!(gap > surely_open * point.cell_size) || point.is_glued || acts_when_apart
          || (!frozen_bounds.empty() && frozen_bounds[i] > 0.) || enforcement.may_press_apart(i))
        result.push_back(i);
    }
  return result;
}

template <int dim>
std::vector<FrictionBound>
ContactLaws<dim>::bounds(const std::vector<ContactPoint<dim>> &points,
                         const std::vector<unsigned int>      &numbers,
                         const std::vector<double>            &pressures) const
{
  std::vector<FrictionBound> result(numbers.size());
  for_each_pair(points, numbers, [&](const unsigned int pair, const Range &range) {
    if (const ContactLaw &law = acting_law(pair); law.bound)
      law.bound(of_pairs[pair].law, range.of(pressures), range.of(result));
  });
  return result;
}

template <int dim>
std::vector<ContactResponse<dim>>
ContactLaws<dim>::respond(const std::vector<ContactPoint<dim>>  &points,
                          const std::vector<unsigned int>       &numbers,
                          const std::vector<ContactMotion<dim>> &motions,
                          const std::vector<TrialTraction<dim>> &trials) const
{
  std::vector<FrictionBound> of_points;
  if (frozen_bounds.empty())
    {
      std::vector<double> pressures;
      pressures.reserve(trials.size());
      for (const TrialTraction<dim> &trial : trials)
        pressures.push_back(std::max(0., trial.pressure));
      of_points = bounds(points, numbers, pressures);
    }
  else
    for (const unsigned int i : numbers)
      of_points.push_back({frozen_bounds[i], 0.});
  std::vector<ContactResponse<dim>> responses(numbers.size());
  for_each_pair(points, numbers, [&](const unsigned int pair, const Range &range) {
    return_to_admissible<dim>(acting_law(pair), range.of(motions), range.of(trials),
                              range.of(std::as_const(of_points)), range.of(responses));
  });
  return responses;
}

template <int dim>
void
ContactLaws<dim>::freeze(const std::vector<ContactPoint<dim>>    &points,
                         const std::vector<ContactResponse<dim>> &responses)
{
  unfreeze();
  std::vector<unsigned int> numbers(points.size());
  std::iota(numbers.begin(), numbers.end(), 0u);
  std::vector<double> pressures;
  for (const ContactResponse<dim> &response : responses)
    {
      pressures.push_back(response.pressure);
      frozen_closed_parts.push_back(response.closed_part);
    }
  for (const FrictionBound &bound : bounds(points, numbers, pressures))
    frozen_bounds.push_back(bound.value);
}

template <int dim>
void
ContactLaws<dim>::unfreeze()
{
  frozen_bounds.clear();
  frozen_closed_parts.clear();
}

template class ContactLaws<2>;
template class ContactLaws<3>;
} // namespace scree
