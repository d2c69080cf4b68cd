#include <scree/application/refinement_study.h>
#include <scree/base/exceptions.h>
#include <scree/contact/contact_cells.h>
#include <scree/mechanics/error_indicator.h>
#include <scree/parameters/nearest_name.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <iomanip>
#include <limits>
#include <sstream>

namespace scree
{
namespace
{
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/** Relative errors below it, as of equilibrium, have no order. */
constexpr double round_off = 1e-7;

/** Level sets are dense: a grid must not need more nodal values than this (1.5 GB at set-up). */
constexpr double most_level_set_values = 1e8;

/** Index of a name; @throws UserError with the nearest one if it is not there */
unsigned int
index_of(const std::string &name, const std::vector<std::string> &names, const std::string &where,
         const std::string &what)
{
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end())
    return found - names.begin();
  std::string all;
  for (const std::string &candidate : names)
    all += (all.empty() ? "" : ", ") + candidate;
  throw UserError(where, "there is no " + what + " '" + name + "'" + did_you_mean(name, names),
                  all.empty() ? "" : "choose one of: " + all);
}

template <int dim>
unsigned int
pair_index(const StudyQuantity<dim> &quantity, const ContactPoints<dim> &contact)
{
  std::vector<std::string> names;
  for (const ContactPair &pair : contact.pairs())
    names.push_back(pair.name);
  return index_of(quantity.pair, names, quantity.path + "/Pair", "pair in contact");
}

/** Of the values so far, NaN if there is none, and one more. */
double
chosen(const StudyExtreme extreme, const double so_far, const double value)
{
  switch (extreme)
    {
    case StudyExtreme::maximum:
      return std::fmax(so_far, value); // a number rather than NaN
    case StudyExtreme::minimum:
      return std::fmin(so_far, value);
    case StudyExtreme::none:
      break;
    }
  return value;
}

/** Nodal values of the level sets of all bodies. */
template <int dim>
double
n_level_set_values(const std::vector<Body<dim>> &bodies)
{
  double sum = 0.;
  for (const Body<dim> &body : bodies)
    {
      double product = 1.;
      for (const auto n : body.level_set.n_nodes())
        product *= n;
      sum += product;
    }
  return sum;
}
} // namespace

template <int dim>
RefinementStudy<dim>::RefinementStudy(const Parameters<dim> &parameters,
                                      const std::string     &output_directory,
                                      const MPI_Comm         communicator)
    : parameters(parameters)
    , first_finest_level(parameters.grid.finest_level)
    , first_shift(parameters.contact.shift)
    , directory(output_directory)
    , communicator(communicator)
    , log(communicator, output_directory + "/log.txt")
{
  // Cycles cannot be resumed: what came before them would be missing.
  this->parameters.output.checkpoint_every   = 0;
  this->parameters.output.checkpoint_minutes = 0.;
}

template <int dim>
std::unique_ptr<Simulation<dim>>
RefinementStudy<dim>::set_up(const unsigned int cycle)
{
  const std::string folder = directory + "/cycle-" + std::to_string(cycle);
  if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
    std::filesystem::create_directories(folder);
  MPI_Barrier(communicator);
  log.line("Cycle " + std::to_string(cycle) + " of " + std::to_string(parameters.study.n_cycles));
  return std::make_unique<Simulation<dim>>(parameters, folder, communicator);
}

template <int dim>
std::vector<unsigned int>
RefinementStudy<dim>::columns_of_quantities(const Simulation<dim> &simulation) const
{
  std::vector<unsigned int> result;
  for (const auto &quantity : parameters.study.quantities)
    {
      const bool is_of_pair = !quantity.pair.empty();
      if (is_of_pair)
        pair_index(quantity, simulation.get_model().problem().contact());
      const auto names = is_of_pair ? contact_columns<dim>() : simulation.columns();
      result.push_back(index_of(quantity.column, names, quantity.path + "/Column", "column"));
    }
  return result;
}

template <int dim>
void
RefinementStudy<dim>::check()
{
  const auto simulation = set_up(0);
  columns_of_quantities(*simulation);
  simulation->check();
}

