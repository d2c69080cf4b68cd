#include <scree/base/sort_and_unite.h>
#include <scree/contact/contact_discretisation.h>

#include <algorithm>
#include <cmath>

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
  sort_and_unite(unknowns);
  dealii::IndexSet relevant(owned);
  relevant.add_indices(unknowns.begin(), unknowns.end());
  relevant.compress();
  result.reinit(owned, relevant, vector->get_mpi_communicator());
  result = *vector;
  return result;
}

/** The stencil of a place that is a node, without the others; empty if the node hangs. */
NodeStencil
of_one_node(const NodeStencil &stencil)
{
  constexpr double round_off = 1e-6;
  NodeStencil      result;
  for (const auto &[node, weight] : stencil)
    if (std::abs(weight) > round_off)
      result.emplace_back(node, 1.);
  return result.size() == 1 ? result : NodeStencil();
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
  std::vector<bool>               at_nodes;
  for (const ContactPoint<dim> &point : points)
    for (const unsigned int side : {0, 1})
      if (const Body<dim> *body = deformable(point, side))
        {
          of_bodies.push_back(body - bodies.data());
          places.push_back(point.feet[side]);
          at_nodes.push_back(point.is_node);
        }
  std::vector<NodeStencil> result = space.stencils(of_bodies, places);
  for (std::size_t i = 0; i < result.size(); ++i)
    if (at_nodes[i])
      result[i] = of_one_node(result[i]);
  return result;
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
discretise_contact(const DisplacementSpace<dim> &space, const std::vector<Body<dim>> &bodies,
                   const std::vector<ContactPair> &pairs, std::vector<ContactPoint<dim>> &&points,
                   InitialGaps<dim>                            &initial_gaps,
                   const dealii::TrilinosWrappers::MPI::Vector *start_displacement,
                   const dealii::TrilinosWrappers::MPI::Vector *secant_ratios,
                   StartGaps                                   *start_gaps)
{
  StartGaps of_this_start;
  initial_gaps.adjust_pairs(points, space.grid.communicator(),
                            start_gaps != nullptr ? *start_gaps : of_this_start);
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

#define SCREE_INSTANTIATE(dim)                                                                    \
  template ContactDiscretisation<dim> discretise_contact(                                         \
    const DisplacementSpace<dim> &, const std::vector<Body<dim>> &,                               \
    const std::vector<ContactPair> &, std::vector<ContactPoint<dim>> &&, InitialGaps<dim> &,      \
    const dealii::TrilinosWrappers::MPI::Vector *, const dealii::TrilinosWrappers::MPI::Vector *, \
    StartGaps *);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
