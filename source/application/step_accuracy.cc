#include <scree/application/step_accuracy.h>

#include <algorithm>
#include <cmath>

namespace scree
{
template <int dim>
StepAccuracy<dim>::StepAccuracy(const TimeParameters &parameters, const StepControl &step_control,
                                const Model<dim> &model, RunLog &run_log)
    : parameters(parameters)
    , step_control(step_control)
    , model(model)
    , run_log(run_log)
{
}

template <int dim>
double
StepAccuracy<dim>::way(const double speed) const
{
  constexpr double at_rest = 1e-6; // cells
  return std::max(speed * step_control.step_size(), at_rest * model.problem().grid.finest_size());
}

template <int dim>
StepEvent
StepAccuracy<dim>::next_event() const
{
  constexpr double safety = 0.9;
  StepEvent        result;
  if (!is_active())
    return result;
  const LocalError<dim> expected(model.problem(), model.time_scheme(), model.state());
  const double          size = step_control.step_size();
  const Closing         closing
    = expected.closing(step_control.next_time(), parameters.local_error * way(largest_speed));
  if (closing.part < 1.)
    result = {closing.part * size, model.problem().contact().pairs()[closing.pair].name};
  if (!model.is_moving())
    return result;
  const double motion  = expected.largest_motion(step_control.next_time());
  const double allowed = safety * model.problem().parameters.moving.largest_motion
                         * model.problem().grid.finest_size();
  if (motion > allowed && size * allowed / motion < result.time_left)
    result = {size * allowed / motion, ""};
  return result;
}

template <int dim>
void
StepAccuracy<dim>::begin_attempt()
{
  if (is_active())
    local_error.emplace(model.problem(), model.time_scheme(), model.state());
}

template <int dim>
typename StepAccuracy<dim>::Changes
StepAccuracy<dim>::changes() const
{
  const auto &pairs  = model.problem().contact().pairs();
  const auto &before = local_error->were_closed();
  const auto  after  = local_error->are_closed();
  Changes     result;
  result.bodies.resize(model.state().bodies.size());
  for (unsigned int p = 0; p < pairs.size(); ++p)
    {
      if (before[p] == after[p])
        continue;
      result.bodies[pairs[p].a] = result.bodies[pairs[p].b] = true;
      result.names += (result.are_any ? ", " : "") + pairs[p].name;
      result.are_any = true;
      result.have_begun |= after[p];
    }
  return result;
}

template <int dim>
bool
StepAccuracy<dim>::test(const Vector &u, const Rates &rates, const Solve &solve,
                        Attempt<dim> &attempt)
{
  if (!is_active())
    return true;
  const double        size = step_control.step_size(), tolerance = parameters.local_error;
  std::vector<double> errors = local_error->of_bodies(u, rates, step_control.next_time(), solve);
  const auto          speeds = root_mean_squares(model.problem(), u, rates.velocity);
  speed = std::max(largest_speed, *std::max_element(speeds.begin(), speeds.end()));
  const auto   of_contact = changes();
  double       all = 0., others = 0.;
  unsigned int n_others = 0;
  for (unsigned int b = 0; b < errors.size(); ++b)
    {
      all = std::max(all, errors[b] / way(speed));
      if (of_contact.bodies[b])
        continue;
      others = std::max(others, errors[b] / way(speed));
      ++n_others;
    }
  const unsigned int order = model.time_scheme().local_error(size).order;
  const bool hardly_falls  = last_error > 0. && all > last_error * std::sqrt(size / last_step_size);
  const bool leaves_out    = all > tolerance && of_contact.are_any
                          && (!of_contact.have_begun || hardly_falls || step_control.is_smallest());
  const double error         = leaves_out ? others : all;
  last_error                 = all;
  last_step_size             = size;
  attempt.record.local_error = error;
  if (!leaves_out || n_others > 0)
    attempt.error = StepError{error / tolerance, order};
  const std::string words = "Step " + std::to_string(attempt.record.step) + " to time "
                            + short_number(attempt.record.time) + ": ";
  if (leaves_out)
    run_log.log.line(words + "contact of " + of_contact.names
                     + " begins or ends there, which is no error of the scheme");
  if (error <= tolerance)
    return true;
  run_log.log.line(words + "local error " + short_number(error) + " of " + short_number(tolerance)
                   + (step_control.is_smallest() ? ", but steps may not be smaller" : ""));
  return step_control.is_smallest();
}

template <int dim>
void
StepAccuracy<dim>::accept()
{
  largest_speed = speed;
  last_error    = 0.;
}

template class StepAccuracy<2>;
template class StepAccuracy<3>;
} // namespace scree
