#include <scree/bodies/thin_body.h>
#include <scree/contact/exact_distance.h>
#include <scree/contact/level_set_surface.h>
#include <scree/level_set/closest_point.h>

#include <algorithm>
#include <utility>

namespace scree
{
namespace
{
/** x_a and x_b of contact points. */
template <int dim>
class Feet
{
public:
  Feet(const BackgroundGrid<dim> &grid, const LevelSetNodes<dim> &level_set_nodes,
       const std::vector<Body<dim>> &bodies, const std::vector<ContactPair> &pairs,
       const ExactDistances<dim> &distances)
      : bodies(bodies)
      , pairs(pairs)
      , distances(distances)
      , box(grid.box())
      , degree(level_set_nodes.basis().degree)
  {
  }

  /** Sets the feet of a point, with an expected slide its gap and normal, too. */
  void find(const IncrementPrediction<dim> &prediction, ContactPoint<dim> &point) const;

private:
  dealii::Point<dim> foot(const ContactPoint<dim> &point, const unsigned int body,
                          const dealii::Point<dim> &start) const;

  const std::vector<Body<dim>>   &bodies;
  const std::vector<ContactPair> &pairs;
  const ExactDistances<dim>      &distances;
  const dealii::BoundingBox<dim>  box;
  const unsigned int              degree; // of the level sets
};

template <int dim>
dealii::Point<dim>
Feet<dim>::foot(const ContactPoint<dim> &point, const unsigned int body,
                const dealii::Point<dim> &start) const
{
  dealii::Point<dim> result = point.is_exact ? distances.foot(body, start)
                                             : project(bodies[body].level_set, start, degree).point;
  if (bodies[body].is_rigid())
    return result;
  if (!point.is_exact)
    result = foot_on_thin_body<dim>(bodies[body], start,
                                    body == pairs[point.pair].a ? point.normal : -point.normal,
                                    2. * point.cell_size)
               .value_or(result);
  for (unsigned int d = 0; d < dim; ++d)
    result[d] = std::clamp(result[d], box.lower_bound(d), box.upper_bound(d));
  return result;
}

template <int dim>
void
Feet<dim>::find(const IncrementPrediction<dim> &prediction, ContactPoint<dim> &point) const
{
  const ContactPair        &pair = pairs[point.pair];
  const dealii::Point<dim> &x    = point.position;
  dealii::Tensor<1, dim>    slide;
  if (prediction)
    {
      const auto expected = expected_slide(point, pair, distances, prediction);
      point.initial_gap += (point.normal - expected.normal) * expected.jump;
      point.normal = expected.normal;
      slide        = expected.slide;
    }
  point.feet = {{foot(point, pair.a, x + 0.5 * slide), foot(point, pair.b, x - 0.5 * slide)}};
}
} // namespace

template <int dim>
ContactDiscretisation<dim>
level_set_surface(const DisplacementSpace<dim> &space, const LevelSetNodes<dim> &level_set_nodes,
                  const std::vector<Body<dim>> &bodies, const std::vector<ContactPair> &pairs,
                  const double shift, const IncrementPrediction<dim> &prediction,
                  const dealii::TrilinosWrappers::MPI::Vector *start_displacement,
                  const dealii::TrilinosWrappers::MPI::Vector *secant_ratios, StartGaps *start_gaps)
{
  const ExactDistances<dim> distances(bodies, space.grid.finest_size());
  InitialGaps<dim>          initial_gaps(bodies, pairs, 2. * shift, level_set_nodes.basis().degree);
  const bool                moves = std::any_of(bodies.begin(), bodies.end(),
                                                [](const Body<dim> &body) { return body.law != nullptr; });
  std::vector<ContactPoint<dim>> points
    = contact_surface(space, level_set_nodes, bodies, pairs, shift, distances, moves || prediction);
  const Feet<dim> feet(space.grid, level_set_nodes, bodies, pairs, distances);
  for (ContactPoint<dim> &point : points)
    feet.find(prediction, point);
  return discretise_contact(space, bodies, pairs, std::move(points), initial_gaps,
                            start_displacement, secant_ratios, start_gaps);
}

#define SCREE_INSTANTIATE(dim)                                                                    \
  template ContactDiscretisation<dim> level_set_surface(                                          \
    const DisplacementSpace<dim> &, const LevelSetNodes<dim> &, const std::vector<Body<dim>> &,   \
    const std::vector<ContactPair> &, const double, const IncrementPrediction<dim> &,             \
    const dealii::TrilinosWrappers::MPI::Vector *, const dealii::TrilinosWrappers::MPI::Vector *, \
    StartGaps *);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
