#include <scree/base/exceptions.h>
#include <scree/contact/contact_points.h>
#include <scree/contact/exact_distance.h>
#include <scree/contact/penalty.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace scree
{
namespace
{
/** E of the penalties of a pair. A rigid body has 1/E = 0. */
template <int dim>
double
modulus_of(const ContactPair &pair, const Body<dim> &a, const Body<dim> &b)
{
  if (!std::isnan(pair.law.penalty_modulus))
    return pair.law.penalty_modulus;
  require(!a.is_rigid() || !b.is_rigid(), "Contact/" + pair.law.name,
          "contact between the rigid bodies '" + a.name + "' and '" + b.name
            + "' needs a stiffness",
          "set Penalty modulus, or Law = none for this pair");
  const auto compliance
    = [](const Body<dim> &body) { return body.is_rigid() ? 0. : 1. / body.material->young(); };
  return 2. / (compliance(a) + compliance(b));
}
} // namespace

template <int dim>
ContactPoints<dim>::ContactPoints(const Fields<dim>              &fields,
                                  const LevelSetNodes<dim>       &level_set_nodes,
                                  const std::vector<Body<dim>>   &bodies,
                                  const std::vector<ContactPair> &pairs, const double shift,
                                  const Prediction &prediction, const Vector *start_displacement,
                                  const Vector *secant_ratios)
    : contact_laws(pairs)
{
  for (const ContactPair &pair : pairs)
    pair_modulus.push_back(modulus_of(pair, bodies[pair.a], bodies[pair.b]));
  find_rigid_partners(fields, bodies);
  const ExactDistances<dim> distances(bodies, fields.grid.finest_size());
  const bool                moves = std::any_of(bodies.begin(), bodies.end(),
                                                [](const Body<dim> &body) { return body.law != nullptr; });
  contact_points = contact_surface(fields, level_set_nodes, bodies, pairs, shift, distances,
                                   moves || prediction);
  const std::vector<double> flow_ratios
    = find_stencils(fields, bodies, prediction, distances,
                    InitialGaps<dim>(bodies, pairs, 2. * shift, fields.basis.degree),
                    start_displacement, secant_ratios);
  contact_enforcement = std::make_unique<Penalty<dim>>(penalties(flow_ratios));
  all_points.resize(contact_points.size());
  std::iota(all_points.begin(), all_points.end(), 0u);
  contact_jumps.resize(contact_points.size());
  contact_means.resize(contact_points.size());
  contact_responses.resize(contact_points.size());
}

template <int dim>
ContactHistory<dim>
ContactPoints<dim>::initial_history() const
{
  const std::vector<dealii::Tensor<1, dim>> zeros(contact_points.size());
  return {zeros, zeros, std::vector<double>(contact_points.size())};
}

template <int dim>
ContactHistory<dim>
ContactPoints<dim>::current_history() const
{
  ContactHistory<dim> history = initial_history();
  history.jump                = contact_jumps;
  for (unsigned int i = 0; i < contact_points.size(); ++i)
    {
      history.tau[i]      = contact_responses[i].tau;
      history.pressure[i] = contact_responses[i].pressure;
    }
  return history;
}

template <int dim>
std::vector<ContactStiffness>
ContactPoints<dim>::penalties(const std::vector<double> &flow_ratios) const
{
  std::vector<ContactStiffness> result;
  for (unsigned int i = 0; i < contact_points.size(); ++i)
    {
      const ContactPoint<dim>     &point = contact_points[i];
      const ContactPairParameters &law   = pairs()[point.pair].law;
      const auto                   eps   = [&](const double factor) {
        return factor * flow_ratios[i] * pair_modulus[point.pair] / point.cell_size;
      };
      result.push_back({eps(law.normal_factor), eps(law.tangential_factor)});
    }
  return result;
}

template <int dim>
typename RigidPose<dim>::Load
ContactPoints<dim>::rigid_load(const unsigned int body) const
{
  for (const RigidPartner &partner : rigid_partners)
    if (partner.body == body)
      return partner.load;
  return {};
}

template <int dim>
std::vector<ContactResponse<dim>>
ContactPoints<dim>::responses_to(const std::vector<unsigned int>           &points,
                                 const std::vector<dealii::Tensor<1, dim>> &jumps,
                                 const ContactHistory<dim>                 &history) const
{
  const auto motions = contact_laws.motions(contact_points, points, jumps, history);
  return contact_laws.respond(contact_points, points, motions,
                              contact_enforcement->trial_tractions(points, motions, history));
}

template <int dim>
std::vector<double>
ContactPoints<dim>::overlaps(const MPI_Comm communicator) const
{
  std::vector<double> result(pairs().size(), 0.);
  for (const ContactPoint<dim> &point : contact_points)
    if (!pairs()[point.pair].law.kind->glues)
      result[point.pair] = std::max(result[point.pair], -point.initial_gap);
  dealii::Utilities::MPI::max(result, communicator, result);
  return result;
}

template <int dim>
void
ContactPoints<dim>::evaluate(const Vector &u, const ContactHistory<dim> &history)
{
  for (RigidPartner &partner : rigid_partners)
    {
      typename RigidPose<dim>::Unknowns q;
      for (unsigned int m = 0; m < q.size(); ++m)
        q[m] = u(partner.first_unknown + m);
      partner.pose = RigidPose<dim>(*partner.rigid, q);
      partner.load = {};
    }
  std::vector<double> nodal;
  for (const Group &group : groups)
    {
      nodal.resize(group.n_nodes * dim);
      for (unsigned int i = 0; i < group.n_nodes; ++i)
        for (unsigned int d = 0; d < dim; ++d)
          nodal[i * dim + d] = u(group_nodes[group.first_node + i] + d);
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
          for (const RigidSide &side : rigid_sides(group))
            {
              const RigidFoot             &foot = contact_feet[p][side.number()];
              const dealii::Tensor<1, dim> motion
                = rigid_partners[side.partner].pose.displacement(foot.X) - foot.start;
              jump += side.sign * motion;
              sum += motion;
            }
          contact_jumps[p] = jump;
          contact_means[p] = 0.5 * sum;
        }
    }
  contact_responses = responses_to(all_points, contact_jumps, history);
  for (unsigned int p = 0; p < (rigid_partners.empty() ? 0 : contact_points.size()); ++p)
    for (const RigidSide &side : rigid_sides_of_pair[contact_points[p].pair])
      rigid_partners[side.partner].load.add(
        contact_feet[p][side.number()].X - rigid_partners[side.partner].rigid->reference_point,
        side.sign * contact_points[p].weight
          * contact_responses[p].traction(contact_points[p].normal));
}

