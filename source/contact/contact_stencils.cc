#include <scree/bodies/thin_body.h>
#include <scree/contact/contact_points.h>
#include <scree/contact/exact_distance.h>
#include <scree/level_set/closest_point.h>

#include <algorithm>
#include <map>

// Where the displacements of contact points are taken.
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
} // namespace

template <int dim>
void
ContactPoints<dim>::find_rigid_partners(const Fields<dim>            &fields,
                                        const std::vector<Body<dim>> &bodies)
{
  std::map<unsigned int, unsigned int> partner_of_body;
  rigid_sides_of_pair.resize(pairs().size());
  for (unsigned int p = 0; p < pairs().size(); ++p)
    for (const auto &[b, sign] :
         {std::make_pair(pairs()[p].a, -1.), std::make_pair(pairs()[p].b, 1.)})
      {
        const Body<dim> &body = bodies[b];
        if (!body.is_rigid())
          continue;
        if (partner_of_body.emplace(b, rigid_partners.size()).second)
          {
            rigid_partners.push_back(
              {b, body.rigid, fields.rigid_unknown(b), {}, body.pose, body.pose, {}});
            for (unsigned int m = 0; m < n_rigid_components<dim>; ++m)
              if (body.rigid->is_free(m))
                rigid_partners.back().free_components.push_back(m);
          }
        rigid_sides_of_pair[p].push_back({partner_of_body[b], sign});
      }
}

template <int dim>
struct ContactPoints<dim>::Feet
{
  std::vector<unsigned int>             bodies; //!< the deformable ones of each point
  std::vector<dealii::Point<dim>>       on_deformable;
  std::vector<std::array<RigidFoot, 2>> on_rigid; //!< of each point; empty without rigid bodies
};

template <int dim>
typename ContactPoints<dim>::Feet
ContactPoints<dim>::find_feet(const Fields<dim> &fields, const std::vector<Body<dim>> &bodies,
                              const Prediction &prediction, const ExactDistances<dim> &distances)
{
  Feet       feet;
  const auto box = fields.grid.box();
  const auto foot_on
    = [&](const unsigned int body, const dealii::Point<dim> &start, const bool is_exact) {
        return is_exact ? distances.foot(body, start)
                        : project(bodies[body].level_set, start, fields.basis.degree).point;
      };
  feet.on_rigid.resize(rigid_partners.empty() ? 0 : contact_points.size());
  for (unsigned int i = 0; i < contact_points.size(); ++i)
    {
      ContactPoint<dim>        &point = contact_points[i];
      const ContactPair        &pair  = pairs()[point.pair];
      const dealii::Point<dim> &x     = point.position;
      dealii::Tensor<1, dim>    slide;
      if (prediction)
        {
          const auto expected = expected_slide(point, pair, distances, prediction);
          point.initial_gap += (point.normal - expected.normal) * expected.jump;
          point.normal = expected.normal;
          slide        = expected.slide;
        }
      for (const auto &[body, start] :
           {std::make_pair(pair.a, x + 0.5 * slide), std::make_pair(pair.b, x - 0.5 * slide)})
        if (!bodies[body].is_rigid())
          {
            dealii::Point<dim> foot = foot_on(body, start, point.is_exact);
            if (!point.is_exact)
              foot = foot_on_thin_body<dim>(bodies[body], start,
                                            body == pair.a ? point.normal : -point.normal,
                                            2. * point.cell_size)
                       .value_or(foot);
            for (unsigned int d = 0; d < dim; ++d)
              foot[d] = std::clamp(foot[d], box.lower_bound(d), box.upper_bound(d));
            feet.bodies.push_back(body);
            feet.on_deformable.push_back(foot);
            point.feet[body == pair.a ? 0 : 1] = foot;
          }
      for (const RigidSide &side : rigid_sides_of_pair[point.pair])
        {
          const RigidPartner &partner = rigid_partners[side.partner];
          RigidFoot          &foot    = feet.on_rigid[i][side.number()];
          point.feet[side.number()]
            = foot_on(partner.body, x - 0.5 * side.sign * slide, point.is_exact);
          foot.X     = partner.start_pose.initial_position(point.feet[side.number()]);
          foot.start = partner.start_pose.displacement(foot.X);
        }
    }
  return feet;
}

