#include <scree/base/sort_and_unite.h>
#include <scree/contact/jump_operator.h>

#include <algorithm>

namespace scree
{
template <int dim>
JumpOperator<dim>::JumpOperator(const DisplacementSpace<dim>   &space,
                                const std::vector<Body<dim>>   &bodies,
                                const std::vector<ContactPair> &pairs)
    : rigid_sides(pairs.size())
{
  std::map<unsigned int, unsigned int> partner_of_body;
  for (unsigned int p = 0; p < pairs.size(); ++p)
    for (const auto &[b, sign] : {std::make_pair(pairs[p].a, -1.), std::make_pair(pairs[p].b, 1.)})
      {
        const Body<dim> &body = bodies[b];
        if (!body.is_rigid())
          continue;
        if (partner_of_body.emplace(b, rigid_partners.size()).second)
          {
            rigid_partners.push_back(
              {b, body.rigid, space.rigid_unknown(b), {}, body.pose, body.pose});
            for (unsigned int m = 0; m < n_rigid_components<dim>; ++m)
              if (body.rigid->is_free(m))
                rigid_partners.back().free_components.push_back(m);
          }
        rigid_sides[p].push_back({partner_of_body[b], sign});
      }
}

template <int dim>
void
JumpOperator<dim>::append(const ContactPoint<dim> &point, const NodeWeights &nodes)
{
  const bool same
    = !groups.empty() && groups.back().n_nodes == nodes.size() && groups.back().pair == point.pair
      && std::equal(nodes.begin(), nodes.end(), group_nodes.begin() + groups.back().first_node,
                    [](const auto &entry, const DofIndex node) { return entry.first == node; });
  if (same)
    ++groups.back().n_points;
  else
    {
      groups.push_back({point.pair, static_cast<unsigned int>(pair_of_point.size()), 1,
                        static_cast<unsigned int>(group_nodes.size()),
                        static_cast<unsigned int>(nodes.size()),
                        static_cast<unsigned int>(stencil_weights.size())});
      for (const auto &[node, entry] : nodes)
        {
          group_nodes.push_back(node);
          group_sides.push_back(entry.second);
        }
    }
  for (const auto &[node, entry] : nodes)
    stencil_weights.push_back(entry.first);
  pair_of_point.push_back(point.pair);
  if (rigid_partners.empty())
    return;
  rigid_feet.emplace_back();
  for (const RigidSide &side : rigid_sides[point.pair])
    {
      const RigidPose<dim> &pose = rigid_partners[side.partner].start_pose;
      RigidFoot            &foot = rigid_feet.back()[side.number()];
      foot.X                     = pose.initial_position(point.feet[side.number()]);
      foot.start                 = pose.displacement(foot.X);
    }
}

template <int dim>
void
JumpOperator<dim>::find_places(const Vector &u)
{
  const Epetra_BlockMap &map = u.trilinos_vector().Map();
  if (map_of_places && map_of_places->DataPtr() == map.DataPtr()
      && places.size() == group_nodes.size() * dim)
    return;
  map_of_places = map;
  places.clear();
  places.reserve(group_nodes.size() * dim);
  for (const DofIndex node : group_nodes)
    for (unsigned int d = 0; d < dim; ++d)
      {
        places.push_back(map.LID(static_cast<int>(node + d)));
        Assert(places.back() >= 0, dealii::ExcMessage("A contact stencil is not in the vector."));
      }
}

template <int dim>
ContactJumps<dim>
JumpOperator<dim>::evaluate(const Vector &u)
{
  for (RigidPartner &partner : rigid_partners)
    {
      typename RigidPose<dim>::Unknowns q;
      for (unsigned int m = 0; m < q.size(); ++m)
        q[m] = u(partner.first_unknown + m);
      partner.pose = RigidPose<dim>(*partner.rigid, q);
    }
  ContactJumps<dim> result;
  result.jumps.resize(pair_of_point.size());
  result.means.resize(pair_of_point.size());
  std::vector<double> nodal;
  find_places(u);
  const double *values = u.trilinos_vector()[0];
  for (const Group &group : groups)
    {
      nodal.resize(group.n_nodes * dim);
      for (unsigned int i = 0; i < group.n_nodes * dim; ++i)
        nodal[i] = values[places[group.first_node * dim + i]];
      const double *weight = stencil_weights.data() + group.first_weight;
      const double *sides  = group_sides.data() + group.first_node;
      for (unsigned int p = group.first_point; p < group.first_point + group.n_points;
           ++p, weight += group.n_nodes)
        {
          dealii::Tensor<1, dim> jump, sum;
          for (unsigned int i = 0; i < group.n_nodes; ++i)
            for (unsigned int d = 0; d < dim; ++d)
              {
                jump[d] += weight[i] * nodal[i * dim + d];
                sum[d] += sides[i] * weight[i] * nodal[i * dim + d];
              }
          for (const RigidSide &side : rigid_sides[group.pair])
            {
              const RigidFoot             &foot = rigid_feet[p][side.number()];
              const dealii::Tensor<1, dim> motion
                = rigid_partners[side.partner].pose.displacement(foot.X) - foot.start;
              jump += side.sign * motion;
              sum += motion;
            }
          result.jumps[p] = jump;
          result.means[p] = 0.5 * sum;
        }
    }
  return result;
}

template <int dim>
ContactForces<dim>
JumpOperator<dim>::forces(std::vector<dealii::Tensor<1, dim>> &&of_points) const
{
  ContactForces<dim> result{std::move(of_points), {}};
  result.of_rigid.resize(rigid_partners.size());
  for (unsigned int p = 0; p < rigid_feet.size(); ++p)
    if (result.of_points[p] != dealii::Tensor<1, dim>())
      for (const RigidSide &side : rigid_sides[pair_of_point[p]])
        result.of_rigid[side.partner].add(rigid_feet[p][side.number()].X
                                            - rigid_partners[side.partner].rigid->reference_point,
                                          side.sign * result.of_points[p]);
  return result;
}

template <int dim>
typename RigidPose<dim>::Load
JumpOperator<dim>::rigid_load(const unsigned int body, const ContactForces<dim> &forces) const
{
  for (unsigned int i = 0; i < forces.of_rigid.size(); ++i)
    if (rigid_partners[i].body == body)
      return forces.of_rigid[i];
  return {};
}

template <int dim>
std::vector<DofIndex>
JumpOperator<dim>::unknowns(const Group &group) const
{
  std::vector<DofIndex> result
    = unknowns_of_nodes<dim>(group_nodes.data() + group.first_node, group.n_nodes);
  for (const RigidSide &side : rigid_sides[group.pair])
    for (const unsigned int m : rigid_partners[side.partner].free_components)
      result.push_back(rigid_partners[side.partner].first_unknown + m);
  return result;
}

template <int dim>
void
JumpOperator<dim>::add_forces(const ContactForces<dim> &forces, Vector &residual) const
{
  std::vector<double> block;
  for (const Group &group : groups)
    {
      const auto *force = forces.of_points.data() + group.first_point;
      if (std::all_of(force, force + group.n_points,
                      [](const auto &f) { return f == dealii::Tensor<1, dim>(); }))
        continue;
      block.assign(group.n_nodes * dim, 0.);
      const double *weight = stencil_weights.data() + group.first_weight;
      for (unsigned int p = group.first_point; p < group.first_point + group.n_points;
           ++p, weight += group.n_nodes)
        for (unsigned int i = 0; i < group.n_nodes; ++i)
          for (unsigned int d = 0; d < dim; ++d)
            block[i * dim + d] += weight[i] * forces.of_points[p][d];
      residual.add(unknowns_of_nodes<dim>(group_nodes.data() + group.first_node, group.n_nodes),
                   block);
    }
  for (unsigned int i = 0; i < forces.of_rigid.size(); ++i)
    {
      const auto force = rigid_partners[i].pose.generalised_force(forces.of_rigid[i]);
      for (unsigned int m = 0; m < force.size(); ++m)
        residual.add({rigid_partners[i].first_unknown + m}, std::vector<double>{force[m]});
    }
}

template <int dim>
void
JumpOperator<dim>::add_rigid_couplings(const Group &group, const unsigned int point,
                                       const double                 *weight,
                                       const dealii::Tensor<2, dim> &stiffness,
                                       dealii::FullMatrix<double>   &block) const
{
  // The columns d[[u]]/dq of the rigid sides.
  std::vector<dealii::Tensor<1, dim>> columns;
  for (const RigidSide &side : rigid_sides[group.pair])
    {
      const RigidPartner &partner    = rigid_partners[side.partner];
      const auto          derivative = partner.pose.derivative(rigid_feet[point][side.number()].X);
      for (const unsigned int m : partner.free_components)
        columns.push_back(side.sign * derivative[m]);
    }
  const unsigned int first = group.n_nodes * dim;
  for (unsigned int m = 0; m < columns.size(); ++m)
    {
      const dealii::Tensor<1, dim> right = stiffness * columns[m], left = columns[m] * stiffness;
      for (unsigned int i = 0; i < group.n_nodes; ++i)
        for (unsigned int d = 0; d < dim; ++d)
          {
            block(i * dim + d, first + m) += weight[i] * right[d];
            block(first + m, i * dim + d) += weight[i] * left[d];
          }
      for (unsigned int n = 0; n < columns.size(); ++n)
        block(first + n, first + m) += columns[n] * right;
    }
}

template <int dim>
void
JumpOperator<dim>::add_stiffness(const std::vector<dealii::Tensor<2, dim>> &D, Matrix &matrix) const
{
  dealii::FullMatrix<double> block;
  for (const Group &group : groups)
    {
      const auto *of_group = D.data() + group.first_point;
      if (std::all_of(of_group, of_group + group.n_points,
                      [](const auto &D_p) { return D_p.norm_square() == 0.; }))
        continue;
      const std::vector<DofIndex> indices = unknowns(group);
      block.reinit(indices.size(), indices.size());
      const double *weight = stencil_weights.data() + group.first_weight;
      for (unsigned int p = group.first_point; p < group.first_point + group.n_points;
           ++p, weight += group.n_nodes)
        {
          const dealii::Tensor<2, dim> &D_p = D[p];
          if (D_p.norm_square() == 0.)
            continue;
          for (unsigned int i = 0; i < group.n_nodes; ++i)
            for (unsigned int j = 0; j < group.n_nodes; ++j)
              for (unsigned int d = 0; d < dim; ++d)
                for (unsigned int e = 0; e < dim; ++e)
                  block(i * dim + d, j * dim + e) += weight[i] * weight[j] * D_p[d][e];
          if (indices.size() > group.n_nodes * dim)
            add_rigid_couplings(group, p, weight, D_p, block);
        }
      matrix.add(indices, block);
    }
}

template <int dim>
void
JumpOperator<dim>::add_curvature(const ContactForces<dim> &forces, Matrix &matrix) const
{
  for (unsigned int i = 0; i < forces.of_rigid.size(); ++i)
    {
      const RigidPartner        &partner   = rigid_partners[i];
      const dealii::Tensor<2, 3> curvature = partner.pose.curvature(forces.of_rigid[i]);
      for (const unsigned int m : partner.free_components)
        for (const unsigned int n : partner.free_components)
          if (m >= dim && n >= dim)
            matrix.add(partner.first_unknown + m, partner.first_unknown + n,
                       -curvature[rotation_axis<dim>(m)][rotation_axis<dim>(n)]);
    }
}

template <int dim>
SparseRows
JumpOperator<dim>::rows() const
{
  SparseRows result;
  for (const Group &group : groups)
    for (unsigned int p = 0; p < group.n_points; ++p)
      for (unsigned int d = 0; d < dim; ++d)
        {
          for (unsigned int i = 0; i < group.n_nodes; ++i)
            {
              result.columns.push_back(group_nodes[group.first_node + i] + d);
              result.values.push_back(stencil_weights[group.first_weight + p * group.n_nodes + i]);
            }
          result.begin.push_back(result.columns.size());
        }
  return result;
}

template <int dim>
std::vector<DofIndex>
JumpOperator<dim>::all_unknowns() const
{
  std::vector<DofIndex> nodes = group_nodes;
  sort_and_unite(nodes);
  std::vector<DofIndex> result = unknowns_of_nodes<dim>(nodes.data(), nodes.size());
  for (const Group &group : groups)
    for (const RigidSide &side : rigid_sides[group.pair])
      for (const unsigned int m : rigid_partners[side.partner].free_components)
        result.push_back(rigid_partners[side.partner].first_unknown + m);
  sort_and_unite(result);
  return result;
}

template <int dim>
void
JumpOperator<dim>::complete_groups(std::vector<bool> &points) const
{
  for (const Group &group : groups)
    {
      const auto first = points.begin() + group.first_point, end = first + group.n_points;
      std::fill(first, end, std::find(first, end, true) != end);
    }
}

template <int dim>
std::vector<std::vector<DofIndex>>
JumpOperator<dim>::couplings(const std::vector<bool> &points) const
{
  std::vector<std::vector<DofIndex>> result;
  for (const Group &group : groups)
    {
      const auto first = points.begin() + group.first_point, end = first + group.n_points;
      if (std::find(first, end, true) != end)
        result.push_back(unknowns(group));
    }
  return result;
}

template class JumpOperator<2>;
template class JumpOperator<3>;
} // namespace scree
