#pragma once

#include <scree/output/body_output.h>
#include <scree/output/contact_output.h>
#include <scree/output/csv_table.h>
#include <scree/output/field_parameters.h>
#include <scree/output/force_chains.h>
#include <scree/output/long_tables.h>
#include <scree/output/probes.h>
#include <scree/output/step_record.h>

#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace scree
{
/** The bodies and their contact after the geometry moved at the end of a step. */
template <int dim>
struct MotionRecord
{
  std::vector<double>           volumes; //!< of all bodies by their level sets [L^dim]
  std::vector<PointTotals<dim>> points;  //!< of all bodies
  /** By how much the tangential forces of pairs (a, b) changed when their points were found anew.
   */
  std::map<std::pair<unsigned int, unsigned int>, dealii::Tensor<1, dim>> force_jumps;
  MovingLeastSquaresReport                                                transfer_report;
  unsigned int                                                            n_islands = 0;
};

/** What was written so far: a run that is resumed goes on after it. */
struct ResultsRecord
{
  std::vector<std::pair<double, std::string>> bodies, contact, points, chains; //!< of PVD
  std::size_t                                 n_history_rows = 0, n_probe_rows = 0;
  LongTablesRecord                            long_tables;

  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &bodies &contact &points &chains &n_history_rows &n_probe_rows &long_tables;
  }
};

/** Which columns tables with a row per step have beside those of all runs. */
struct StepColumns
{
  bool stage       = false;
  bool local_error = false; //!< of history.csv
};

/**
 * The files of a run: history.csv with a row per load step, see also LongTables, VTU and CSV files
 * of bodies, contact and force chains with PVD records, tables of probes and lines. All functions
 * are collective.
 */
template <int dim>
class Results
{
public:
  using Vector = dealii::TrilinosWrappers::MPI::Vector;

  /** history.csv has columns of pairs only if there are at most as many. */
  static constexpr unsigned int most_pairs_in_history = 30;

  /**
   * @param pairs_change from step to step: history.csv has no columns of them
   * @param of_steps     columns of tables with a row per step
   */
  Results(const std::string &directory, const std::vector<Body<dim>> &bodies,
          const std::vector<ProbeParameters<dim>> &probes, const FieldParameters &fields,
          const bool pairs_change, const StepColumns &of_steps);

  /** What the next results refer to; to be told whenever it was made anew. */
  void set_discretization(const DisplacementSpace<dim> &space,
                          const LevelSetNodes<dim>     &level_set_nodes);

  /**
   * Names of the columns of history.csv, including those of pairs if they are too many for the
   * file, then those of probes.csv after the first.
   */
  std::vector<std::string> columns(const Equilibrium<dim>   &equilibrium,
                                   const ContactPoints<dim> &contact) const;

  /** @throws UserError if two of columns() have the same name */
  void require_distinct_columns(const Equilibrium<dim>   &equilibrium,
                                const ContactPoints<dim> &contact) const;

  /** The values of columns() at the last write_history() and write_probes(), on all processes. */
  std::vector<double> last_values() const;

  /** Gathers the rows of an accepted state for history.csv and the long tables. */
  void gather_history(const StepRecord &record, const Equilibrium<dim> &equilibrium,
                      const ContactPoints<dim> &contact, const CutQuadrature<dim> &quadrature,
                      const Vector &u);

  /**
   * Names of what the last gather_history() found: columns of history.csv, but those of the motion
   * after the step, and of assembly.csv if there is one.
   */
  std::vector<std::string> quantities(const Equilibrium<dim>   &equilibrium,
                                      const ContactPoints<dim> &contact) const;

  /** Their values between gather_history() and gather_motion(), on the first process. */
  std::vector<double> quantity_values() const;

  /** Adds to it what the motion of the geometry after the step found: see MotionRecord. */
  void gather_motion(const MotionRecord<dim> &motion);