template <int dim>
std::vector<DofIndex>
ContactPoints<dim>::unknowns(const Group &group) const
{
  std::vector<DofIndex> result
    = unknowns_of_nodes<dim>(group_nodes.data() + group.first_node, group.n_nodes);
  for (const RigidSide &side : rigid_sides(group))
    for (const unsigned int m : rigid_partners[side.partner].free_components)
      result.push_back(rigid_partners[side.partner].first_unknown + m);
  return result;
}

template <int dim>
void
ContactPoints<dim>::add_to_residual(Vector &residual) const
{
  std::vector<double> block;
  for (const Group &group : groups)
    {
      block.assign(group.n_nodes * dim, 0.);
      const double *weight = stencil_weights.data() + group.first_weight;
      for (unsigned int p = group.first_point; p < group.first_point + group.n_points;
           ++p, weight += group.n_nodes)
        {
          const dealii::Tensor<1, dim> force
            = contact_points[p].weight * contact_responses[p].traction(contact_points[p].normal);
          for (unsigned int i = 0; i < group.n_nodes; ++i)
            for (unsigned int d = 0; d < dim; ++d)
              block[i * dim + d] += weight[i] * force[d];
        }
      residual.add(unknowns_of_nodes<dim>(group_nodes.data() + group.first_node, group.n_nodes),
                   block);
    }
  for (const RigidPartner &partner : rigid_partners)
    {
      const auto force = partner.pose.generalised_force(partner.load);
      for (unsigned int m = 0; m < force.size(); ++m)
        residual.add({partner.first_unknown + m}, std::vector<double>{force[m]});
    }
}