template <int dim>
void
RefinementStudy<dim>::run()
{
  const unsigned int n_cycles = parameters.study.n_cycles;
  for (unsigned int c = 0; c < n_cycles; ++c)
    {
      const std::clock_t start      = std::clock();
      const auto         simulation = set_up(c);
      const auto         columns    = columns_of_quantities(*simulation);
      Cycle              cycle;
      cycle.numbers.assign(parameters.study.quantities.size(), unknown);
      cycle.curves.resize(parameters.study.quantities.size());
      simulation->run([&]() { note_step(*simulation, columns, cycle); });
      const DiscreteProblem<dim> &problem = simulation->get_model().problem();
      cycle.n_cells                       = problem.grid.triangulation().n_global_active_cells();
      cycle.n_unknowns                    = problem.space.n_dofs();
      cycle.finest_edge                   = problem.grid.finest_size();
      cycle.seconds
        = dealii::Utilities::MPI::sum(double(std::clock() - start) / CLOCKS_PER_SEC, communicator);
      ErrorEstimate estimate; // none on a moving geometry
      if (!problem.is_moving())
        estimate = estimate_error(problem, simulation->get_model().state());
      cycle.error_estimate = estimate.relative;
      measure_contacts(*simulation, columns, cycle);
      cycles.push_back(cycle);
      if (c + 1 < n_cycles && !choose_next_grid(*simulation, estimate))
        {
          log.line("No cell is left to divide: the study ends here");
          break;
        }
    }
  write_table();
}

template <int dim>
void
RefinementStudy<dim>::note_step(const Simulation<dim>           &simulation,
                                const std::vector<unsigned int> &columns, Cycle &cycle) const
{
  const auto values = simulation.last_values();
  for (unsigned int q = 0; q < cycle.numbers.size(); ++q)
    if (const StudyQuantity<dim> &quantity = parameters.study.quantities[q]; quantity.pair.empty())
      cycle.numbers[q] = chosen(quantity.extreme, cycle.numbers[q], values[columns[q]]);
}

template <int dim>
void
RefinementStudy<dim>::measure_contacts(const Simulation<dim>           &simulation,
                                       const std::vector<unsigned int> &columns, Cycle &cycle) const
{
  const unsigned int weight
    = index_of("weight", contact_columns<dim>(), "Refinement study", "column");
  const auto &contact = simulation.get_model().problem().contact();
  const auto  all     = dealii::Utilities::MPI::all_gather(communicator, contact_rows(contact));
  for (unsigned int q = 0; q < cycle.curves.size(); ++q)
    {
      const StudyQuantity<dim> &quantity = parameters.study.quantities[q];
      if (quantity.pair.empty())
        continue;
      const Expression<dim> along(quantity.along, 1, quantity.path + "/Along");
      const Expression<dim> formula(quantity.reference.empty() ? "0" : quantity.reference, 1,
                                    quantity.path + "/Reference");
      const unsigned int    pair = pair_index(quantity, contact);
      for (const auto &rows : all)
        for (const auto &row : rows)
          if (row[0] == pair)
            {
              dealii::Point<dim> position;
              for (unsigned int d = 0; d < dim; ++d)
                position[d] = row[1 + d];
              cycle.curves[q].push_back(
                {along.value(position), row[columns[q]], row[weight], formula.value(position)});
            }
      for (const CurvePoint &point : cycle.curves[q])
        cycle.numbers[q] = chosen(quantity.extreme, cycle.numbers[q], point.value);
    }
}

template <int dim>
bool
RefinementStudy<dim>::choose_next_grid(const Simulation<dim> &simulation,
                                       const ErrorEstimate   &estimate)
{
  const Model<dim>          &model      = simulation.get_model();
  const BackgroundGrid<dim> &grid       = model.problem().grid;
  const double               per_level  = 1u << dim;
  unsigned int               affordable = parameters.grid.finest_level;
  double                     n_values   = per_level * n_level_set_values(model.state().bodies);
  while (n_values <= most_level_set_values)
    {
      ++affordable;
      n_values *= per_level;
    }
  std::vector<unsigned int> levels;
  for (unsigned int c = 0; c < grid.n_owned_cells(); ++c)
    levels.push_back(grid.cells()[c].iterator->level());
  std::vector<unsigned int> wanted_levels = levels;
  if (parameters.study.strategy == StudyStrategy::uniform)
    for (unsigned int &level : wanted_levels)
      ++level;
  else
    {
      const auto marked = largest_share(estimate.squares, parameters.study.share, communicator);
      // Finest cells around contact as many as by section Grid, when they are divided.
      const auto   in_contact = cells_around(model.state().was_closed, model.problem().contact(),
                                             grid, 0.5 * parameters.grid.band);
      unsigned int level_of_contact = 0;
      for (unsigned int c = 0; c < levels.size(); ++c)
        if (in_contact[c])
          level_of_contact = std::max(level_of_contact, levels[c] + 1);
      level_of_contact = dealii::Utilities::MPI::max(level_of_contact, communicator);
      for (unsigned int c = 0; c < levels.size(); ++c)
        wanted_levels[c] = in_contact[c] ? level_of_contact : levels[c] + marked[c];
    }
  unsigned int finest = 0;
  for (const unsigned int level : wanted_levels)
    finest = std::max(finest, level);
  finest = dealii::Utilities::MPI::max(finest, communicator);
  if (finest > affordable && affordable < parameters.study.finest_level)
    log.line("Cells are not divided beyond level " + std::to_string(affordable)
             + ": the level sets would need too much memory");
  unsigned int n_divided = 0;
  for (unsigned int c = 0; c < levels.size(); ++c)
    {
      const unsigned int level
        = std::min({wanted_levels[c], affordable, parameters.study.finest_level});
      n_divided += level > levels[c];
      levels[c] = std::max(levels[c], level);
    }
  if (dealii::Utilities::MPI::sum(n_divided, communicator) == 0)
    return false;
  const auto wanted = std::make_shared<const WantedLevels>(grid.wanted_levels(levels));
  parameters.grid   = parameters.grid.with(wanted);
  // The reach of contact keeps its length.
  parameters.contact.shift
    = first_shift * std::pow(2., double(wanted->finest_level) - double(first_finest_level));
  return true;
}

