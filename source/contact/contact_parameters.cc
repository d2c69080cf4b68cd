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
  if (pattern.empty())
    return text.empty();
  if (pattern[0] == '*')
    {
      for (std::size_t i = 0; i <= text.size(); ++i)
        if (fits(pattern.substr(1), text.substr(i)))
          return true;
      return false;
    }
  return !text.empty() && pattern[0] == text[0] && fits(pattern.substr(1), text.substr(1));
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
  section.entry("Normal penalty factor", normal_factor, positive_number(),
                "c_n in eps_n = c_n E/h with E = 2/(1/E_a + 1/E_b), twice the modulus of the other "
                "body for a rigid one; no dimension.");
  section.entry("Tangential penalty factor", tangential_factor, positive_number(),
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
  section.entry("Shift", shift, dealii::Patterns::Double(0.5),
                "Contact is looked for where both bodies are nearer than this, in finest cells; it "
                "must exceed half the approach of the surfaces.");
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
          }
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
