#include <scree/base/exceptions.h>
#include <scree/solver/step_control.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace scree
{
namespace
{
constexpr std::int64_t ticks_of_smallest = 16; // of steps by error

std::int64_t
ticks_for(const double minimum_fraction)
{
  std::int64_t ticks = 1;
  while (1. / static_cast<double>(2 * ticks) >= minimum_fraction)
    ticks *= 2;
  return ticks;
}
} // namespace

void
TimeParameters::declare(const ParameterSection &section)
{
  section.entry("End time", end_time, positive_number(),
                "The run covers 0 <= t <= this; functions of the input may depend on t [time].");
  section.entry("Steps", steps, dealii::Patterns::Integer(1),
                "Number of nominal load steps, of equal length.");
  section.entry("Minimum step fraction", minimum_step_fraction, dealii::Patterns::Double(1e-6, 1.),
                "A step that does not converge is halved again and again, down to this fraction of "
                "a nominal step.");
  section.entry("Easy iterations", easy_iterations,
                "After two steps in a row with this many Newton iterations at most, a shortened "
                "step is doubled again.");
  section.entry(
    "Local error", local_error, dealii::Patterns::Double(0., 1.),
    "Tolerance of |e|/(V dt), by which steps with inertia are longer or shorter than nominal ones: "
    "the displacement that the scheme adds wrongly in a step, over the way of the largest speed so "
    "far; rms values of bodies. Displacements at time t are then wrong by about this part of V t. "
    "With accelerations a, Newmark: e = max(beta - 1/6, gamma - 1/2) dt^2 (a_n+1 - a_n) "
    "(Zienkiewicz & Xie 1991), backward Euler: e = dt^2 a_n+1/2. Steps end where bodies come into "
    "contact. 0: steps are nominal ones; no dimension.");
  section.entry("Maximum step fraction", maximum_step_fraction, dealii::Patterns::Double(1., 1e6),
                "With Local error: steps are at most as long as so many nominal ones.");
}

StepControl::StepControl(const TimeParameters &parameters)
    : parameters(parameters)
    , smallest_ticks(parameters.is_by_error() ? ticks_of_smallest : 1)
    , ticks_per_step(smallest_ticks * ticks_for(parameters.minimum_step_fraction))
    , end_tick(static_cast<std::int64_t>(parameters.steps) * ticks_per_step)
    , length(ticks_per_step)
{
  Assert(parameters.steps >= 1 && parameters.minimum_step_fraction > 0, dealii::ExcInternalError());
}

bool
StepControl::finished() const
{
  return tick == end_tick;
}

double
StepControl::time() const
{
  return time_of(tick);
}

double
StepControl::next_time() const
{
  return time_of(tick + step_ticks());
}

double
StepControl::step_size() const
{
  return next_time() - time();
}

double
StepControl::step_fraction() const
{
  return static_cast<double>(step_ticks()) / static_cast<double>(ticks_per_step);
}

bool
StepControl::at_nominal_time() const
{
  return tick % ticks_per_step == 0;
}

unsigned int
StepControl::n_accepted() const
{
  return accepted;
}

unsigned int
StepControl::n_rejected() const
{
  return rejected;
}

void
StepControl::accept(const unsigned int newton_iterations, const std::optional<StepError> &error)
{
  Assert(!finished(), dealii::ExcMessage("The end time is reached."));
  const bool         by_error = is_by_error(), is_cut = longest > 0;
  const std::int64_t taken = step_ticks();
  tick += taken;
  longest = 0;
  ++accepted;
  easy_in_a_row = newton_iterations <= parameters.easy_iterations ? easy_in_a_row + 1 : 0;
  if (by_error)
    {
      // A step that was cut short tells nothing of the length that was wanted.
      if (!error || is_cut || taken < length)
        return;
      const double factor = controller.accept(*error);
      if (factor < 1. || easy_in_a_row >= 2)
        length = scaled(taken, factor);
      return;
    }
  if (easy_in_a_row >= 2 && length < ticks_per_step)
    {
      length        = std::min(2 * length, ticks_per_step);
      easy_in_a_row = 0;
    }
}

bool
StepControl::reject()
{
  Assert(!finished(), dealii::ExcMessage("The end time is reached."));
  ++rejected;
  easy_in_a_row = 0;
  return make_shorter(step_ticks() / 2);
}

bool
StepControl::reject(const StepError &error)
{
  ++rejected;
  return make_shorter(scaled(step_ticks(), StepSizeController::reject(error)));
}

bool
StepControl::make_shorter(const std::int64_t ticks)
{
  if (is_smallest())
    return false;
  length  = std::max(ticks, smallest_ticks);
  longest = 0;
  return true;
}

bool
StepControl::shorten(const double size)
{
  while (step_size() > size)
    if (!make_shorter(step_ticks() / 2))
      return false;
  return true;
}

bool
StepControl::cut(const double part)
{
  const std::int64_t before = step_ticks();
  longest = std::clamp<std::int64_t>(std::llround(part * static_cast<double>(before)),
                                     std::min(smallest_ticks, before), before);
  return step_ticks() < before;
}

bool
StepControl::end_before(const double size, const bool begins_anew)
{
  Assert(is_by_error(), dealii::ExcInternalError());
  const double       tick_time = nominal_length() / static_cast<double>(ticks_per_step);
  const std::int64_t ticks     = std::floor(std::min(size, step_size()) / tick_time);
  if (ticks < smallest_ticks || ticks >= step_ticks())
    return false;
  longest = ticks;
  if (begins_anew)
    length = std::min(length, ticks_per_step);
  return true;
}

void
StepControl::change_times(const TimeParameters &changed)
{
  const double now = time();
  Assert(changed.minimum_step_fraction == parameters.minimum_step_fraction,
         dealii::ExcInternalError());
  parameters = changed;
  end_tick   = static_cast<std::int64_t>(parameters.steps) * ticks_per_step;
  tick       = tick_at(now);
  Assert(time() == now, dealii::ExcMessage("No step may begin now."));
}

StepControlRecord
StepControl::record() const
{
  const double wanted
    = parameters.nominal_times.empty()
        ? time_of(length)
        : nominal_length() * static_cast<double>(length) / static_cast<double>(ticks_per_step);
  return {time(), wanted, easy_in_a_row, accepted, rejected, controller.last_ratio()};
}

void
StepControl::resume(const StepControlRecord &record)
{
  require(record.time >= 0., "the checkpoint", "its time cannot be: " + std::to_string(record.time),
          "start the run anew");
  require(record.time <= parameters.end_time * (1. + 1e-12), "Time/End time",
          "the run has passed this time: it is at " + std::to_string(record.time),
          "choose a later end");
  tick = tick_at(record.time);
  require(parameters.nominal_times.empty()
            || std::abs(time_of(tick) - record.time) <= 1e-12 * parameters.end_time,
          "Stages",
          "no step of a stage, nor a part of one, begins at the time of the run, "
            + std::to_string(record.time),
          "leave the stages that have begun as they were");
  require(std::abs(time_of(tick) - record.time) <= 1e-12 * parameters.end_time, "Time/Steps",
          "no step of length " + std::to_string(parameters.end_time / parameters.steps)
            + " (End time/Steps), nor a part of one, begins at the time of the run, "
            + std::to_string(record.time),
          "change Steps together with End time, such that the length of a step remains");
  const double tick_time = nominal_length() / static_cast<double>(ticks_per_step);
  length        = std::clamp<std::int64_t>(std::llround(record.length / tick_time), smallest_ticks,
                                    is_by_error() ? largest_ticks() : ticks_per_step);
  easy_in_a_row = record.easy_in_a_row;
  accepted      = record.accepted;
  rejected      = record.rejected;
  require(record.last_ratio > 0. && std::isfinite(record.last_ratio), "the checkpoint",
          "the error of its last step cannot be", "start the run anew");
  controller.set_last_ratio(record.last_ratio);
}

double
StepControl::time_of(const std::int64_t tick) const
{
  if (const std::vector<double> &times = parameters.nominal_times; !times.empty())
    {
      const std::int64_t step = tick / ticks_per_step, part = tick % ticks_per_step;
      // Beyond the last one, after which a step is asked for too, as long as that.
      const auto end_of = [&times](const std::int64_t n) {
        const std::int64_t n_times = times.size(), beyond = std::max<std::int64_t>(0, n - n_times);
        const double       end = n == 0 ? 0. : times[n - beyond - 1];
        return beyond == 0 ? end : end + beyond * (end - (times.size() > 1 ? times.end()[-2] : 0.));
      };
      const double begin = end_of(step);
      return part == 0 ? begin
                       : begin
                           + (end_of(step + 1) - begin) * static_cast<double>(part)
                               / static_cast<double>(ticks_per_step);
    }
  return tick == end_tick
           ? parameters.end_time
           : parameters.end_time * static_cast<double>(tick) / static_cast<double>(end_tick);
}

double
StepControl::nominal_length() const
{
  if (parameters.nominal_times.empty())
    return parameters.end_time / parameters.steps;
  const std::int64_t step = std::min(tick, end_tick - 1) / ticks_per_step;
  return time_of((step + 1) * ticks_per_step) - time_of(step * ticks_per_step);
}

std::int64_t
StepControl::tick_at(const double time) const
{
  const auto nearest = [](const double x) { return static_cast<std::int64_t>(std::llround(x)); };
  if (parameters.nominal_times.empty())
    return nearest(time / (parameters.end_time / static_cast<double>(end_tick)));
  std::int64_t step = 0;
  while (step + 1 < end_tick / ticks_per_step && parameters.nominal_times[step] <= time)
    ++step;
  const double begin = time_of(step * ticks_per_step);
  return step * ticks_per_step
         + nearest((time - begin) / (parameters.nominal_times[step] - begin)
                   * static_cast<double>(ticks_per_step));
}

std::int64_t
StepControl::largest_ticks() const
{
  return std::llround(parameters.maximum_step_fraction * static_cast<double>(ticks_per_step));
}

std::int64_t
StepControl::scaled(const std::int64_t ticks, const double factor) const
{
  return std::clamp<std::int64_t>(std::floor(factor * static_cast<double>(ticks)), smallest_ticks,
                                  largest_ticks());
}

std::int64_t
StepControl::ticks_to_go() const
{
  for (const std::int64_t steps : parameters.stage_ends)
    if (tick < steps * ticks_per_step)
      return steps * ticks_per_step - tick;
  return tick < end_tick ? end_tick - tick : std::numeric_limits<std::int64_t>::max();
}

std::int64_t
StepControl::step_ticks() const
{
  std::int64_t ticks = std::min(length, ticks_per_step - tick % ticks_per_step);
  if (is_by_error())
    {
      const std::int64_t to_go = ticks_to_go();
      ticks = length >= to_go ? to_go : length > to_go / 2 ? (to_go + 1) / 2 : length;
    }
  return longest > 0 ? std::min(ticks, longest) : ticks;
}
} // namespace scree