template <int dim>
void
ContactPoints<dim>::add_rigid_couplings(const Group &group, const unsigned int point,
                                        const double                 *weight,
                                        const dealii::Tensor<2, dim> &stiffness,
                                        dealii::FullMatrix<double>   &block) const
{
  // The columns d[[u]]/dq of the rigid sides.
  std::vector<dealii::Tensor<1, dim>> columns;
  for (const RigidSide &side : rigid_sides(group))
    {
      const RigidPartner &partner = rigid_partners[side.partner];
      const auto derivative       = partner.pose.derivative(contact_feet[point][side.number()].X);
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
ContactPoints<dim>::add_to_matrix(const std::vector<dealii::Tensor<2, dim>> &stiffness,
                                  dealii::TrilinosWrappers::SparseMatrix    &matrix) const
{
  dealii::FullMatrix<double> block;
  for (const Group &group : groups)
    {
      const std::vector<DofIndex> indices = unknowns(group);
      block.reinit(indices.size(), indices.size());
      bool          is_stiff = false;
      const double *weight   = stencil_weights.data() + group.first_weight;
      for (unsigned int p = group.first_point; p < group.first_point + group.n_points;
           ++p, weight += group.n_nodes)
        {
          const dealii::Tensor<2, dim> &D = stiffness[p];
          if (D.norm_square() == 0.)
            continue;
          is_stiff = true;
          for (unsigned int i = 0; i < group.n_nodes; ++i)
            for (unsigned int j = 0; j < group.n_nodes; ++j)
              for (unsigned int d = 0; d < dim; ++d)
                for (unsigned int e = 0; e < dim; ++e)
                  block(i * dim + d, j * dim + e) += weight[i] * weight[j] * D[d][e];
          if (indices.size() > group.n_nodes * dim)
            add_rigid_couplings(group, p, weight, D, block);
        }
      if (is_stiff)
        matrix.add(indices, block);
    }
}

template <int dim>
void
ContactPoints<dim>::add_to_matrix(dealii::TrilinosWrappers::SparseMatrix &matrix) const
{
  std::vector<dealii::Tensor<2, dim>> stiffness(contact_points.size());
  for (unsigned int p = 0; p < contact_points.size(); ++p)
    if (contact_responses[p].status != ContactStatus::open)
      stiffness[p] = contact_points[p].weight * contact_responses[p].tangent;
  add_to_matrix(stiffness, matrix);
  // -f . d2u/dq2
  for (const RigidPartner &partner : rigid_partners)
    {
      const dealii::Tensor<2, 3> curvature = partner.pose.curvature(partner.load);
      for (const unsigned int m : partner.free_components)
        for (const unsigned int n : partner.free_components)
          if (m >= dim && n >= dim)
            matrix.add(partner.first_unknown + m, partner.first_unknown + n,
                       -curvature[rotation_axis<dim>(m)][rotation_axis<dim>(n)]);
    }
}

template <int dim>
dealii::Tensor<2, dim>
ContactPoints<dim>::glued_tangent(const unsigned int point) const
{
  const auto &n         = contact_points[point].normal;
  const auto  normal    = dealii::outer_product(n, n);
  const auto  stiffness = contact_enforcement->stiffness()[point];
  return contact_points[point].weight
         * (stiffness.normal * normal
            + stiffness.tangential * (dealii::unit_symmetric_tensor<dim>() - normal));
}

template <int dim>
void
ContactPoints<dim>::choose_glued(const bool only_closed)
{
  glued_tangents.assign(contact_points.size(), dealii::Tensor<2, dim>());
  for (unsigned int p = 0; p < contact_points.size(); ++p)
    if (!only_closed || contact_responses[p].status != ContactStatus::open)
      glued_tangents[p] = glued_tangent(p);
}

template <int dim>
void
ContactPoints<dim>::add_glued_to_matrix(dealii::TrilinosWrappers::SparseMatrix &matrix) const
{
  add_to_matrix(glued_tangents, matrix);
}

template <int dim>
std::vector<double>
ContactPoints<dim>::tangent_changes() const
{
  constexpr double    negligible = 1e-14;
  std::vector<double> changes;
  changes.reserve(contact_points.size() * dim * dim);
  for (unsigned int p = 0; p < contact_points.size(); ++p)
    {
      dealii::Tensor<2, dim> change = -glued_tangents[p];
      if (contact_responses[p].status != ContactStatus::open)
        change += contact_points[p].weight * contact_responses[p].tangent;
      if (change.norm() <= negligible * glued_tangents[p].norm())
        change = 0.;
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int e = 0; e < dim; ++e)
          changes.push_back(change[d][e]);
    }
  return changes;
}

template <int dim>
SparseRows
ContactPoints<dim>::jump_rows() const
{
  SparseRows rows;
  for (const Group &group : groups)
    for (unsigned int p = 0; p < group.n_points; ++p)
      for (unsigned int d = 0; d < dim; ++d)
        {
          for (unsigned int i = 0; i < group.n_nodes; ++i)
            {
              rows.columns.push_back(group_nodes[group.first_node + i] + d);
              rows.values.push_back(stencil_weights[group.first_weight + p * group.n_nodes + i]);
            }
          rows.begin.push_back(rows.columns.size());
        }
  return rows;
}

template <int dim>
std::vector<std::vector<DofIndex>>
ContactPoints<dim>::couplings() const
{
  std::vector<std::vector<DofIndex>> result;
  for (const Group &group : groups)
    result.push_back(unknowns(group));
  return result;
}

template <int dim>
double
ContactPoints<dim>::gap(const unsigned int point) const
{
  return contact_points[point].initial_gap + contact_points[point].normal * contact_jumps[point];
}

template <int dim>
double
ContactPoints<dim>::modulus(const unsigned int pair) const
{
  return pair_modulus[pair];
}

template class ContactPoints<2>;
template class ContactPoints<3>;
} // namespace scree
