#include <scree/mechanics/one_step_scheme.h>
#include <scree/mechanics/quasi_static.h>
#include <scree/mechanics/time_scheme.h>

namespace scree
{
namespace
{
template <int dim>
using Scheme = std::unique_ptr<const TimeScheme<dim>>;

template <int dim>
Scheme<dim>
one_step(const std::function<StepFormula(double)> &formula)
{
  return std::make_unique<const OneStepScheme<dim>>(formula);
}

/** The schemes by their names. */
template <int dim>
struct NamedScheme
{
  const char *name;
  Scheme<dim> (*make)(const TimeSchemeParameters &parameters);
};

template <int dim>
const NamedScheme<dim> time_schemes[]
  = {{"quasi-static",
      [](const TimeSchemeParameters &) -> Scheme<dim> {
        return std::make_unique<const QuasiStatic<dim>>();
      }},
     {"Newmark",
      [](const TimeSchemeParameters &p) {
        return one_step<dim>([beta = p.newmark_beta, gamma = p.newmark_gamma](const double dt) {
          return newmark(dt, beta, gamma);
        });
      }},
     {"backward Euler", [](const TimeSchemeParameters &) { return one_step<dim>(backward_euler); }},
     {"generalized alpha", [](const TimeSchemeParameters &p) {
        return one_step<dim>(
          [rho = p.spectral_radius](const double dt) { return generalized_alpha(dt, rho); });
      }}};
} // namespace

std::vector<std::string>
time_scheme_names()
{
  std::vector<std::string> names;
  for (const auto &scheme : time_schemes<2>)
    names.emplace_back(scheme.name);
  return names;
}

void
TimeSchemeParameters::declare(const ParameterSection &section)
{
  scheme = section.choice(
    "Scheme", scheme, time_scheme_names(),
    "Integration in time. quasi-static: without inertia, time orders the loads. With inertia, "
    "which needs Density of all materials: Newmark (second order, energy is kept), generalized "
    "alpha (second order, high frequencies are damped), backward Euler (first order, damps).");
  section.entry("Newmark beta", newmark_beta, dealii::Patterns::Double(0.01, 1.),
                "Of Newmark's method; 1/4 with gamma = 1/2: the trapezoidal rule; no dimension.");
  section.entry("Newmark gamma", newmark_gamma, dealii::Patterns::Double(0.5, 1.),
                "Of Newmark's method; more than 1/2 damps; no dimension.");
  section.entry(
    "Spectral radius", spectral_radius, dealii::Patterns::Double(0., 1.),
    "Of generalized alpha, what a step leaves of infinitely fast oscillations: 1 all, 0 "
    "nothing; no dimension.");
  section.entry("FLIP share", flip_share, dealii::Patterns::Double(0., 1.),
                "On a moving geometry material points get the increment of the velocity field (1), "
                "the velocity (0), which smooths it, or a mixture; no dimension.");
  const std::string consistent = "consistent", lumped = "lumped";
  lumps_mass = section.choice("Mass", lumps_mass ? lumped : consistent, {consistent, lumped},
                              "Mass matrix of deformable bodies. consistent: sum of m N N^T over "
                              "points, steadied in small cuts; lumped: its row sums, as in the "
                              "material point method, of degree 1.")
               == lumped;
  if (scheme == "Newmark" && 2. * newmark_beta < newmark_gamma)
    section.error("Newmark beta", "is less than half of Newmark gamma: the method is not stable",
                  "set at least half of Newmark gamma");
}

template <int dim>
std::unique_ptr<const TimeScheme<dim>>
make_time_scheme(const TimeSchemeParameters &parameters)
{
  const std::string name = parameters.is_static_stage ? "quasi-static" : parameters.scheme;
  for (const auto &scheme : time_schemes<dim>)
    if (name == scheme.name)
      return scheme.make(parameters);
  AssertThrow(false, dealii::ExcMessage("unknown time scheme " + name));
  return nullptr;
}

template std::unique_ptr<const TimeScheme<2>> make_time_scheme(const TimeSchemeParameters &);
template std::unique_ptr<const TimeScheme<3>> make_time_scheme(const TimeSchemeParameters &);
} // namespace scree
