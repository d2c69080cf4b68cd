#include <scree/base/exceptions.h>
#include <scree/material/increment_law.h>
#include <scree/material/linear_elastic.h>
#include <scree/material/material.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace scree
{
namespace
{
const std::string rigid_law  = "rigid";
const std::string linear_law = "linear elastic";

/** What is wrong with the constants of a material, as (key, what, remedy). */
struct Problem
{
  std::string key;
  std::string what;
  std::string remedy;
};

/** The constants that are given although the law has none of that name. */
std::vector<Problem>
superfluous(const std::vector<std::pair<std::string, double>> &constants, const std::string &what,
            const std::string &remedy)
{
  std::vector<Problem> problems;
  for (const auto &[key, value] : constants)
    if (!std::isnan(value))
      problems.push_back({key, what, remedy});
  return problems;
}

std::vector<Problem>
hardening_problems(const MaterialParameters &parameters)
{
  if (!is_plastic(parameters.law))
    return superfluous({{"Yield stress", parameters.yield_stress},
                        {"Hardening modulus", parameters.hardening_modulus}},
                       "the law '" + parameters.law + "' has none",
                       "remove the line or choose a law called J2");
  std::vector<Problem> problems;
  // The negated comparisons are also true for NaN.
  if (!(parameters.yield_stress > 0))
    problems.push_back(
      {"Yield stress", "must be set to a number greater than 0", "give it in force per area"});
  if (!(parameters.hardening_modulus >= 0))
    problems.push_back({"Hardening modulus", "must be set to a number that is not negative",
                        "give it in force per area, 0 for perfect plasticity"});
  return problems;
}

/** Constants that are numbers, but leave none for forces and energies. */
std::vector<Problem>
extreme_constants(const MaterialParameters &parameters)
{
  constexpr double     smallest = 1e-30, largest = 1e30;
  constexpr double     nearest = 1e-6; // to the bounds of Poisson's ratio
  std::vector<Problem> problems;
  for (const auto &[key, value] :
       {std::make_pair("Young's modulus", parameters.young),
        std::make_pair("Yield stress", parameters.yield_stress),
        std::make_pair("Hardening modulus", parameters.hardening_modulus),
        std::make_pair("Density", parameters.density)})
    if (value > 0 && (value < smallest || value > largest))
      problems.push_back(
        {key, "must lie between 1e-30 and 1e30", "choose units in which it is a usual number"});
  const double nu = parameters.poisson;
  if (nu > 0.5 - nearest && nu < 0.5)
    problems.push_back({"Poisson's ratio",
                        "is nearer to 0.5 than 1e-6: round-off in the bulk modulus would swamp "
                        "all other forces",
                        "take 0.4999 or less: the material then is incompressible in practice"});
  if (nu < -1 + nearest && nu > -1)
    problems.push_back({"Poisson's ratio",
                        "is nearer to -1 than 1e-6: round-off in the shear modulus would swamp "
                        "all other forces",
                        "take -0.999 or more"});
  return problems;
}

std::vector<Problem>
problems_of(const MaterialParameters &parameters)
{
  std::vector<Problem> problems;
  // The negated comparisons are also true for NaN.
  if (!(parameters.density >= 0))
    problems.push_back({"Density", "must not be negative", "give the mass per volume, or 0"});
  if (parameters.is_rigid())
    {
      for (const Problem &problem :
           superfluous({{"Young's modulus", parameters.young},
                        {"Poisson's ratio", parameters.poisson},
                        {"Yield stress", parameters.yield_stress},
                        {"Hardening modulus", parameters.hardening_modulus}},
                       "a rigid material has none", "remove the line"))
        problems.push_back(problem);
      return problems;
    }
  for (const Problem &problem : hardening_problems(parameters))
    problems.push_back(problem);
  if (!(parameters.young > 0))
    problems.push_back({"Young's modulus", "must be set to a number greater than 0",
                        "give E in force per area, e.g. 210e9 for steel in SI units"});
  if (!(parameters.poisson > -1 && parameters.poisson < 0.5))
    problems.push_back(
      {"Poisson's ratio", "must be set to a number greater than -1 and less than 0.5",
       "0.5 (incompressible) is not possible in a displacement formulation; take 0.49999 at most"});
  for (const Problem &problem : extreme_constants(parameters))
    problems.push_back(problem);
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
  law = section.choice(
    "Law", law, material_laws(),
    "Constitutive law, isotropic; plane strain in two dimensions. linear elastic: the linear "
    "theory, "
    "on a fixed or a moving geometry. rigid: bodies of this material do not deform; they have no "
    "constants and move as their section Motion says. All others need a moving geometry. Finite "
    "strain: Hencky (logarithmic strain), neo-Hookean, Saint Venant-Kirchhoff (softens in "
    "compression; for comparisons), J2 (Hencky with von Mises plasticity). Small strain: J2 small "
    "strain (linear theory); linear elastic rotated, J2 small strain rotated (the stress turns "
    "with "
    "the material); linear elastic incremental (stress increments on the geometry at the start of "
    "each step, without rotation).");
  section.entry("Young's modulus", young, "E > 0 [force/L^2].");
  section.entry("Poisson's ratio", poisson, "nu, -1 < nu < 0.5 [-].");
  section.entry("Yield stress", yield_stress,
                "sigma_y > 0 in uniaxial stress, of laws called J2 [force/L^2].");
  section.entry("Hardening modulus", hardening_modulus,
                "H >= 0 of linear isotropic hardening, of laws called J2: the yield stress is "
                "sigma_y + H alpha with the equivalent plastic strain alpha [force/L^2].");
  section.entry("Density", density,
                "Mass per volume in the reference configuration, not negative "
                "[mass/L^3]. Needed for body forces per mass and for inertia.");
  if (section.is_wrong("Law"))
    return;
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
check_constants(const MaterialParameters &parameters)
{
  for (const Problem &problem : problems_of(parameters))
    throw UserError("Materials", problem.key + " " + problem.what, problem.remedy);
}

std::vector<std::string>
material_laws()
{
  std::vector<std::string> names = increment_laws();
  names.push_back(rigid_law);
  return names;
}

bool
needs_moving_geometry(const std::string &law)
{
  return law != rigid_law && law != linear_law;
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
  const std::vector<std::string> laws = material_laws();
  require(std::find(laws.begin(), laws.end(), parameters.law) != laws.end(), "Materials",
          "there is no law called '" + parameters.law + "'");
  check_constants(parameters);
  if (parameters.is_rigid())
    return nullptr;
  return std::make_unique<LinearElastic<dim>>(parameters);
}

template class Material<2>;
template class Material<3>;
template std::unique_ptr<Material<2>> make_material<2>(const MaterialParameters &);
template std::unique_ptr<Material<3>> make_material<3>(const MaterialParameters &);
} // namespace scree
