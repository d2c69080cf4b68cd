#include <scree/output/assembly.h>
#include <scree/output/column_names.h>

#include <cmath>
#include <tuple>

namespace scree
{
namespace
{
/** The contacts of deformable bodies that carry more than a trifle, by pair. */
template <int dim>
std::vector<bool>
loaded_contacts(const std::vector<Body<dim>> &bodies, const std::vector<ContactPair> &pairs,
                const std::vector<ContactSummary<dim>> &summaries)
{
  // Of the mean force: what rattles touches others without force but round-off.
  constexpr double  trifle = 1e-6;
  double            sum = 0., n = 0.;
  std::vector<bool> result(pairs.size());
  for (unsigned int p = 0; p < pairs.size(); ++p)
    if (summaries[p].is_closed()
        && !(bodies[pairs[p].a].is_rigid() && bodies[pairs[p].b].is_rigid()))
      {
        result[p] = true;
        sum += summaries[p].strength;
        n += 1.;
      }
  for (unsigned int p = 0; p < pairs.size(); ++p)
    result[p] = result[p] && summaries[p].strength * n > trifle * sum;
  return result;
}
} // namespace

template <int dim>
Assembly<dim>::Assembly(const AssemblyRegion<dim> &region, const std::vector<Body<dim>> &bodies,
                        const std::vector<ContactPair>         &pairs,
                        const std::vector<ContactSummary<dim>> &summaries,
                        const std::vector<GrainState<dim>>     &grains)
    : region(region)
{
  double                    tangential = 0., bound = 0., normal = 0.;
  std::vector<unsigned int> contacts_of_body(bodies.size());
  const auto                is_loaded = loaded_contacts(bodies, pairs, summaries);
  for (unsigned int p = 0; p < pairs.size(); ++p)
    {
      if (!is_loaded[p])
        continue;
      const auto &summary = summaries[p];
      const auto &[a, b]  = std::tie(pairs[p].a, pairs[p].b);
      ++contacts_of_body[a];
      ++contacts_of_body[b];
      force_stress -= symmetrize(
        outer_product(summary.force, branch_vector(bodies, pairs[p], summary, grains)));
      if (const double mu = pairs[p].law.friction(); mu > 0. && std::isfinite(mu))
        {
          tangential += summary.tangential_force();
          bound += mu * summary.normal_force();
        }
      if (bodies[a].is_rigid() || bodies[b].is_rigid())
        {
          ++n_wall_contacts;
          continue;
        }
      ++n_contacts;
      const auto n_n = symmetrize(outer_product(summary.normal(), summary.normal()));
      fabric += n_n;
      force_fabric += summary.normal_force() * n_n;
      normal += summary.normal_force();
    }
  if (n_contacts > 0)
    fabric /= n_contacts;
  if (normal != 0.)
    force_fabric /= normal;
  if (bound > 0.)
    mobilised_friction = tangential / bound;
  add_grains(bodies, grains, contacts_of_body);
  set_invariants();
}

template <int dim>
void
Assembly<dim>::add_grains(const std::vector<Body<dim>>       &bodies,
                          const std::vector<GrainState<dim>> &grains,
                          const std::vector<unsigned int>    &contacts_of_body)
{
  unsigned int n_held = 0, n_sides = 0, n_sides_of_held = 0;
  for (unsigned int b = 0; b < bodies.size(); ++b)
    if (!bodies[b].is_rigid())
      {
        const unsigned int n = contacts_of_body[b];
        ++n_grains;
        n_sides += n;
        n_held += n > 1;
        n_sides_of_held += n > 1 ? n : 0;
        solid_fraction += grains[b].volume;
        stress += grains[b].stress_integral;
      }
  if (n_grains == 0)
    return;
  n_rattlers   = n_grains - n_held;
  coordination = double(n_sides) / n_grains;
  if (n_held > 0)
    mechanical_coordination = double(n_sides_of_held) / n_held;
  solid_fraction /= region.volume;
  stress /= region.volume;
  force_stress /= region.volume;
}

template <int dim>
void
Assembly<dim>::set_invariants()
{
  p            = -trace(force_stress) / dim;
  const auto s = deviator(force_stress);
  q            = std::sqrt(dim == 2 ? 0.5 : 1.5) * s.norm();
}

template <int dim>
std::vector<std::string>
Assembly<dim>::columns()
{
  std::vector<std::string> names = {"grains",         "rattlers",     "contacts",
                                    "wall_contacts",  "coordination", "mechanical_coordination",
                                    "solid_fraction", "porosity"};
  add_vector_names<dim>("length", names);
  add_symmetric_names<dim>("stress", names);
  add_symmetric_names<dim>("force_stress", names);
  names.push_back("p");
  names.push_back("q");
  add_symmetric_names<dim>("fabric", names);
  add_symmetric_names<dim>("force_fabric", names);
  names.push_back("mobilised_friction");
  return names;
}

template <int dim>
std::vector<double>
Assembly<dim>::values() const
{
  std::vector<double> row
    = {double(n_grains), double(n_rattlers),      double(n_contacts), double(n_wall_contacts),
       coordination,     mechanical_coordination, solid_fraction,     1. - solid_fraction};
  for (unsigned int d = 0; d < dim; ++d)
    row.push_back(region.lengths[d]);
  add_symmetric(stress, row);
  add_symmetric(force_stress, row);
  row.push_back(p);
  row.push_back(q);
  add_symmetric(fabric, row);
  add_symmetric(force_fabric, row);
  row.push_back(mobilised_friction);
  return row;
}

template struct Assembly<2>;
template struct Assembly<3>;
} // namespace scree
