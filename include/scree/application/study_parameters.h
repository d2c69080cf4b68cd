#pragma once

#include <scree/grid/background_grid.h>
#include <scree/parameters/section.h>

#include <string>
#include <vector>

namespace scree
{
/** How the grid of a cycle is made from that of the cycle before. */
enum class StudyStrategy
{
  /** every cell is divided */
  uniform,
  /** cells of large estimated error are divided, and contact gets one level more */
  adaptive
};

/** What of many values a quantity is. */
enum class StudyExtreme
{
  /** the value of the last load step, or all values along a contact */
  none,
  maximum,
  minimum
};

/** A reference curve: values over a coordinate, sorted. */
using Curve = std::vector<std::pair<double, double>>;

/**
 * What a refinement study compares: a number of the last load step or its extreme over all of them,
 * or values along a contact in the last load step or their extreme.
 */
template <int dim>
struct StudyQuantity
{
  std::string              name;
  std::string              path;   //!< section path, for messages
  std::string              pair;   //!< of a contact surface; empty: a number of all
  std::string              column; //!< of history.csv or probes.csv, or of the contact table
  StudyExtreme             extreme   = StudyExtreme::none;
  std::string              reference = ""; //!< formula; empty: none
  std::string              file;           //!< CSV with a reference curve; empty: none
  std::vector<std::string> file_columns;   //!< coordinate and value
  std::string              along = "x";    //!< formula of the coordinate of a curve
  Curve                    curve;          //!< read from `file`

  void declare(ParameterSection &section);

  bool is_curve() const
  {
    return !pair.empty() && extreme == StudyExtreme::none;
  }

  /** Whether the last cycle is the reference. */
  bool compares_with_last() const
  {
    return reference.empty() && file.empty();
  }
};

/** Parameters of section Refinement study. */
template <int dim>
struct StudyParameters
{
  unsigned int                    n_cycles = 1; //!< 1: a single run, no study
  StudyStrategy                   strategy = StudyStrategy::uniform;
  double                          share    = 0.5; //!< of the squared error, in the cells to divide
  unsigned int                    finest_level = 20; //!< no cell beyond
  std::vector<StudyQuantity<dim>> quantities;

  void declare(ParameterSection &section, const GridParameters<dim> &grid);
};

/**
 * Two columns of a CSV file with a header, as a curve sorted by the first; lines that start with
 * '#' are comments. @throws UserError if the file, a column or a number is missing
 */
Curve read_curve(const std::string &file_name, const std::vector<std::string> &columns);

/** Linear interpolation, constant beyond the ends. */
double interpolate(const Curve &curve, const double coordinate);
} // namespace scree
