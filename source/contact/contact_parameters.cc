#include <scree/contact/contact_parameters.h>
#include <scree/parameters/expression_entry.h>

#include <algorithm>
#include <cmath>

namespace scree
{
namespace
{
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
} // namespace

void
ContactPairParameters::declare(ParameterSection &section)
{
  section.entry("Bodies", bodies,
                "Two names of bodies, in any order; * stands for any text: a default is '*, *'.");
  section.entry("Law", law, contact_law_names,
                "none, frictionless, coulomb (friction), stick (no sliding under pressure), tied "
                "(glued where the bodies touch at the start; elsewhere they do not interact).");
  section.entry("Friction coefficient", friction_coefficient, dealii::Patterns::Double(0.),
                "Coulomb's mu; no dimension.");
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
  section.entry("Tied gap", tied_gap, dealii::Patterns::Double(0.),
                "Tied: glued are points where the gap at the start, after Adjust, is not larger "
                "than this; default: a tenth of the cell [L].");
  section.entry("Where", where,
                "Tied: expression of x, y, z in the initial configuration that selects the glued "
                "part (not zero).");
  path = section.path();
  check_expression<3>(section, "Where", where, 1);
  if (bodies.size() != 2)
    section.error("Bodies", "needs two names", "for example Bodies = block, *");
  if (law == ContactLaw::coulomb && std::isnan(friction_coefficient))
    section.error("Friction coefficient", "the law coulomb needs a friction coefficient",
                  "set Friction coefficient, or Law = frictionless");
  if (law != ContactLaw::coulomb && !std::isnan(friction_coefficient))
    section.error("Friction coefficient",
                  "the law " + name_of(contact_law_names, law) + " has no friction coefficient",
                  "remove it, or set Law = coulomb");
  if (law != ContactLaw::tied && !std::isnan(tied_gap))
    section.error("Tied gap", "the law " + name_of(contact_law_names, law) + " glues nothing",
                  "remove it, or set Law = tied");
  if (law != ContactLaw::tied && where != "1")
    section.error("Where", "the law " + name_of(contact_law_names, law) + " glues nothing",
                  "remove it, or set Law = tied");
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
            std::string known;
            for (const auto &body : body_names)
              known += (known.empty() ? "" : ", ") + body;
            subsection.error("Bodies", "no body is called '" + pattern + "'", "bodies: " + known);
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
  result.law  = ContactLaw::frictionless;
  for (const auto &law : laws)
    if (law.matches(a, b))
      result = law;
  return result;
}
} // namespace scree
