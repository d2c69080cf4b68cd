#include <scree/application/stages.h>
#include <scree/application/stop_relation.h>
#include <scree/base/exceptions.h>
#include <scree/base/expression.h>
#include <scree/base/log.h>
#include <scree/bodies/motion_keys.h>
#include <scree/parameters/nearest_name.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <regex>

namespace scree
{
namespace
{
constexpr char keep[] = "keep";

/** The text after `to`; nothing if there is no such word. */
std::optional<std::string>
target_of(const std::string &text)
{
  return text.rfind("to ", 0) == 0 ? std::optional<std::string>(text.substr(3)) : std::nullopt;
}

/** Why what is said of a component cannot be used, and the remedy; empty: it can. */
template <int dim>
std::pair<std::string, std::string>
objection(const std::string &text, const double duration)
{
  if (text == keep)
    return {};
  if (const auto target = target_of(text))
    {
      const auto value = constant_value(*target);
      if (!value || !std::isfinite(*value))
        return {"'" + *target + "' is no number", "write a number after 'to', as in to -100"};
      return {};
    }
  if (text.find("table(") != std::string::npos)
    return {"a table in a stage has no time of its own",
            "write it in section Bodies, where t is the time of the run"};
  try
    {
      const Expression<dim> formula(text, 1, "");
      const double          start = formula.value(dealii::Point<dim>(), 0.);
      if (!(std::abs(start) <= 1e-12))
        return {"'" + text + "' is not zero at t = 0, where the stage begins",
                "write the change since the beginning of the stage, t = 0 there, as in 0.1*t, or "
                "the value at its end, as in to 0.1"};
      if (!std::isfinite(formula.value(dealii::Point<dim>(), duration)))
        return {"'" + text + "' is no finite number at the end of the stage", "mend the formula"};
    }
  catch (const UserError &problem)
    {
      return {problem.what(), ""};
    }
  return {};
}

template <int dim>
StageMotion<dim>
declare_stage_motion(const ParameterSection &section, const double duration)
{
  StageMotion<dim> result;
  bool             is_given = false;
  for (unsigned int m = 0; m < n_rigid_components<dim>; ++m)
    {
      for (const bool of_load : {false, true})
        {
          const std::string key  = motion_key<dim>(m, of_load);
          std::string      &text = (of_load ? result.load : result.motion)[m];
          section.entry(
            key, text,
            std::string("By how much it has changed since the stage began, a formula "
                        "of the time t since then, zero at t = 0; or 'to' and the value "
                        "at its end; or 'keep'. Afterwards it stays. The ")
              + (of_load ? "motion" : "load") + " is then unknown.");
          if (text.empty())
            continue;
          is_given = true;
          if (const auto [what, remedy] = objection<dim>(text, duration); !what.empty())
            section.error(key, what, remedy);
        }
      if (!result.motion[m].empty() && !result.load[m].empty())
        section.error(motion_key<dim>(m, true), motion_key<dim>(m, false) + " is given too",
                      "give the motion or the load of a component, not both");
    }
  if (!is_given)
    section.error("", "nothing is said of the body",
                  "give " + motion_key<dim>(0, false) + " or the like, or take it from Bodies");
  return result;
}

void
check_until(const ParameterSection &section, const std::string &until)
{
  if (!until.empty())
    try
      {
        StopRelation(until, "");
      }
    catch (const UserError &problem)
      {
        section.error("Until", problem.what(), "");
      }
}

void
declare_friction(const ParameterSection &stage, const ContactParameters &contact,
                 std::map<std::string, double> &friction)
{
  ParameterSection section = stage.subsection(
    "Contact", "Friction that is another one from the beginning of the stage on.");
  std::vector<std::string> names;
  for (const auto &law : contact.laws)
    names.push_back(law.name);
  for (auto &[name, law_section] :
       section.named("Names", "Names of contact laws of section Contact."))
    {
      const auto law
        = std::find_if(contact.laws.begin(), contact.laws.end(),
                       [&, &wanted = name](const auto &l) { return l.name == wanted; });
      double coefficient = std::numeric_limits<double>::quiet_NaN();
      law_section.entry("Friction coefficient", coefficient, dealii::Patterns::Double(0.),
                        "That of the law from now on.");
      if (law == contact.laws.end())
        section.error("Names", "there is no contact law '" + name + "'" + did_you_mean(name, names),
                      "name laws of section Contact");
      else if (std::isnan(law->friction_coefficient))
        section.error("Names", "the contact law '" + name + "' has no friction coefficient",
                      "give it one in section Contact, 0 if it begins without friction");
      if (std::isnan(coefficient))
        law_section.error("", "nothing is said of the law", "give its Friction coefficient");
      friction[name] = coefficient;
    }
}

/** Adds to the formula of the run what a stage says, between its beginning and its end. */
void
add_stage(std::string &formula, const std::string &of_stage, const double begin,
          const double duration)
{
  if (of_stage.empty())
    return;
  static const std::regex time_variable("\\bt\\b");
  const std::string       stage_time
    = "min(max(t - " + exact_number(begin) + ", 0), " + exact_number(duration) + ")";
  formula = (formula.empty() ? "" : "(" + formula + ") + ") + "("
            + std::regex_replace(of_stage, time_variable, stage_time) + ")";
}

/** How long a stage that began at a time was, or is to be. */
template <int dim>
double
duration_of(const std::vector<StageParameters<dim>> &stages, const StageRecord<dim> &record,
            const unsigned int k, const double begin)
{
  const double longest = stages[k].duration;
  return k < record.ends.size() && record.ends[k] < begin + longest ? record.ends[k] - begin
                                                                    : longest;
}

/** What a stage found when it began; null: it has not begun. */
template <int dim>
const typename StageRecord<dim>::Components *
start_of(const StageRecord<dim> &record, const unsigned int k, const std::string &body)
{
  static const typename StageRecord<dim>::Components at_rest = {};
  if (k == 0)
    return &at_rest;
  return k < record.starts.size() ? &record.starts[k].at(body) : nullptr;
}

/** What drives a component of a rigid body in all stages, see set_motions(). */
template <int dim>
void
set_component(const std::vector<StageParameters<dim>> &stages, const StageRecord<dim> &record,
              const std::string &body, const unsigned int m, MotionParameters<dim> &parameters)
{
  double begin = 0., duration = 0.;
  for (unsigned int k = 0; k < stages.size(); begin += duration, ++k)
    {
      duration          = duration_of(stages, record, k, begin);
      const auto change = stages[k].bodies.find(body);
      if (change == stages[k].bodies.end())
        continue;
      for (const bool of_load : {false, true})
        {
          std::string text = (of_load ? change->second.load : change->second.motion)[m];
          if (text.empty())
            continue;
          std::string &formula = (of_load ? parameters.load : parameters.motion)[m];
          const auto   target  = target_of(text);
          const bool   turns   = of_load == parameters.load[m].empty();
          if (text == keep)
            text = "0";
          if (turns || target)
            {
              const auto *start = start_of(record, k, body);
              if (start == nullptr)
                return;
              parameters.motion[m].clear();
              parameters.load[m].clear();
              formula = exact_number((*start)[m]);
              if (target)
                text
                  = "(" + *target + " - (" + formula + "))*t/" + exact_number(stages[k].duration);
            }
          add_stage(formula, text, begin, duration);
        }
    }
}
} // namespace

template <int dim>
std::vector<StageParameters<dim>>
declare_stages(ParameterSection &section, const std::vector<BodyParameters<dim>> &bodies,
               const std::map<std::string, bool> &is_rigid, const ContactParameters &contact)
{
  std::vector<StageParameters<dim>> result;
  std::vector<std::string>          names;
  names.reserve(bodies.size());
  for (const auto &body : bodies)
    names.push_back(body.name);
  for (auto &[name, stage_section] :
       section.named("Names", "Names of the stages of loading, in their order in time."))
    {
      StageParameters<dim> stage;
      stage.name = name;
      stage_section.entry("Duration", stage.duration, positive_number(),
                          "How long it is, with Until at most [time].");
      stage_section.entry("Steps", stage.steps, dealii::Patterns::Integer(1),
                          "Number of its nominal load steps, of equal length.");
      stage_section.entry(
        "Until", stage.until,
        "A relation between quantities of the run that ends the stage, as in p > "
        "2 or lid.force_y < -100: columns of history.csv and assembly.csv, strain_x "
        "and so on, of the assembly since the stage began, t.");
      check_until(stage_section, stage.until);
      stage_section.entry(
        "Reset", stage.resets,
        "Whether the bodies are free of stress and strain where they are when the "
        "stage begins; displacement is measured from there.");
      if (stage.resets && result.empty())
        stage_section.error("Reset", "the first stage has nothing to reset",
                            "leave it out, or put a stage before it");
      bool has_inertia = true;
      stage_section.entry("Inertia", has_inertia,
                          "false: the stage is quasi-static, whatever Time/Scheme is. Such stages "
                          "come first; bodies have their Initial velocity when they are over.");
      stage.is_static = !has_inertia;
      if (stage.is_static && !result.empty() && !result.back().is_static)
        stage_section.error("Inertia",
                            "the stage '" + result.back().name
                              + "' before it has inertia: bodies "
                                "that move would stop",
                            "put stages without inertia first");
      declare_friction(stage_section, contact, stage.friction);
      for (auto &[body_name, body_section] : stage_section.named(
             "Bodies", "Names of the rigid bodies whose motion or load changes in this stage; all "
                       "else stays as it was."))
        {
          const auto body
            = std::find_if(bodies.begin(), bodies.end(),
                           [&, &wanted = body_name](const auto &b) { return b.name == wanted; });
          if (body == bodies.end())
            stage_section.error(
              "Bodies", "there is no body '" + body_name + "'" + did_you_mean(body_name, names),
              "name rigid bodies of section Bodies");
          else if (!is_rigid.at(body_name))
            stage_section.error("Bodies", "the body '" + body_name + "' is deformable",
                                "stages change motions and loads of rigid bodies; its boundary "
                                "conditions may be formulas of the time of the run");
          stage.bodies[body_name] = declare_stage_motion<dim>(body_section, stage.duration);
        }
      result.push_back(stage);
    }
  return result;
}

template <int dim>
void
set_times(const std::vector<StageParameters<dim>> &stages, const StageRecord<dim> &record,
          TimeParameters &time)
{
  if (stages.empty())
    return;
  time.nominal_times.clear();
  time.stage_ends.clear();
  time.static_steps = 0;
  double begin      = 0.;
  for (unsigned int k = 0; k < stages.size(); ++k)
    {
      const bool   is_over = k < record.ends.size();
      const double end     = is_over ? record.ends[k] : begin + stages[k].duration;
      for (unsigned int step = 1; step < stages[k].steps; ++step)
        if (const double t = begin + stages[k].duration * step / stages[k].steps; t < end)
          time.nominal_times.push_back(t);
      begin = end;
      time.nominal_times.push_back(end);
      time.stage_ends.push_back(time.nominal_times.size());
      if (stages[k].is_static)
        time.static_steps = time.nominal_times.size();
    }
  time.end_time = begin;
  time.steps    = time.nominal_times.size();
}

template <int dim>
void
set_motions(const std::vector<StageParameters<dim>> &stages, const StageRecord<dim> &record,
            std::vector<BodyParameters<dim>> &bodies)
{
  for (auto &body : bodies)
    for (unsigned int m = 0; m < n_rigid_components<dim>; ++m)
      set_component(stages, record, body.name, m, body.motion);
}

template <int dim>
void
require_record_of(const std::vector<StageParameters<dim>> &stages, const StageRecord<dim> &record)
{
  bool fits = record.ends.size() <= stages.size() && record.starts.size() <= stages.size()
              && record.lengths.size() <= dim;
  double time = 0.;
  for (const double end : record.ends)
    {
      fits &= end > time && std::isfinite(end);
      time = end;
    }
  for (unsigned int k = 1; fits && k < record.starts.size(); ++k)
    for (const auto &[body, motion] : stages[k].bodies)
      {
        const auto start = record.starts[k].find(body);
        fits &= start != record.starts[k].end()
                && std::all_of(start->second.begin(), start->second.end(),
                               [](const double value) { return std::isfinite(value); });
      }
  require(fits, "the checkpoint", "it does not belong to the stages of the run",
          "start the run anew");
}

template <int dim>
bool
is_ever_free(const std::vector<StageParameters<dim>> &stages, const std::string &body)
{
  for (const auto &stage : stages)
    if (const auto change = stage.bodies.find(body); change != stage.bodies.end())
      for (const std::string &load : change->second.load)
        if (!load.empty())
          return true;
  return false;
}

template <int dim>
bool
is_static(const std::vector<StageParameters<dim>> &stages, const StageRecord<dim> &record)
{
  return !stages.empty()
         && stages[std::min<std::size_t>(record.ends.size(), stages.size() - 1)].is_static;
}

template <int dim>
bool
set_friction(const std::vector<StageParameters<dim>> &stages, const StageRecord<dim> &record,
             ContactParameters &contact)
{
  bool changes = false;
  for (auto &law : contact.laws)
    {
      const double before = law.friction_coefficient;
      for (unsigned int k = 0; k < stages.size() && k <= record.ends.size(); ++k)
        if (const auto mu = stages[k].friction.find(law.name); mu != stages[k].friction.end())
          law.friction_coefficient = mu->second;
      changes |= law.friction_coefficient != before && !std::isnan(law.friction_coefficient);
    }
  return changes;
}

#define INSTANTIATE(dim)                                                                          \
  template std::vector<StageParameters<dim>> declare_stages(                                      \
    ParameterSection &, const std::vector<BodyParameters<dim>> &,                                 \
    const std::map<std::string, bool> &, const ContactParameters &);                              \
  template void set_times(const std::vector<StageParameters<dim>> &, const StageRecord<dim> &,    \
                          TimeParameters &);                                                      \
  template void set_motions(const std::vector<StageParameters<dim>> &, const StageRecord<dim> &,  \
                            std::vector<BodyParameters<dim>> &);                                  \
  template void require_record_of(const std::vector<StageParameters<dim>> &,                      \
                                  const StageRecord<dim> &);                                      \
  template bool is_ever_free(const std::vector<StageParameters<dim>> &, const std::string &);     \
  template bool is_static(const std::vector<StageParameters<dim>> &, const StageRecord<dim> &);   \
  template bool set_friction(const std::vector<StageParameters<dim>> &, const StageRecord<dim> &, \
                             ContactParameters &);
INSTANTIATE(2)
INSTANTIATE(3)
} // namespace scree