  /** Writes the gathered rows. @throws UserError if that of history.csv has no finite number */
  void write_history();

  /**
   * VTU of bodies and, of an assembly, force chains; lines; whether all was written, known to the
   * first process.
   *
   * @param velocities null without inertia
   */
  bool write_fields(const StepRecord &record, const Kinematics<dim> &kinematics,
                    const Vector &ghosted_u, const VelocityField<dim> *velocities);

  /** Contact CSV and VTU; whether all was written, known to the first process. */
  bool write_contact(const StepRecord &record, const ContactPoints<dim> &contact);

  /** VTU of the material points after a step; whether all was written, known to the first process.
   */
  bool write_points(const StepRecord &record, const MaterialPoints<dim> &points,
                    const bool has_inertia);

  /** Throws UserError if the body of a probe has no cell at one of its points. */
  void require_probes(const Kinematics<dim> &kinematics, const Vector &ghosted_u) const;

  /** Rows of the probes in probes.csv. */
  void write_probes(const StepRecord &record, const Kinematics<dim> &kinematics,
                    const Vector &ghosted_u);

  /** Writes rows of tables that the disk refused before; whether nothing is left. */
  bool flush();

  /** What is in the files; known to the first process. */
  ResultsRecord record() const;

  /**
   * Cuts tables and PVD records off after what is recorded.
   * @throws UserError if the tables do not have it
   */
  void resume(const ResultsRecord &record, const Equilibrium<dim> &equilibrium,
              const ContactPoints<dim> &contact);

private:
  /** Samples of a probe; on a moving geometry NaN where its body is no more. */
  std::vector<std::vector<double>> sample_probe(const ProbeParameters<dim> &probe,
                                                const Kinematics<dim>      &kinematics,
                                                const Vector               &ghosted_u) const;
  /** Of gather_history(). */
  std::vector<std::string> state_columns(const Equilibrium<dim>   &equilibrium,
                                         const ContactPoints<dim> &contact) const;
  std::vector<std::string> history_columns(const Equilibrium<dim>   &equilibrium,
                                           const ContactPoints<dim> &contact) const;
  /** The pairs that are the same in all steps. */
  const std::vector<ContactPair> &pairs_with_columns(const ContactPoints<dim> &contact) const;
  /** The columns of pairs, if history.csv has none of them. */
  std::set<std::string>    left_out(const Equilibrium<dim>   &equilibrium,
                                    const ContactPoints<dim> &contact) const;
  std::vector<std::string> probe_columns() const;
  std::vector<std::string> probe_table_columns() const;
  /** Adds a file to a PVD record; false if the file, empty, or the record was not written. */
  bool add_picture(const double time, const std::string &file, const std::string &pvd,
                   std::vector<std::pair<double, std::string>> &records) const;
  bool write_pvd(const std::string                                 &name,
                 const std::vector<std::pair<double, std::string>> &records) const;

  std::string                                 directory;
  const std::vector<Body<dim>>               &bodies;
  std::vector<ProbeParameters<dim>>           probes;
  FieldParameters                             fields;
  bool                                        pairs_change;
  StepColumns                                 of_steps;
  const DisplacementSpace<dim>               *space = nullptr;
  const LevelSetNodes<dim>                   *nodes = nullptr;
  std::unique_ptr<BodyOutput<dim>>            body_output;      //!< made when first needed
  bool                                        is_first = false; //!< this process writes the tables
  std::unique_ptr<CsvTable>                   history, probe_table;
  LongTables<dim>                             long_tables;
  ForceChains<dim>                            chains; //!< of the last gather_history()
  std::vector<std::string>                    history_names;
  std::set<std::string>                       names_left_out;
  bool                                        is_moving = false;
  std::vector<double>                         history_row, probe_row; //!< the last ones
  std::vector<std::pair<double, std::string>> body_records, contact_records, point_records,
    chain_records;
};
} // namespace scree
