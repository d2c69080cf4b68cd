#include <scree/bodies/thin_body.h>
#include <scree/contact/exact_distance.h>
#include <scree/contact/initial_gap.h>
#include <scree/contact/level_set_surface.h>
#include <scree/level_set/closest_point.h>

#include <algorithm>

namespace scree
{
namespace
{
/** Of the penalties: enough for a body that is unloaded and elastic again. */
constexpr double smallest_ratio = 0.1;

/** A vector at the nodes of stencils, which may lie on any process; empty for null. */
dealii::TrilinosWrappers::MPI::Vector
values_at(const std::vector<NodeStencil>              &stencils,
          const dealii::TrilinosWrappers::MPI::Vector *vector, const unsigned int dim)
{
  dealii::TrilinosWrappers::MPI::Vector result;
  if (!vector)
    return result;
  const dealii::IndexSet owned = vector->locally_owned_elements();
  std::vector<DofIndex>  unknowns;
  for (const NodeStencil &stencil : stencils)
    for (const auto &[node, weight] : stencil)
      for (unsigned int d = 0; d < dim; ++d)
        unknowns.push_back(node + d);
  std::sort(unknowns.begin(), unknowns.end());
  dealii::IndexSet relevant(owned);
  relevant.add_indices(unknowns.begin(), std::unique(unknowns.begin(), unknowns.end()));
  relevant.compress();
  result.reinit(owned, relevant, vector->get_mpi_communicator());
  result = *vector;
  return result;
}

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

/** What the stencils of both sides of a point give. */
template <int dim>
struct PointStencil
{
  typename JumpOperator<dim>::NodeWeights nodes;
  std::array<dealii::Tensor<1, dim>, 2>   moved; //!< u_n of deformable sides
  double                                  stiffness_ratio = 1.;
  bool is_complete = true; //!< else the surface ends here: one of the bodies is clipped by the box
};

/** Stencils of the deformable sides of points, in the order of the points. */
template <int dim>
class Stencils
{
public:
  using Vector = dealii::TrilinosWrappers::MPI::Vector;

  Stencils(const DisplacementSpace<dim> &space, const std::vector<Body<dim>> &bodies,
           const std::vector<ContactPair> &pairs, const std::vector<ContactPoint<dim>> &points,
           const Vector *start_displacement, const Vector *secant_ratios)
      : bodies(bodies)
      , pairs(pairs)
      , stencils(at(space, points))
      , has_start(start_displacement != nullptr)
      , has_ratios(secant_ratios != nullptr)
      , u_n(values_at(stencils, start_displacement, dim))
      , ratios(values_at(stencils, secant_ratios, dim))
  {
  }

  /** That of the next point. */
  PointStencil<dim> next(const ContactPoint<dim> &point);

private:
  std::vector<NodeStencil> at(const DisplacementSpace<dim>         &space,
                              const std::vector<ContactPoint<dim>> &points) const;
  /** The deformable body on a side; null if it is rigid. */
  const Body<dim> *deformable(const ContactPoint<dim> &point, const unsigned int side) const
  {
    const Body<dim> &body = bodies[side == 0 ? pairs[point.pair].a : pairs[point.pair].b];
    return body.is_rigid() ? nullptr : &body;
  }

