#pragma once

#include <scree/parameters/section.h>
#include <scree/solver/step_size_controller.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace scree
{
/** What a parameter file says about the load steps. */
struct TimeParameters
{
  /** The load factors run over 0 <= t <= end_time [time], > 0. */
  double end_time = 1;

  /** Number of nominal steps of equal length, >= 1. */
  unsigned int steps = 1;

  /** Ends of the nominal steps, the last one at end_time; empty: they are of equal length. */
  std::vector<double> nominal_times;

  /** A step is cut down to this fraction of a nominal one at most; 0 < fraction <= 1. */
  double minimum_step_fraction = 1. / 64;

  /** A step that took this many Newton iterations or fewer was easy. */
  unsigned int easy_iterations = 10;

  /** Tolerance of the local error of the time scheme, see LocalError; 0: steps are nominal ones. */
  double local_error = 0.;

  /** Steps by error are at most so many nominal ones, >= 1. */
  double maximum_step_fraction = 8.;

  /** Numbers of nominal steps in front of the ends of stages; empty: there are no stages. */
  std::vector<unsigned int> stage_ends;

  /** Nominal steps in front of the first one with inertia. */
  unsigned int static_steps = 0;

  /** Whether steps with inertia are as long as their error allows. */
  bool is_by_error() const
  {
    return local_error > 0.;
  }

  /** Reads the entries of the section and records what is not allowed. */
  void declare(const ParameterSection &section);
};

/** Where a StepControl is; holds for other lengths of nominal steps too. */
struct StepControlRecord
{
  double       time          = 0.; //!< the present one [time]
  double       length        = 0.; //!< wanted length of the next step [time]
  unsigned int easy_in_a_row = 0;  //!< accepted easy steps since the length changed
  unsigned int accepted      = 0;
  unsigned int rejected      = 0;
  double       last_ratio    = 1.; //!< of the StepSizeController

  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &time &length &easy_in_a_row &accepted &rejected &last_ratio;
  }
};

/**
 * Chooses the load steps: nominal ones at first; a rejected step is halved and tried again; after
 * two easy steps the length is doubled, up to the nominal one. Every nominal time, k T/n or
 * `nominal_times`, is met exactly, a step that would pass one is shortened.
 *
 * Steps by error begin with a nominal one; then the StepSizeController says their length, within
 * the minimum and the maximum fraction. They end exactly where stages and the run do, nominal times
 * mean nothing. A step that would leave less than its length until then takes half the way.
 *
 * Time is counted in ticks, each a nominal step over 2^m, with 2^-m the smallest power of two that
 * is not below the minimum fraction, so that no rounding accumulates; with steps by error a
 * sixteenth of that.
 *
 *     while (!control.finished())
 *       if (solve(control.next_time()))     control.accept(iterations);
 *       else if (!control.reject())         stop;
 */
class StepControl
{
public:
  /** Starts at t = 0 with nominal steps. */
  explicit StepControl(const TimeParameters &parameters);

  /** Whether the end time is reached. */
  bool finished() const;

  /** End of the last accepted step. */
  double time() const;

  /** End of the step to be tried now; exactly the end time for the last one. */
  double next_time() const;

  /** `next_time() - time()`. */
  double step_size() const;

  /** Length of the step to be tried now as a fraction of a nominal one. */
  double step_fraction() const;

  /** Whether the last accepted step ended on a nominal time (or none was accepted yet). */
  bool at_nominal_time() const;

  /** Number of accepted steps. */
  unsigned int n_accepted() const;

  /** Number of rejected steps. */
  unsigned int n_rejected() const;

  /**
   * The step succeeded with so many Newton iterations: moves to next_time().
   *
   * @param error of a step by error; none: it is not known, and the length of steps stays
   */
  void accept(const unsigned int              newton_iterations,
              const std::optional<StepError> &error = std::nullopt);

  /** The step failed: halves it. Returns false if it was already as small as allowed. */
  bool reject();

  /** The error of the step is too large: makes it shorter. False as reject(). */
  bool reject(const StepError &error);

  /** Whether the step to be tried now is as small as allowed. */
  bool is_smallest() const
  {
    return step_ticks() <= smallest_ticks;
  }

  /** Halves the step until it is at most `size` [time]; false: it is as small as allowed before. */
  bool shorten(const double size);

  /**
   * Shortens the step that comes now, and no other, to that part of it, or as near as steps may be;
   * false: it is as short already.
   */
  bool cut(const double part);

  /**
   * Lets the step that comes now, by error, end a tick or less before `size` [time] is over; false:
   * it would be smaller than allowed, or is as short.
   *
   * @param begins_anew whether the next step is a nominal one at most
   */
  bool end_before(const double size, const bool begins_anew);

  /** Goes on, at the present time, with other nominal times, of which it is one. */
  void change_times(const TimeParameters &parameters);

  StepControlRecord record() const;

  /**
   * Goes on from there; parameters may differ from those of the control that was recorded.
   * @throws UserError if no step of the present parameters may begin at its time
   */
  void resume(const StepControlRecord &record);

private:
  double time_of(const std::int64_t tick) const;

  /** Length of the nominal step that begins, or goes on, at the present time. */
  double nominal_length() const;

  /** The tick that is nearest to a time. */
  std::int64_t tick_at(const double time) const;

  std::int64_t step_ticks() const;

  /** Whether the step that comes is one by error. */
  bool is_by_error() const
  {
    return parameters.is_by_error() && tick >= parameters.static_steps * ticks_per_step;
  }

  /** Makes steps so many ticks long; false: the present one is as small as allowed already. */
  bool make_shorter(const std::int64_t ticks);

  /** The longest step by error, in ticks. */
  std::int64_t largest_ticks() const;

  /** So many ticks times a factor, within the bounds of steps by error. */
  std::int64_t scaled(const std::int64_t ticks, const double factor) const;

  /** From the present time to the end of the stage or the run, in ticks; beyond it: any number. */
  std::int64_t ticks_to_go() const;

  TimeParameters     parameters;
  StepSizeController controller;
  std::int64_t       smallest_ticks;    // of a step
  std::int64_t       ticks_per_step;    // of a nominal step, 2^m
  std::int64_t       end_tick;          // steps * ticks_per_step
  std::int64_t       tick = 0;          // the present time
  std::int64_t       length;            // wanted length of the next step, in ticks
  std::int64_t       longest       = 0; // of the step to be tried now, in ticks; 0: any
  unsigned int       easy_in_a_row = 0; // accepted easy steps since the length changed
  unsigned int       accepted      = 0;
  unsigned int       rejected      = 0;
};
} // namespace scree