template <int dim>
typename RefinementStudy<dim>::Comparison
RefinementStudy<dim>::compare(const unsigned int quantity, const unsigned int cycle) const
{
  const StudyQuantity<dim> &q       = parameters.study.quantities[quantity];
  const bool                is_last = cycle + 1 == cycles.size();
  if (!q.is_curve())
    {
      const double value = cycles[cycle].numbers[quantity];
      const double reference
        = q.compares_with_last()
            ? cycles.back().numbers[quantity]
            : Expression<dim>(q.reference, 1, q.path + "/Reference").value(dealii::Point<dim>());
      const double error
        = std::abs(value - reference) / (reference != 0. ? std::abs(reference) : 1.);
      return {value, q.compares_with_last() && is_last ? unknown : error};
    }
  Curve curve = q.curve;
  if (q.compares_with_last())
    {
      for (const CurvePoint &point : cycles.back().curves[quantity])
        curve.emplace_back(point.coordinate, point.value);
      std::sort(curve.begin(), curve.end());
    }
  if (cycles[cycle].curves[quantity].empty() || (curve.empty() && q.reference.empty()))
    return {unknown, unknown};
  double of_value = 0., of_reference = 0., of_difference = 0.;
  for (const auto &[coordinate, value, weight, by_formula] : cycles[cycle].curves[quantity])
    {
      const double reference = curve.empty() ? by_formula : interpolate(curve, coordinate);
      of_value += weight * value * value;
      of_reference += weight * reference * reference;
      of_difference += weight * (value - reference) * (value - reference);
    }
  const double error = std::sqrt(of_difference / (of_reference != 0. ? of_reference : 1.));
  return {std::sqrt(of_value), q.compares_with_last() && is_last ? unknown : error};
}

template <int dim>
void
RefinementStudy<dim>::write_table()
{
  std::vector<std::string> names
    = {"cycle", "cells", "unknowns", "finest_edge", "cpu_seconds", "error_estimate"};
  for (const auto &quantity : parameters.study.quantities)
    for (const std::string suffix : {"", ".error", ".order"})
      names.push_back(quantity.name + suffix);
  std::vector<std::vector<double>> rows;
  for (unsigned int c = 0; c < cycles.size(); ++c)
    {
      const Cycle &cycle = cycles[c];
      rows.push_back({double(c), double(cycle.n_cells), double(cycle.n_unknowns), cycle.finest_edge,
                      cycle.seconds, cycle.error_estimate});
      for (unsigned int q = 0; q < parameters.study.quantities.size(); ++q)
        {
          const Comparison present = compare(q, c);
          double           order   = unknown;
          if (c > 0 && cycle.n_unknowns != cycles[c - 1].n_unknowns)
            if (const double before = compare(q, c - 1).error;
                before > round_off && present.error > round_off)
              order = dim * std::log(before / present.error)
                      / std::log(double(cycle.n_unknowns) / cycles[c - 1].n_unknowns);
          rows.back().insert(rows.back().end(), {present.value, present.error, order});
        }
    }
  if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
    {
      CsvTable table(directory + "/study.csv", names);
      table.add_rows(rows);
    }
  const auto print = [&](const auto &text_of_column) {
    std::ostringstream line;
    for (unsigned int i = 0; i < names.size(); ++i)
      line << std::setw(std::max<int>(12, names[i].size() + 2)) << text_of_column(i);
    log.line(line.str());
  };
  log.line("Refinement study:");
  print([&](const unsigned int i) { return names[i]; });
  for (const auto &row : rows)
    print([&](const unsigned int i) {
      return std::isnan(row[i]) ? "-"
             : i < 3            ? std::to_string(std::lround(row[i]))
                                : short_number(row[i]);
    });
  log.line("The table is " + directory + "/study.csv");
}

template class RefinementStudy<2>;
template class RefinementStudy<3>;
} // namespace scree
