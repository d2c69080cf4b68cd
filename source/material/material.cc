#include <scree/base/exceptions.h>
#include <scree/material/linear_elastic.h>
#include <scree/material/material.h>

#include <cmath>
#include <functional>
#include <utility>

namespace scree
{
namespace
{
const std::string rigid_law = "rigid";

template <int dim>
using Factory = std::function<std::unique_ptr<Material<dim>>(const MaterialParameters &)>;

template <class Law, int dim>
std::unique_ptr<Material<dim>>
construct(const MaterialParameters &parameters)
{
  return std::make_unique<Law>(parameters);
}

/** All laws: a new one is registered by one line here. */
template <int dim>
const std::vector<std::pair<std::string, Factory<dim>>> &
registered_laws()
{
  static const std::vector<std::pair<std::string, Factory<dim>>> laws = {
    {"linear elastic", construct<LinearElastic<dim>, dim>},
    {rigid_law, [](const MaterialParameters &) { return nullptr; }},
  };
  return laws;
}

/** What is wrong with the constants of a material, as (key, what, remedy). */
struct Problem
{
  std::string key;
  std::string what;
  std::string remedy;
};

std::vector<Problem>
problems_of(const MaterialParameters &parameters)
{
  std::vector<Problem> problems;
  if (parameters.is_rigid())
    {
      for (const auto &[key, value] : {std::make_pair("Young's modulus", parameters.young),
                                       std::make_pair("Poisson's ratio", parameters.poisson)})
        if (!std::isnan(value))
          problems.push_back({key, "a rigid material has none", "remove the line"});
      return problems;
    }
  // The negated comparisons are also true for NaN.
  if (!(parameters.young > 0))
    problems.push_back({"Young's modulus", "must be set to a number greater than 0",
                        "give E in force per area, e.g. 210e9 for steel in SI units"});
  if (!(parameters.poisson > -1 && parameters.poisson < 0.5))
    problems.push_back(
      {"Poisson's ratio", "must be set to a number greater than -1 and less than 0.5",
       "0.5 (incompressible) is not possible in a displacement formulation; take 0.49 at most"});
  if (!(parameters.density >= 0))
    problems.push_back({"Density", "must not be negative", "give the mass per volume, or 0"});
  return problems;
}
} // namespace

bool
MaterialParameters::is_rigid() const
{
  return law == rigid_law;
}

void
MaterialParameters::declare(const ParameterSection &section)
{
  law = section.choice("Law", law, material_laws(),
                       "Constitutive law. linear elastic: isotropic, small strain, plane strain in "
                       "two dimensions. rigid: bodies of this material do not deform; they have no "
                       "elastic constants and move as their section Motion says.");
  section.entry("Young's modulus", young, "E > 0 [force/length^2].");
  section.entry("Poisson's ratio", poisson, "nu, -1 < nu < 0.5 [-].");
  section.entry("Density", density,
                "Mass per volume in the reference configuration, not negative "
                "[mass/length^3]. Needed for body forces per mass and for inertia.");
  for (const Problem &problem : problems_of(*this))
    section.error(problem.key, problem.what, problem.remedy);
}

std::map<std::string, MaterialParameters>
declare_materials(const ParameterSection &root)
{
  const ParameterSection section = root.subsection("Materials", "The materials, by name.");
  std::map<std::string, MaterialParameters> materials;
  for (const auto &[name, subsection] :
       section.named("Names", "Names of the materials, separated by commas."))
    materials[name].declare(subsection);
  return materials;
}

void
check_elastic_constants(const MaterialParameters &parameters)
{
  for (const Problem &problem : problems_of(parameters))
    throw UserError("Materials", problem.key + " " + problem.what, problem.remedy);
}

std::vector<std::string>
material_laws()
{
  std::vector<std::string> names;
  for (const auto &law : registered_laws<2>())
    names.push_back(law.first);
  return names;
}

template <int dim>
Material<dim>::Material(const double density)
    : mass_density(density)
{
}

template <int dim>
double
Material<dim>::young() const
{
  const double lambda = lame_lambda();
  const double mu     = shear_modulus();
  return mu * (3 * lambda + 2 * mu) / (lambda + mu);
}

template <int dim>
double
Material<dim>::poisson() const
{
  return lame_lambda() / (2 * (lame_lambda() + shear_modulus()));
}

template <int dim>
double
Material<dim>::p_wave_modulus() const
{
  return lame_lambda() + 2 * shear_modulus();
}

template <int dim>
double
Material<dim>::density() const
{
  return mass_density;
}

template <int dim>
std::unique_ptr<Material<dim>>
make_material(const MaterialParameters &parameters)
{
  check_elastic_constants(parameters);
  for (const auto &[name, construct_law] : registered_laws<dim>())
    if (name == parameters.law)
      return construct_law(parameters);
  throw UserError("Materials", "there is no law called '" + parameters.law + "'");
}

template class Material<2>;
template class Material<3>;
template std::unique_ptr<Material<2>> make_material<2>(const MaterialParameters &);
template std::unique_ptr<Material<3>> make_material<3>(const MaterialParameters &);
} // namespace scree
