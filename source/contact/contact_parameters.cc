#include <scree/base/enum_names.h>
#include <scree/base/log.h>
#include <scree/contact/contact_parameters.h>

#include <algorithm>
#include <limits>

namespace scree
{
namespace
{
const EnumNames<AdjustBy> adjust_by_names
  = {{AdjustBy::pairs, "pairs"}, {AdjustBy::points, "points"}};

/** Whether `text` fits `pattern`, in which each '*' stands for any text. */
bool
fits(const std::string &pattern, const std::string &text)
{
  constexpr auto none = std::string::npos;
  std::size_t    p = 0, t = 0, last_star = none, after_star = 0;
  while (t < text.size())
    if (p < pattern.size() && pattern[p] == '*')
      {
        last_star  = p++;
        after_star = t;
      }
    else if (p < pattern.size() && pattern[p] == text[t])
      {
        ++p;
        ++t;
      }
    else if (last_star != none)
      {
        // The last '*' takes one letter more.
        p = last_star + 1;
        t = ++after_star;
      }
    else
      return false;
  while (p < pattern.size() && pattern[p] == '*')
    ++p;
  return p == pattern.size();
}

/** Which bodies fit the two names of a law. */
struct Fitting
{
  Fitting(const ContactPairParameters &law, const std::vector<std::string> &bodies)
  {
    for (const std::string &body : bodies)
      {
        first.push_back(fits(law.bodies[0], body));
        second.push_back(fits(law.bodies[1], body));
      }
  }

  bool operator()(const unsigned int a, const unsigned int b) const
  {
    return (first[a] && second[b]) || (first[b] && second[a]);
  }

