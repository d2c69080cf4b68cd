#pragma once

#include <scree/output/assembly.h>
#include <scree/output/csv_table.h>
#include <scree/output/step_record.h>

#include <boost/serialization/set.hpp>
#include <boost/serialization/utility.hpp>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace scree
{
/** What the long tables have so far: a run that is resumed goes on after it. */
struct LongTablesRecord
{
  std::size_t n_contact_rows = 0, n_body_rows = 0, n_assembly_rows = 0;
  std::set<std::pair<unsigned int, unsigned int>> met; //!< bodies of the pairs that were closed

  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &n_contact_rows &n_body_rows &n_assembly_rows &met;
  }
};

/**
 * The tables that grow with the number of bodies by rows, not by columns: contacts.csv, a row per
 * step and pair that is or was closed, with the columns that history.csv has of a pair and more,
 * grains.csv, a row per step and body, and assembly.csv, a row per step of what an Assembly tells.
 * Moments of a contact are about the origin,
 * with the points where the geometry of the step has them, and, as moment_a and moment_b, those on
 * the bodies a and b about their centroids; on a moving geometry these are at the end of the step.
 * What the first process gathers is written; the other ones have no files.
 */
template <int dim>
class LongTables
{
public:
  /** @param has_stages whether the tables have the column `stage` */
  LongTables(const std::string &directory, const std::vector<Body<dim>> &bodies,
             const bool has_stages = false);

  /**
   * Gathers the rows of a step.
   * @param grains  of all bodies
   * @param region  of the assembly
   * @param writes  whether this process writes the tables; the others note which pairs have met
   */
  void gather(const StepRecord &record, const std::vector<ContactPair> &pairs,
              const std::vector<ContactSummary<dim>> &summaries,
              const std::vector<GrainState<dim>> &grains, const AssemblyRegion<dim> &region,
              const bool geometry_is_moving, const bool writes);

  /** Adds the changes of the tangential forces of pairs: see MotionRecord. */
  void add_transfers(
    const std::map<std::pair<unsigned int, unsigned int>, dealii::Tensor<1, dim>> &force_jumps);

  /** Writes the gathered rows; contacts.csv only if there are pairs, assembly.csv only with pairs
   * and at least two deformable bodies. */
  void write();

  /** Writes rows that the disk refused before; whether nothing is left. */
  bool flush();

  /** Whether there are pairs, now or if one says so, and two deformable bodies. */
  bool is_assembly() const
  {
    return is_assembly(has_pairs);
  }
  bool is_assembly(const bool there_are_pairs) const;

  /** Of Assembly::columns() after the last gather(), on the process that writes. */
  std::vector<double> assembly_values() const;

  LongTablesRecord record() const;

  /** @throws UserError if the tables do not have what is recorded */
  void resume(const LongTablesRecord &record, const bool geometry_is_moving,
              const bool contact_has_pairs);

private:
  /** Columns and values with which each row begins. */
  std::vector<std::string> step_columns() const;
  std::vector<double>      step_values(const StepRecord &record) const;
  std::vector<std::string> contact_columns() const;
  std::vector<std::string> body_columns() const;
  std::vector<std::string> assembly_columns() const;
  void                     add_contact(const StepRecord &record, const ContactPair &pair,
                                       const ContactSummary<dim> &summary, const std::vector<GrainState<dim>> &grains);
  void add_body(const StepRecord &record, const std::string &name, const GrainState<dim> &state);

  std::string                                        directory;
  const std::vector<Body<dim>>                      &bodies;
  bool                                               has_stages;
  std::unique_ptr<CsvTable>                          contact_table, body_table, assembly_table;
  std::set<std::pair<unsigned int, unsigned int>>    met;
  bool                                               has_pairs = false, is_moving = false;
  std::vector<std::vector<std::string>>              contact_rows, body_rows; //!< to be written
  std::vector<double>                                assembly_row;
  std::vector<std::pair<unsigned int, unsigned int>> pairs_of_rows;
};
} // namespace scree