  const std::vector<Body<dim>>   &bodies;
  const std::vector<ContactPair> &pairs;
  const std::vector<NodeStencil>  stencils;
  const bool                      has_start, has_ratios;
  const Vector                    u_n, ratios;
  std::size_t                     n_used = 0; //!< of the stencils
};

template <int dim>
std::vector<NodeStencil>
Stencils<dim>::at(const DisplacementSpace<dim>         &space,
                  const std::vector<ContactPoint<dim>> &points) const
{
  std::vector<unsigned int>       of_bodies;
  std::vector<dealii::Point<dim>> places;
  for (const ContactPoint<dim> &point : points)
    for (const unsigned int side : {0, 1})
      if (const Body<dim> *body = deformable(point, side))
        {
          of_bodies.push_back(body - bodies.data());
          places.push_back(point.feet[side]);
        }
  return space.stencils(of_bodies, places);
}

template <int dim>
PointStencil<dim>
Stencils<dim>::next(const ContactPoint<dim> &point)
{
  PointStencil<dim> result;
  double            compliance = 0., secant_compliance = 0.;
  for (const unsigned int side : {0, 1})
    if (const Body<dim> *body = deformable(point, side))
      {
        const NodeStencil &stencil = stencils[n_used++];
        const double       sign    = side == 0 ? -1. : 1.;
        double             ratio   = has_ratios ? 0. : 1.;
        for (const auto &[node, weight] : stencil)
          {
            auto &entry = result.nodes[node];
            entry       = {entry.first + sign * weight, sign};
            if (has_ratios)
              ratio += weight * ratios(node);
            for (unsigned int d = 0; d < dim && has_start; ++d)
              result.moved[side][d] += weight * u_n(node + d);
          }
        result.is_complete &= !stencil.empty();
        compliance += 1. / body->material->young();
        secant_compliance += 1. / (std::clamp(ratio, smallest_ratio, 1.) * body->material->young());
      }
  if (compliance > 0.)
    result.stiffness_ratio = compliance / secant_compliance;
  return result;
}
} // namespace

template <int dim>
ContactDiscretisation<dim>
level_set_surface(const DisplacementSpace<dim> &space, const LevelSetNodes<dim> &level_set_nodes,
                  const std::vector<Body<dim>> &bodies, const std::vector<ContactPair> &pairs,
                  const double shift, const IncrementPrediction<dim> &prediction,
                  const dealii::TrilinosWrappers::MPI::Vector *start_displacement,
                  const dealii::TrilinosWrappers::MPI::Vector *secant_ratios)
{
  const ExactDistances<dim> distances(bodies, space.grid.finest_size());
  const InitialGaps<dim>    initial_gaps(bodies, pairs, 2. * shift, level_set_nodes.basis().degree);
  const bool                moves = std::any_of(bodies.begin(), bodies.end(),
                                                [](const Body<dim> &body) { return body.law != nullptr; });
  std::vector<ContactPoint<dim>> points
    = contact_surface(space, level_set_nodes, bodies, pairs, shift, distances, moves || prediction);
  const Feet<dim> feet(space.grid, level_set_nodes, bodies, pairs, distances);
  for (ContactPoint<dim> &point : points)
    feet.find(prediction, point);
  Stencils<dim> stencils(space, bodies, pairs, points, start_displacement, secant_ratios);
  ContactDiscretisation<dim> result{{}, JumpOperator<dim>(space, bodies, pairs)};
  for (ContactPoint<dim> &point : points)
    {
      PointStencil<dim> stencil = stencils.next(point);
      if (!stencil.is_complete)
        continue;
      if (initial_gaps.are_needed(point.pair))
        {
          const ContactPair &pair = pairs[point.pair];
          for (const unsigned int side : {0, 1})
            if (const Body<dim> &body = bodies[side == 0 ? pair.a : pair.b]; body.is_rigid())
              stencil.moved[side]
                = body.pose.displacement(body.pose.initial_position(point.feet[side]));
          initial_gaps.apply(stencil.moved, point);
        }
      point.stiffness_ratio = stencil.stiffness_ratio;
      result.jump_operator.append(point, stencil.nodes);
      result.points.push_back(point);
    }
  return result;
}

#define SCREE_INSTANTIATE(dim)                                                                  \
  template ContactDiscretisation<dim> level_set_surface(                                        \
    const DisplacementSpace<dim> &, const LevelSetNodes<dim> &, const std::vector<Body<dim>> &, \
    const std::vector<ContactPair> &, const double, const IncrementPrediction<dim> &,           \
    const dealii::TrilinosWrappers::MPI::Vector *, const dealii::TrilinosWrappers::MPI::Vector *);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