template <int dim>
void
ContactPoints<dim>::append_stencil(const ContactPoint<dim>        &point,
                                   const NodeWeights              &weights_and_sides,
                                   std::vector<ContactPoint<dim>> &kept)
{
  const bool same
    = !groups.empty() && groups.back().n_nodes == weights_and_sides.size()
      && kept.back().pair == point.pair
      && std::equal(weights_and_sides.begin(), weights_and_sides.end(),
                    group_nodes.begin() + groups.back().first_node,
                    [](const auto &entry, const DofIndex node) { return entry.first == node; });
  if (same)
    ++groups.back().n_points;
  else
    {
      groups.push_back({static_cast<unsigned int>(kept.size()), 1,
                        static_cast<unsigned int>(group_nodes.size()),
                        static_cast<unsigned int>(weights_and_sides.size()),
                        static_cast<unsigned int>(stencil_weights.size())});
      for (const auto &[node, entry] : weights_and_sides)
        {
          group_nodes.push_back(node);
          group_sides.push_back(entry.second);
        }
    }
  for (const auto &[node, entry] : weights_and_sides)
    stencil_weights.push_back(entry.first);
  kept.push_back(point);
}

template <int dim>
std::vector<double>
ContactPoints<dim>::find_stencils(const Fields<dim> &fields, const std::vector<Body<dim>> &bodies,
                                  const Prediction          &prediction,
                                  const ExactDistances<dim> &distances,
                                  const InitialGaps<dim>    &initial_gaps,
                                  const Vector *start_displacement, const Vector *secant_ratios)
{
  const Feet                     feet     = find_feet(fields, bodies, prediction, distances);
  const std::vector<NodeStencil> stencils = fields.stencils(feet.bodies, feet.on_deformable);
  const Vector                   u_n      = values_at(stencils, start_displacement, dim);
  const Vector                   ratios   = values_at(stencils, secant_ratios, dim);
  std::vector<ContactPoint<dim>> kept;
  std::vector<double>            flow_ratios;
  auto                           stencil = stencils.begin();
  for (unsigned int i = 0; i < contact_points.size(); ++i)
    {
      ContactPoint<dim>                    &point = contact_points[i];
      const ContactPair                    &pair  = pairs()[point.pair];
      NodeWeights                           weights_and_sides;
      bool                                  is_found   = true;
      double                                compliance = 0., secant_compliance = 0.;
      std::array<dealii::Tensor<1, dim>, 2> moved;
      for (const auto &[body, sign] : {std::make_pair(pair.a, -1.), std::make_pair(pair.b, 1.)})
        if (!bodies[body].is_rigid())
          {
            is_found &= !stencil->empty();
            double ratio = secant_ratios ? 0. : 1.;
            for (const auto &[node, weight] : *stencil)
              {
                auto &entry = weights_and_sides[node];
                entry       = {entry.first + sign * weight, sign};
                if (secant_ratios)
                  ratio += weight * ratios(node);
                for (unsigned int d = 0; d < dim && start_displacement; ++d)
                  moved[sign > 0.][d] += weight * u_n(node + d);
              }
            ++stencil;
            compliance += 1. / bodies[body].material->young();
            secant_compliance
              += 1. / (std::clamp(ratio, smallest_ratio, 1.) * bodies[body].material->young());
          }
      if (!is_found)
        continue; // the surface ends here: one of the bodies is clipped by the box
      if (initial_gaps.are_needed(point.pair))
        {
          for (const RigidSide &side : rigid_sides_of_pair[point.pair])
            moved[side.number()] = feet.on_rigid[i][side.number()].start;
          initial_gaps.apply(moved, point);
        }
      append_stencil(point, weights_and_sides, kept);
      flow_ratios.push_back(compliance > 0. ? compliance / secant_compliance : 1.);
      if (!rigid_partners.empty())
        contact_feet.push_back(feet.on_rigid[i]);
    }
  contact_points = kept;
  return flow_ratios;
}

#define SCREE_INSTANTIATE(dim)                                                                          \
  template void                ContactPoints<dim>::find_rigid_partners(const Fields<dim> &,             \
                                                                       const std::vector<Body<dim>> &); \
  template std::vector<double> ContactPoints<dim>::find_stencils(                                       \
    const Fields<dim> &, const std::vector<Body<dim>> &, const Prediction &,                            \
    const ExactDistances<dim> &, const InitialGaps<dim> &, const Vector *, const Vector *);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
