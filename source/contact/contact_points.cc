#include <scree/base/exceptions.h>
#include <scree/contact/contact_points.h>
#include <scree/contact/penalty.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

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
ContactPoints<dim>::ContactPoints(const std::vector<Body<dim>>   &bodies,
                                  const std::vector<ContactPair> &pairs,
                                  ContactDiscretisation<dim>    &&discretisation)
    : discretisation(std::move(discretisation))
    , contact_laws(pairs)
    , contact_responses(points().size())
{
  for (const ContactPair &pair : pairs)
    pair_modulus.push_back(modulus_of(pair, bodies[pair.a], bodies[pair.b]));
  contact_enforcement = std::make_unique<Penalty<dim>>(penalties());
  evaluated.jumps.resize(points().size());
  evaluated.means.resize(points().size());
}

template <int dim>
ContactHistory<dim>
ContactPoints<dim>::initial_history() const
{
  const std::vector<dealii::Tensor<1, dim>> zeros(points().size());
  return {zeros, zeros, std::vector<double>(points().size())};
}

template <int dim>
ContactHistory<dim>
ContactPoints<dim>::current_history() const
{
  ContactHistory<dim> history = initial_history();
  history.jump                = evaluated.jumps;
  for (unsigned int i = 0; i < points().size(); ++i)
    {
      history.tau[i]      = contact_responses[i].tau;
      history.pressure[i] = contact_responses[i].pressure;
    }
  return history;
}

template <int dim>
std::vector<ContactStiffness>
ContactPoints<dim>::penalties() const
{
  std::vector<ContactStiffness> result;
  for (unsigned int i = 0; i < points().size(); ++i)
    {
      const ContactPoint<dim>     &point = points()[i];
      const ContactPairParameters &law   = pairs()[point.pair].law;
      const auto                   eps   = [&](const double factor) {
        return factor * point.stiffness_ratio * pair_modulus[point.pair] / point.cell_size;
      };
      result.push_back({eps(law.normal_factor), eps(law.tangential_factor)});
    }
  return result;
}

template <int dim>
std::vector<ContactResponse<dim>>
ContactPoints<dim>::responses_to(const std::vector<unsigned int>           &numbers,
                                 const std::vector<dealii::Tensor<1, dim>> &jumps,
                                 const ContactHistory<dim>                 &history) const
{
  const auto motions = contact_laws.motions(points(), numbers, jumps, history);
  return contact_laws.respond(points(), numbers, motions,
                              contact_enforcement->trial_tractions(numbers, motions, history));
}

template <int dim>
void
ContactPoints<dim>::take_jumps(const Vector &u)
{
  evaluated = discretisation.jump_operator.evaluate(u);
}

template <int dim>
void
ContactPoints<dim>::evaluate(const Vector &u, const ContactHistory<dim> &history)
{
  take_jumps(u);
  const auto acting = contact_laws.acting(points(), evaluated.jumps, *contact_enforcement);
  std::vector<dealii::Tensor<1, dim>> jumps;
  for (const unsigned int i : acting)
    jumps.push_back(evaluated.jumps[i]);
  const auto responses = responses_to(acting, jumps, history);
  contact_responses.assign(points().size(), ContactResponse<dim>());
  std::vector<dealii::Tensor<1, dim>> forces(points().size());
  for (unsigned int j = 0; j < acting.size(); ++j)
    {
      const ContactPoint<dim> &point = points()[acting[j]];
      contact_responses[acting[j]]   = responses[j];
      forces[acting[j]]              = point.weight * responses[j].traction(point.normal);
    }
  contact_forces = jump_operator().forces(std::move(forces));
}

template <int dim>
dealii::Tensor<2, dim>
ContactPoints<dim>::stiffness(const unsigned int point) const
{
  const ContactResponse<dim> &response = contact_responses[point];
  if (response.status == ContactStatus::open)
    return {};
  return points()[point].weight * response.tangent;
}

template <int dim>
std::vector<bool>
ContactPoints<dim>::stiff_points(const bool are_glued) const
{
  std::vector<bool> result;
  for (unsigned int p = 0; p < points().size(); ++p)
    result.push_back((are_glued ? glued_stiffness[p] : stiffness(p)).norm_square() != 0.);
  return result;
}

template <int dim>
std::vector<bool>
ContactPoints<dim>::points_within(const double cells) const
{
  std::vector<bool> result;
  for (unsigned int p = 0; p < points().size(); ++p)
    result.push_back(gap(p) <= cells * points()[p].cell_size);
  return result;
}

template <int dim>
void
ContactPoints<dim>::add_to_matrix(Matrix &matrix) const
{
  std::vector<dealii::Tensor<2, dim>> D;
  D.reserve(points().size());
  for (unsigned int p = 0; p < points().size(); ++p)
    D.push_back(stiffness(p));
  jump_operator().add_stiffness(D, matrix);
  jump_operator().add_curvature(contact_forces, matrix);
}

template <int dim>
std::vector<double>
ContactPoints<dim>::overlaps(const MPI_Comm communicator) const
{
  std::vector<double> result(pairs().size(), 0.);
  for (const ContactPoint<dim> &point : points())
    if (!pairs()[point.pair].law.kind->glues)
      result[point.pair] = std::max(result[point.pair], -point.initial_gap);
  dealii::Utilities::MPI::max(result, communicator, result);
  return result;
}

template <int dim>
const std::vector<dealii::Tensor<2, dim>> &
ContactPoints<dim>::choose_glued(const bool only_closed)
{
  glued_stiffness.assign(points().size(), dealii::Tensor<2, dim>());
  for (unsigned int p = 0; p < points().size(); ++p)
    if (!only_closed || contact_responses[p].status != ContactStatus::open)
      {
        const auto [k_n, k_t] = contact_enforcement->stiffness()[p];
        const auto normal     = dealii::outer_product(points()[p].normal, points()[p].normal);
        glued_stiffness[p]
          = points()[p].weight
            * (k_n * normal + k_t * (dealii::unit_symmetric_tensor<dim>() - normal));
      }
  return glued_stiffness;
}

template <int dim>
std::vector<double>
ContactPoints<dim>::tangent_changes() const
{
  constexpr double    negligible = 1e-14;
  std::vector<double> changes;
  changes.reserve(points().size() * dim * dim);
  for (unsigned int p = 0; p < points().size(); ++p)
    {
      dealii::Tensor<2, dim> change = stiffness(p) - glued_stiffness[p];
      if (change.norm() <= negligible * glued_stiffness[p].norm())
        change = 0.;
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int e = 0; e < dim; ++e)
          changes.push_back(change[d][e]);
    }
  return changes;
}

template <int dim>
double
ContactPoints<dim>::gap(const unsigned int point) const
{
  return points()[point].initial_gap + points()[point].normal * evaluated.jumps[point];
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
