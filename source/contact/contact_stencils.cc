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
/** A vector at the nodes of stencils, which may lie on any process; empty for null. */
dealii::TrilinosWrappers::MPI::Vector
values_at(const std::vector<NodeStencil>              &stencils,
          const dealii::TrilinosWrappers::MPI::Vector *vector, const unsigned int dim)
{
  dealii::TrilinosWrappers::MPI::Vector result;
  if (!vector)
    return result;
  const dealii::IndexSet owned = vector->locally_owned_elements();
  dealii::IndexSet       relevant(owned);
  for (const NodeStencil &stencil : stencils)
    for (const auto &[node, weight] : stencil)
      relevant.add_range(node, node + dim);
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
  rigid_sides_of_pair.resize(contact_pairs.size());
  for (unsigned int p = 0; p < contact_pairs.size(); ++p)
    for (const auto &[b, sign] :
         {std::make_pair(contact_pairs[p].a, -1.), std::make_pair(contact_pairs[p].b, 1.)})
      {
        const Body<dim> &body = bodies[b];
        if (!body.is_rigid())
          continue;
        if (partner_of_body.emplace(b, rigid_partners.size()).second)
          {
            const RigidPose<dim> start(*body.rigid, body.pose);
            rigid_partners.push_back(
              {b, body.rigid, fields.rigid_unknown(b), {}, start, start, {}});
            for (unsigned int m = 0; m < n_rigid_components<dim>; ++m)
              if (body.rigid->is_free(m))
                rigid_partners.back().free_components.push_back(m);
          }
        rigid_sides_of_pair[p].push_back({partner_of_body[b], sign});
      }
}

template <int dim>
void
ContactPoints<dim>::find_stencils(const Fields<dim> &fields, const std::vector<Body<dim>> &bodies,
                                  const Prediction          &prediction,
                                  const ExactDistances<dim> &distances,
                                  const InitialGaps<dim>    &initial_gaps,
                                  const Vector              *start_displacement)
{
  const auto                      box = fields.grid.box();
  std::vector<unsigned int>       of_body;
  std::vector<dealii::Point<dim>> projected;
  const auto                      foot_on
    = [&](const unsigned int body, const dealii::Point<dim> &start, const bool is_exact) {
        return is_exact ? distances.foot(body, start)
                        : project(bodies[body].level_set, start, fields.basis.degree).point;
      };
  std::vector<std::array<RigidFoot, 2>> feet(rigid_partners.empty() ? 0 : contact_points.size());
  for (unsigned int i = 0; i < contact_points.size(); ++i)
    {
      ContactPoint<dim>        &point = contact_points[i];
      const ContactPair        &pair  = contact_pairs[point.pair];
      const dealii::Point<dim> &x     = point.position;
      dealii::Tensor<1, dim>    slide;
      if (prediction)
        {
          const ExpectedSlide<dim> expected = expected_slide(point, pair, prediction);
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
            of_body.push_back(body);
            projected.push_back(foot);
            point.feet[body == pair.a ? 0 : 1] = foot;
          }
      for (const RigidSide &side : rigid_sides_of_pair[contact_points[i].pair])
        {
          const RigidPartner &partner = rigid_partners[side.partner];
          RigidFoot          &foot    = feet[i][side.number()];
          point.feet[side.number()]
            = foot_on(partner.body, x - 0.5 * side.sign * slide, point.is_exact);
          foot.X     = partner.start_pose.initial_position(point.feet[side.number()]);
          foot.start = partner.start_pose.displacement(foot.X);
        }
    }
  const std::vector<NodeStencil> stencils = fields.stencils(of_body, projected);
  const Vector                   u_n      = values_at(stencils, start_displacement, dim);

  std::vector<ContactPoint<dim>> kept;
  auto                           stencil = stencils.begin();
  for (unsigned int i = 0; i < contact_points.size(); ++i)
    {
      const ContactPair                    &pair = contact_pairs[contact_points[i].pair];
      std::map<DofIndex, double>            jump, sides;
      bool                                  is_found = true;
      std::array<dealii::Tensor<1, dim>, 2> moved;
      for (const auto &[body, sign] : {std::make_pair(pair.a, -1.), std::make_pair(pair.b, 1.)})
        if (!bodies[body].is_rigid())
          {
            is_found &= !stencil->empty();
            for (const auto &[node, weight] : *stencil)
              {
                jump[node] += sign * weight;
                sides[node] = sign;
                for (unsigned int d = 0; d < dim && start_displacement; ++d)
                  moved[sign > 0.][d] += weight * u_n(node + d);
              }
            ++stencil;
          }
      if (!is_found)
        continue; // the surface ends here: one of the bodies is clipped by the box
      if (initial_gaps.are_needed(contact_points[i].pair))
        {
          for (const RigidSide &side : rigid_sides_of_pair[contact_points[i].pair])
            moved[side.number()] = feet[i][side.number()].start;
          initial_gaps.apply(moved, contact_points[i]);
        }
      std::vector<DofIndex> nodes;
      for (const auto &[node, weight] : jump)
        nodes.push_back(node);
      const bool same
        = !groups.empty() && groups.back().n_nodes == nodes.size()
          && kept.back().pair == contact_points[i].pair
          && std::equal(nodes.begin(), nodes.end(), group_nodes.begin() + groups.back().first_node);
      if (same)
        ++groups.back().n_points;
      else
        {
          groups.push_back({static_cast<unsigned int>(kept.size()), 1,
                            static_cast<unsigned int>(group_nodes.size()),
                            static_cast<unsigned int>(nodes.size()),
                            static_cast<unsigned int>(stencil_weights.size())});
          group_nodes.insert(group_nodes.end(), nodes.begin(), nodes.end());
          for (const auto &[node, side] : sides)
            group_sides.push_back(side);
        }
      for (const auto &[node, weight] : jump)
        stencil_weights.push_back(weight);
      kept.push_back(contact_points[i]);
      if (!rigid_partners.empty())
        contact_feet.push_back(feet[i]);
    }
  contact_points = kept;
}

#define SCREE_INSTANTIATE(dim)                                                           \
  template void ContactPoints<dim>::find_rigid_partners(const Fields<dim> &,             \
                                                        const std::vector<Body<dim>> &); \
  template void ContactPoints<dim>::find_stencils(                                       \
    const Fields<dim> &, const std::vector<Body<dim>> &, const Prediction &,             \
    const ExactDistances<dim> &, const InitialGaps<dim> &, const Vector *);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
