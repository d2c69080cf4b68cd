#include <scree/base/exceptions.h>
#include <scree/base/log.h>
#include <scree/contact/initial_gap.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree
{
template <int dim>
InitialGaps<dim>::InitialGaps(const std::vector<Body<dim>>   &bodies,
                              const std::vector<ContactPair> &pairs, const double reach,
                              const unsigned int degree)
    : bodies(bodies)
    , pairs(pairs)
    , of_pairs(pairs.size())
    , degree(degree)
{
  for (const ContactPair &pair : pairs)
    {
      for (const auto &[key, length] : {std::make_pair("/Adjust", pair.law.adjust),
                                        std::make_pair("/Tied gap", pair.law.tied_gap)})
        require(!(length > reach), pair.law.path + key,
                "gaps up to " + short_number(length) + " are asked for, but the contact surface "
                  + "ends at a gap of " + short_number(reach),
                "make it smaller, or raise Contact/Shift");
      regions.emplace_back(pair.law.where, 1, pair.law.path + "/Where");
    }
}

template <int dim>
void
InitialGaps<dim>::adjust_pairs(const std::vector<ContactPoint<dim>> &points,
                               const MPI_Comm communicator, StartGaps &start_gaps)
{
  if (!start_gaps.are_known)
    {
      std::vector<double> least(pairs.size(), std::numeric_limits<double>::max());
      for (const ContactPoint<dim> &point : points)
        if (!point.is_beyond)
          least[point.pair] = std::min(least[point.pair], point.start_gap);
      dealii::Utilities::MPI::min(least, communicator, least);
      for (unsigned int p = 0; p < pairs.size(); ++p)
        if (pairs[p].law.adjust_by == AdjustBy::pairs && std::abs(least[p]) <= pairs[p].law.adjust)
          start_gaps.of_bodies[{pairs[p].a, pairs[p].b}] = least[p];
      start_gaps.are_known = true;
    }
  for (unsigned int p = 0; p < pairs.size(); ++p)
    if (const auto gap = start_gaps.of_bodies.find({pairs[p].a, pairs[p].b});
        gap != start_gaps.of_bodies.end())
      of_pairs[p] = gap->second;
}

template <int dim>
bool
InitialGaps<dim>::are_needed(const unsigned int pair) const
{
  return pairs[pair].law.kind->glues || pairs[pair].law.adjust > 0.;
}

template <int dim>
void
InitialGaps<dim>::apply(const std::array<dealii::Tensor<1, dim>, 2> &displacement,
                        ContactPoint<dim>                           &point) const
{
  const ContactPair           &pair = pairs[point.pair];
  const ContactPairParameters &law  = pair.law;
  // Near kinks the point's own gap comes from the shapes.
  const auto initial_distance = [&](const unsigned int body, const dealii::Point<dim> &X) {
    if (point.is_exact)
      return bodies[body].shape->signed_distance(X);
    return (bodies[body].initial_level_set ? *bodies[body].initial_level_set
                                           : bodies[body].level_set)
      .value(X, degree);
  };
  const bool by_points = law.adjust_by == AdjustBy::points;
  double     gap = 0., adjusted = of_pairs[point.pair];
  for (const auto &u : displacement)
    {
      const dealii::Point<dim> X = point.position - u;
      // Where nothing has moved, the point knows its gap on coarser cells too.
      const double at_start = u.norm_square() == 0.
                                ? point.start_gap
                                : initial_distance(pair.a, X) + initial_distance(pair.b, X);
      gap += 0.5 * at_start;
      if (by_points && std::abs(at_start) <= law.adjust && !point.is_beyond)
        adjusted += 0.5 * at_start;
    }
  point.initial_gap -= adjusted;
  const double tied_gap = (std::isnan(law.tied_gap) ? 0.1 * point.cell_size : law.tied_gap)
                          * (point.is_beyond ? 0.1 : 1.);
  point.is_glued
    = law.kind->glues && gap - adjusted <= tied_gap
      && regions[point.pair].selects(point.position - 0.5 * (displacement[0] + displacement[1]));
}

template class InitialGaps<2>;
template class InitialGaps<3>;
} // namespace scree
