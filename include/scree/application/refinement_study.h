#pragma once

#include <scree/application/simulation.h>
#include <scree/mechanics/error_estimate.h>

#include <memory>
#include <string>
#include <vector>

namespace scree
{
/**
 * Runs the problem on finer and finer grids and tabulates how the quantities of section Refinement
 * study converge. Each cycle is a full run with an output directory of its own, DIR/cycle-0 and so
 * on; its grid comes from that of the cycle before. The table is DIR/study.csv:
 *
 * cycle, cells, unknowns, finest_edge [L], cpu_seconds (of all processes), error_estimate
 * (relative, energy norm, by stress recovery), and for each quantity NAME, NAME.error, NAME.order.
 *
 * The error of a number v is |v - r|/|r|, that of a curve sqrt(int (v - r)^2 / int r^2) over the
 * contact surface, absolute if r = 0; NAME of a curve is sqrt(int v^2). The order is dim times the
 * slope of the error over the number N of unknowns, dim log(e_i/e_{i-1})/log(N_{i-1}/N_i): that of
 * the cell size on uniform grids; errors of round-off have none.
 */
template <int dim>
class RefinementStudy
{
public:
  /** @param output_directory where results go; must exist */
  RefinementStudy(const Parameters<dim> &parameters, const std::string &output_directory,
                  const MPI_Comm communicator);

  /** All cycles. @throws UserError if a quantity is unknown or a run fails */
  void run();

  /** Checks the quantities and shows the set-up of the first cycle; computes nothing. */
  void check();

private:
  /** A contact point of a curve. */
  struct CurvePoint
  {
    double coordinate, value, weight;
    double reference; //!< by the formula, if there is one
  };

  /** What is known of a cycle. */
  struct Cycle
  {
    unsigned int                         n_cells, n_unknowns;
    double                               finest_edge, seconds, error_estimate;
    std::vector<double>                  numbers; //!< per quantity; unused for curves
    std::vector<std::vector<CurvePoint>> curves;  //!< per quantity; empty without pair
  };

  /** The value of a quantity in a cycle and its error, NaN where there is no reference. */
  struct Comparison
  {
    double value, error;
  };

  std::unique_ptr<Simulation<dim>> set_up(const unsigned int cycle);
  /** Of each quantity, in the values of a step or in the contact table. @throws UserError if a
   * quantity is unknown */
  std::vector<unsigned int> columns_of_quantities(const Simulation<dim> &simulation) const;
  /** Takes the numbers of a load step into those of the cycle. */
  void note_step(const Simulation<dim> &simulation, const std::vector<unsigned int> &columns,
                 Cycle &cycle) const;
  /** Takes what lies along contacts after the last load step (collective). */
  void measure_contacts(const Simulation<dim> &simulation, const std::vector<unsigned int> &columns,
                        Cycle &cycle) const;
  /** Puts the next grid into the parameters; false if no cell is left to divide. */
  bool       choose_next_grid(const Simulation<dim> &simulation, const ErrorEstimate &estimate);
  Comparison compare(const unsigned int quantity, const unsigned int cycle) const;
  void       write_table();

  Parameters<dim>    parameters; //!< of the cycle at hand
  const unsigned int first_finest_level;
  const double       first_shift;
  std::string        directory;
  MPI_Comm           communicator;
  Log                log;
  std::vector<Cycle> cycles;
};
} // namespace scree
