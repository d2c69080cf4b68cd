#include <scree/application/stages.h>
#include <scree/base/exceptions.h>
#include <scree/base/expression.h>
#include <scree/bodies/motion_keys.h>
#include <scree/parameters/nearest_name.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <regex>
#include <sstream>

namespace scree
{
namespace
{
/** Why a formula of a stage cannot be used, and the remedy; empty: it can. */
template <int dim>
std::pair<std::string, std::string>
objection(const std::string &text, const double duration)
{
  if (text.find("table(") != std::string::npos)
    return {"a table in a stage has no time of its own",
            "write it in section Bodies, where t is the time of the run"};
  try
    {
      const Expression<dim> formula(text, 1, "");
      const double          start = formula.value(dealii::Point<dim>(), 0.);
      if (!(std::abs(start) <= 1e-12))
        return {"'" + text + "' is not zero at t = 0, where the stage begins",
                "write the change since the beginning of the stage, t = 0 there, as in 0.1*t"};
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
declare_stage_motion(const ParameterSection &section, const MotionParameters<dim> &of_body,
                     const double duration)
{
  StageMotion<dim> result;
  bool             is_given = false;
  for (unsigned int m = 0; m < n_rigid_components<dim>; ++m)
    for (const bool of_load : {false, true})
      {
        const std::string key  = motion_key<dim>(m, of_load);
        std::string      &text = (of_load ? result.load : result.motion)[m];
        section.entry(key, text,
                      "By how much it has changed since the stage began, a formula of the time t "
                      "since then, zero at t = 0; afterwards it stays.");
        if (text.empty())
          continue;
        is_given = true;
        if (const auto [what, remedy] = objection<dim>(text, duration); !what.empty())
          section.error(key, what, remedy);
        const bool is_free = !of_body.load[m].empty();
        if (is_free != of_load)
          section.error(key,
                        "section Bodies gives the body's "
                          + std::string(is_free ? "load, not its motion" : "motion, not its load"),
                        "change " + motion_key<dim>(m, !of_load)
                          + (is_free ? "" : ", or set " + key + " = 0 in its section Motion"));
      }
  if (!is_given)
    section.error("", "nothing is said of the body",
                  "give " + motion_key<dim>(0, false) + " or the like, or take it from Bodies");
  return result;
}

std::string
exact(const double value)
{
  std::ostringstream text;
  text << std::setprecision(17) << value;
  return text.str();
}

/** Adds to the formula of the run what a stage says, between its beginning and its end. */
void
add_stage(std::string &formula, const std::string &of_stage, const double begin,
          const double duration)
{
  if (of_stage.empty())
    return;
  static const std::regex time_variable("\\bt\\b");
  const std::string stage_time = "min(max(t - " + exact(begin) + ", 0), " + exact(duration) + ")";
  formula                      = (formula.empty() ? "" : "(" + formula + ") + ") + "("
            + std::regex_replace(of_stage, time_variable, stage_time) + ")";
}
} // namespace

template <int dim>
std::vector<StageParameters<dim>>
declare_stages(ParameterSection &section, const std::vector<BodyParameters<dim>> &bodies,
               const std::map<std::string, bool> &is_rigid)
{
  std::vector<StageParameters<dim>> result;
  std::vector<std::string>          names;
  for (const auto &body : bodies)
    names.push_back(body.name);
  for (auto &[name, stage_section] :
       section.named("Names", "Names of the stages of loading, in their order in time."))
    {
      StageParameters<dim> stage;
      stage.name = name;
      stage_section.entry("Duration", stage.duration, positive_number(), "How long it is [time].");
      stage_section.entry("Steps", stage.steps, dealii::Patterns::Integer(1),
                          "Number of its nominal load steps, of equal length.");
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
          stage.bodies[body_name] = declare_stage_motion<dim>(
            body_section, body == bodies.end() ? MotionParameters<dim>() : body->motion,
            stage.duration);
        }
      result.push_back(stage);
    }
  return result;
}

template <int dim>
void
apply_stages(const std::vector<StageParameters<dim>> &stages,
             std::vector<BodyParameters<dim>> &bodies, TimeParameters &time)
{
  if (stages.empty())
    return;
  time.nominal_times.clear();
  double begin = 0.;
  for (const auto &stage : stages)
    {
      for (auto &body : bodies)
        if (const auto change = stage.bodies.find(body.name); change != stage.bodies.end())
          for (unsigned int m = 0; m < n_rigid_components<dim>; ++m)
            {
              add_stage(body.motion.motion[m], change->second.motion[m], begin, stage.duration);
              add_stage(body.motion.load[m], change->second.load[m], begin, stage.duration);
            }
      for (unsigned int step = 1; step < stage.steps; ++step)
        time.nominal_times.push_back(begin + stage.duration * step / stage.steps);
      begin += stage.duration;
      time.nominal_times.push_back(begin);
    }
  time.end_time = begin;
  time.steps    = time.nominal_times.size();
}

#define INSTANTIATE(dim)                                                \
  template std::vector<StageParameters<dim>> declare_stages(            \
    ParameterSection &, const std::vector<BodyParameters<dim>> &,       \
    const std::map<std::string, bool> &);                               \
  template void apply_stages(const std::vector<StageParameters<dim>> &, \
                             std::vector<BodyParameters<dim>> &, TimeParameters &);
INSTANTIATE(2)
INSTANTIATE(3)
} // namespace scree
