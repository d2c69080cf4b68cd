#include <scree/application/study_parameters.h>
#include <scree/base/exceptions.h>
#include <scree/parameters/expression_entry.h>
#include <scree/parameters/nearest_name.h>
#include <scree/parameters/values.h>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace scree
{
namespace
{
const EnumNames<StudyStrategy> strategy_names
  = {{StudyStrategy::uniform, "uniform"}, {StudyStrategy::adaptive, "adaptive"}};

const EnumNames<StudyExtreme> extreme_names = {{StudyExtreme::none, "none"},
                                               {StudyExtreme::maximum, "maximum"},
                                               {StudyExtreme::minimum, "minimum"}};
} // namespace

template <int dim>
void
StudyQuantity<dim>::declare(ParameterSection &section)
{
  path = section.path();
  section.entry(
    "Pair", pair,
    "Name of a pair in contact, as block-cylinder: the quantity is a curve, a column of "
    "its contact table in the last load step, or its Extreme; empty: a number.");
  section.entry(
    "Column", column,
    "Column of history.csv or probes.csv, as block-cylinder.force_y; with Pair a column "
    "of the contact table: cell_pressure, pressure, gap, ...");
  section.entry("Extreme", extreme, extreme_names,
                "none: the value of the last load step, with Pair the curve; maximum, minimum: the "
                "largest or smallest value of all load steps, with Pair of all contact points in "
                "the last one, a number. By sign, not by magnitude.");
  section.entry("Reference", reference,
                "The value to compare with, a formula; for a curve a formula of position x, y, z. "
                "Empty, and no file: the last cycle.");
  section.file("Reference file", file,
               "CSV file with the curve to compare with, relative to the working directory or to "
               "the parameter file.");
  section.entry("Reference columns", file_columns,
                "The two columns of that file, coordinate and value.");
  section.entry("Along", along, "Coordinate of a curve, a formula of position x, y, z.");
  if (section.is_documentation())
    return;
  if (column.empty())
    section.error("Column", "is needed", "name a column, for example energy.strain");
  if (!reference.empty())
    check_expression<dim>(section, "Reference", reference, 1);
  check_expression<dim>(section, "Along", along, 1);
  if (!reference.empty() && !file.empty())
    section.error("Reference file", "there is a Reference too", "remove one of them");
  if (file.empty())
    return;
  if (!is_curve())
    section.error("Reference file", "only curves are compared with a file",
                  "set Pair and no Extreme, or give the number as Reference");
  else
    try
      {
        curve = read_curve(file, file_columns);
      }
    catch (const UserError &error)
      {
        section.error("Reference file", error.what());
      }
}

template <int dim>
void
StudyParameters<dim>::declare(ParameterSection &section, const GridParameters<dim> &grid)
{
  section.entry("Cycles", n_cycles, dealii::Patterns::Integer(1, 20),
                "Number of runs, each on a finer grid than the one before; 1: no study.");
  section.entry(
    "Strategy", strategy, strategy_names,
    "uniform: every cell is divided; adaptive: cells of large estimated error are "
    "divided, and the cells in contact and Grid/Band cells around them get one level more.");
  section.entry("Marked share", share, dealii::Patterns::Double(0., 1.),
                "adaptive: the cells that are divided hold this share of the squared error; no "
                "dimension.");
  section.entry("Finest level", finest_level, dealii::Patterns::Integer(0, 20),
                "No cell is divided beyond this level (section Grid).");
  for (auto &[name, subsection] :
       section.named("Names", "Names of the quantities that are compared."))
    {
      quantities.emplace_back();
      quantities.back().name = name;
      quantities.back().declare(subsection);
    }
  if (section.is_documentation() || n_cycles == 1)
    return;
  if (finest_level < grid.finest_level)
    section.error("Finest level", "is below Finest level of section Grid", "raise it");
  double             n_cells = 1.;
  const unsigned int level
    = grid.refinement == GridRefinement::uniform ? grid.finest_level : grid.coarsest_level;
  for (const unsigned int n : grid.cells)
    n_cells *= double(n) * std::pow(2., level);
  if (strategy == StudyStrategy::uniform && n_cells * std::pow(2., dim * (n_cycles - 1.)) > 1e9)
    section.error("Cycles", "the last grid would have more than 1e9 cells",
                  "take fewer cycles or a coarser first grid");
  const double  finest   = std::min<double>(grid.finest_level + n_cycles - 1., finest_level);
  constexpr int key_bits = 63 / dim; // per direction
  for (const unsigned int n : grid.cells)
    if (std::log2(double(n)) + finest > key_bits - 1.)
      section.error("Cycles", "too many cells for a 64 bit Morton key", "lower it or Finest level");
}

Curve
read_curve(const std::string &file_name, const std::vector<std::string> &columns)
{
  require(columns.size() == 2, file_name, "two columns are needed, coordinate and value",
          "set Reference columns");
  std::ifstream file(file_name);
  require(file.good(), file_name, "the file cannot be read", "check the path");
  Curve                    curve;
  std::vector<std::string> names;
  std::size_t              place[2] = {0, 0};
  for (std::string line; std::getline(file, line);)
    {
      if (line.empty() || line[0] == '#')
        continue;
      const auto words = split_list(line);
      if (names.empty())
        {
          names = words;
          for (unsigned int i = 0; i < 2; ++i)
            {
              place[i] = std::find(names.begin(), names.end(), columns[i]) - names.begin();
              require(place[i] < names.size(), file_name,
                      "there is no column '" + columns[i] + "'" + did_you_mean(columns[i], names));
            }
          continue;
        }
      double values[2];
      for (unsigned int i = 0; i < 2; ++i)
        require(place[i] < words.size() && parse_value(words[place[i]], values[i]).ok, file_name,
                "the line '" + line + "' has no number in column '" + columns[i] + "'");
      curve.emplace_back(values[0], values[1]);
    }
  require(curve.size() > 1, file_name, "fewer than two points");
  std::sort(curve.begin(), curve.end());
  return curve;
}

double
interpolate(const Curve &curve, const double coordinate)
{
  const auto after
    = std::upper_bound(curve.begin(), curve.end(), coordinate,
                       [](const double c, const auto &point) { return c < point.first; });
  if (after == curve.begin())
    return curve.front().second;
  if (after == curve.end())
    return curve.back().second;
  const auto &[c0, v0] = *(after - 1);
  const auto &[c1, v1] = *after;
  return v0 + (v1 - v0) * (coordinate - c0) / (c1 - c0);
}

template struct StudyQuantity<2>;
template struct StudyQuantity<3>;
template struct StudyParameters<2>;
template struct StudyParameters<3>;
} // namespace scree
