#include <scree/application/stage_control.h>
#include <scree/output/column_names.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace scree
{
namespace
{
constexpr double unknown_margin = std::numeric_limits<double>::quiet_NaN();
}

template <int dim>
StageControl<dim>::StageControl(const std::vector<StageParameters<dim>> &stages,
                                const StageRecord<dim> &record, const MPI_Comm communicator)
    : stages(stages)
    , communicator(communicator)
    , current(record)
{
  require_record_of(stages, record);
  if (!stages.empty())
    present = std::min<unsigned int>(record.ends.size(), stages.size() - 1);
  set_stop();
}

template <int dim>
void
StageControl<dim>::set_stop()
{
  stop.reset();
  if (!stages.empty() && !stage().until.empty())
    stop.emplace(stage().until, "Stages/" + stage().name + "/Until");
}

template <int dim>
void
StageControl<dim>::require_known(const std::vector<std::string> &names) const
{
  std::vector<std::string> all = names;
  all.push_back("t");
  if (std::find(names.begin(), names.end(), "length_x") != names.end())
    add_vector_names<dim>("strain", all);
  for (const auto &s : stages)
    if (!s.until.empty())
      StopRelation(s.until, "Stages/" + s.name + "/Until").require_known(all);
}

template <int dim>
void
StageControl<dim>::begin_run(const std::vector<double> &lengths)
{
  current.lengths = lengths;
}

template <int dim>
double
StageControl<dim>::margin(const double time) const
{
  if (!stop)
    return unknown_margin;
  double result = unknown_margin;
  if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
    {
      Quantities quantities = observed;
      quantities["t"]       = time - (current.ends.empty() ? 0. : current.ends.back());
      for (unsigned int d = 0; d < current.lengths.size(); ++d)
        if (const auto length = observed.find("length_" + axes[d]); length != observed.end())
          quantities["strain_" + axes[d]] = length->second / current.lengths[d] - 1.;
      result = stop->margin(quantities);
    }
  result = dealii::Utilities::MPI::broadcast(communicator, result);
  return std::isfinite(result) ? result : unknown_margin;
}

template <int dim>
double
StageControl<dim>::observe(Quantities quantities, const double time)
{
  constexpr double of_change = 0.01;
  observed                   = std::move(quantities);
  new_margin                 = margin(time);
  if (!(new_margin > tolerance) || current.margin >= 0.)
    return 1.;
  if (std::isnan(current.margin))
    return 0.5;
  if (tolerance == 0.)
    tolerance = of_change * (new_margin - current.margin);
  return new_margin <= tolerance ? 1. : current.margin / (current.margin - new_margin);
}

template <int dim>
double
StageControl<dim>::planned_end() const
{
  return (current.ends.empty() ? 0. : current.ends.back()) + stage().duration;
}

template <int dim>
bool
StageControl<dim>::accept(const double time)
{
  if (stages.empty())
    return false;
  current.margin     = new_margin;
  const bool is_over = is_reached() || time >= planned_end();
  if (is_over)
    current.ends.push_back(time);
  else
    tolerance = 0.;
  return is_over;
}

template <int dim>
void
StageControl<dim>::begin_next(const std::vector<RigidBodyState<dim>> &states,
                              const std::vector<Body<dim>>           &bodies)
{
  if (current.ends.size() == stages.size())
    return;
  present = current.ends.size();
  current.starts.resize(present + 1);
  for (const auto &state : states)
    {
      const auto change = stage().bodies.find(bodies[state.body].name);
      if (change == stage().bodies.end())
        continue;
      auto &start = current.starts.back()[change->first];
      for (unsigned int m = 0; m < start.size(); ++m)
        {
          const bool         of_load = !change->second.load[m].empty();
          const unsigned int axis    = m < dim ? m : rotation_axis<dim>(m);
          if (m < dim)
            start[m] = of_load ? state.force[axis] : state.displacement[axis];
          else
            start[m] = of_load ? state.moment[axis] : state.rotation[axis];
        }
    }
  current.lengths.clear();
  for (unsigned int d = 0; d < dim; ++d)
    if (const auto length = observed.find("length_" + axes[d]); length != observed.end())
      current.lengths.push_back(length->second);
  tolerance = 0.;
  set_stop();
  current.margin = margin(current.ends.back());
}

template class StageControl<2>;
template class StageControl<3>;
} // namespace scree