  std::vector<bool> first, second;
};

/** Why a law is used for no pair of bodies; nothing if it is used. */
std::string
why_unused(const unsigned int law, const std::vector<ContactPairParameters> &laws,
           const std::vector<Fitting> &fitting, const std::vector<std::string> &bodies)
{
  std::string taken;
  for (unsigned int a = 0; a < bodies.size(); ++a)
    for (unsigned int b = a + 1; b < bodies.size(); ++b)
      {
        if (!fitting[law](a, b))
          continue;
        unsigned int last = laws.size() - 1;
        while (!fitting[last](a, b))
          --last;
        if (last == law)
          return "";
        if (taken.empty())
          taken = "the law '" + laws[law].name + "' is used for no pair of bodies: '"
                  + laws[last].name + "', which comes later, counts for " + bodies[a] + " and "
                  + bodies[b];
      }
  if (!taken.empty())
    return taken;
  const auto &names  = laws[law].bodies;
  const bool  is_one = names[0] == names[1] && names[0].find('*') == std::string::npos;
  return "the law '" + laws[law].name + "' fits no two bodies"
         + (is_one ? ": a body is not in contact with itself" : "");
}
/** Declares the entry Law and those of all laws, and checks those of the one that is chosen. */
void
declare_law(ContactPairParameters &parameters, const ParameterSection &section)
{
  std::vector<std::string> names;
  std::string              descriptions;
  for (const ContactLaw &law : registered_contact_laws())
    {
      names.push_back(law.name);
      descriptions += (descriptions.empty() ? "" : ", ") + law.name
                      + (law.description.empty() ? "" : " (" + law.description + ")");
    }
  parameters.kind
    = &contact_law(section.choice("Law", parameters.kind->name, names, descriptions + "."));
  const auto &used = parameters.kind->entries;
  for (const ContactLaw &law : registered_contact_laws())
    {
      const bool is_chosen = &law == parameters.kind;
      if (law.declare != nullptr)
        law.declare(parameters, section, is_chosen);
      for (const std::string &entry : law.entries)
        if (!section.is_wrong("Law") && section.is_set(entry)
            && std::find(used.begin(), used.end(), entry) == used.end())
          section.error(entry, "the law " + parameters.kind->name + " does not use it",
                        "remove it (--set \"" + section.path() + "/" + entry
                          + "=\" does), or set Law = " + law.name);
    }
}
} // namespace

void
ContactPairParameters::declare(ParameterSection &section)
{
  section.entry(
    "Bodies", bodies,
    "Two names of bodies, in any order; * stands for any text: a default is '*, *'. Two "
    "rigid bodies of prescribed motions pass through each other.");
  declare_law(*this, section);
  // Softer ones let bodies through one another, stiffer ones leave no digits to the stresses.
  const dealii::Patterns::Double penalty_factor(0.01, 1e6);
  section.entry("Normal penalty factor", normal_factor, penalty_factor,
                "c_n in eps_n = c_n E/h with E = 2/(1/E_a + 1/E_b), twice the modulus of the other "
                "body for a rigid one; no dimension.");
  section.entry("Tangential penalty factor", tangential_factor, penalty_factor,
                "c_t in eps_t = c_t E/h; no dimension.");
  section.entry("Penalty modulus", penalty_modulus, positive_number(),
                "E of the penalties; default: from the moduli of the bodies. Needed between two "
                "rigid bodies [force/L^2].");
  section.entry("Adjust", adjust, dealii::Patterns::Double(0.),
                "Gaps and overlaps at the start up to this length count as zero, without strain; "
                "larger ones stay as they are [L].");
  section.entry("Adjust by", adjust_by, adjust_by_names,
                "pairs: what counts is the least gap (the largest overlap) of two bodies, which is "
                "taken off everywhere, so that they touch and keep their curvature; points: each "
                "point has its own, so that surfaces fit that only roughly do.");
  path = section.path();
  if (bodies.size() != 2)
    section.error("Bodies", "needs two names", "for example Bodies = block, *");
}

double
ContactPairParameters::friction() const
{
  if (kind->bound == nullptr)
    return 0.;
  if (!kind->slides)
    return std::numeric_limits<double>::infinity();
  const std::vector<double>  large = {1e50};
  std::vector<FrictionBound> bound(1);
  kind->bound(*this, dealii::make_array_view(large), dealii::make_array_view(bound));
  return bound[0].by_pressure;
}

bool
ContactPairParameters::matches(const std::string &a, const std::string &b) const
{
  return (fits(bodies[0], a) && fits(bodies[1], b)) || (fits(bodies[0], b) && fits(bodies[1], a));
}

void
ContactParameters::declare(ParameterSection &section, const std::vector<std::string> &body_names)
{
  section.entry("Shift", shift, dealii::Patterns::Double(0.5, 100.),
                "Contact is looked for where both bodies are nearer than this, in finest cells; it "
                "must exceed half the approach of the surfaces.");
  grid_nodes.declare(section);
  enforcement.declare(section);
  std::vector<ParameterSection> subsections;
  bool                          all_known = true;
  for (auto &[name, subsection] :
       section.named("Names", "Names of the contact laws; the last that fits a pair counts."))
    {
      laws.emplace_back();
      laws.back().name = name;
      laws.back().declare(subsection);
      for (const std::string &pattern : laws.back().bodies)
        if (std::none_of(body_names.begin(), body_names.end(),
                         [&](const std::string &body) { return fits(pattern, body); }))
          {
            subsection.error("Bodies", "no body is called '" + pattern + "'",
                             "bodies: " + listed(body_names));
            all_known = false;
          }
      all_known &= laws.back().bodies.size() == 2;
      subsections.push_back(subsection);
    }
  if (!all_known || body_names.size() < 2)
    return;
  std::vector<Fitting> fitting;
  for (const ContactPairParameters &law : laws)
    fitting.emplace_back(law, body_names);
  for (unsigned int i = 0; i < laws.size(); ++i)
    {
      const std::string reason = why_unused(i, laws, fitting, body_names);
      if (!reason.empty())
        subsections[i].error("Bodies", reason,
                             "remove one of the laws, give each the two names of its bodies, and "
                             "write the general one first: the last that fits a pair counts");
    }
}

ContactPairParameters
ContactParameters::law_of(const std::string &a, const std::string &b) const
{
  ContactPairParameters result;
  result.name = "built-in";
  result.kind = &contact_law("frictionless");
  for (const auto &law : laws)
    if (law.matches(a, b))
      result = law;
  return result;
}

std::vector<bool>
ContactParameters::roles_of(const std::string &body) const
{
  std::vector<bool> result;
  for (const auto &law : laws)
    for (const std::string &pattern : law.bodies)
      result.push_back(fits(pattern, body));
  return result;
}
} // namespace scree
