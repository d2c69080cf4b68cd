#pragma once

#include <scree/bodies/body.h>
#include <scree/contact/contact_parameters.h>
#include <scree/parameters/section.h>
#include <scree/solver/step_control.h>

#include <array>
#include <boost/serialization/array.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace scree
{
/**
 * What a stage makes of each component of a rigid body: a formula of t, by how much the motion or
 * the load changes; `keep`, as it is when the stage begins; `to 3`, from there to a value in equal
 * parts of time. Empty: nothing is said.
 */
template <int dim>
struct StageMotion
{
  std::array<std::string, n_rigid_components<dim>> motion, load;
};

/**
 * One stage of loading: an interval of the time of the run with steps of its own. In its formulas
 * t is the time since it began, and they say by how much a motion or a load has changed since then.
 */
template <int dim>
struct StageParameters
{
  std::string                             name;
  double                                  duration = 1.; //!< [time], > 0; with `until` the longest
  unsigned int                            steps    = 1;  //!< nominal ones, >= 1
  std::string                             until; //!< a StopRelation that ends it; empty: none
  bool                                    resets = false; //!< it begins free of stress and strain
  bool                                    is_static = false; //!< whatever the scheme of the run
  std::map<std::string, StageMotion<dim>> bodies;            //!< by the name of the rigid body
  std::map<std::string, double>           friction; //!< coefficients by the name of the contact law
};

/** What a run has found on its way through the stages, from which it may go on. */
template <int dim>
struct StageRecord
{
  using Components = std::array<double, n_rigid_components<dim>>;

  std::vector<double> ends; //!< of the stages that are over [time]
  /** By stage that has begun and by its rigid bodies: where they were then, or the load that they
   * bore, as the stage changes the one or the other. */
  std::vector<std::map<std::string, Components>> starts;
  std::vector<double> lengths; //!< of the assembly when the present stage began [L]
  /** Of Until after the last step, NaN: there is none. */
  double margin = std::numeric_limits<double>::quiet_NaN();

  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &ends &starts &lengths &margin;
  }
};

/**
 * Reads section Stages. Recorded as problems: stages without inertia after one with it; bodies that
 * do not exist, are deformable, or of which nothing is said, or motion and load of the same
 * component; formulas that are not zero at t = 0; relations that are none; contact laws that do not
 * exist or have no friction coefficient.
 *
 * @param is_rigid whether a body of the materials of the run is rigid, by its name
 */
template <int dim>
std::vector<StageParameters<dim>>
declare_stages(ParameterSection &section, const std::vector<BodyParameters<dim>> &bodies,
               const std::map<std::string, bool> &is_rigid, const ContactParameters &contact);

/**
 * Puts the stages one after the other on the time axis, where the nominal steps end: those that are
 * over as they were, the others in full length. Nothing changes if there are no stages.
 */
template <int dim>
void set_times(const std::vector<StageParameters<dim>> &stages, const StageRecord<dim> &record,
               TimeParameters &time);

/**
 * What drives rigid bodies in all stages: f(t) of a body's section becomes
 *
 *     f(t) + sum over stages k of f_k(min(max(t - T_k, 0), D_k)),
 *
 * T_k the beginning of the stage, D_k its duration. A stage that turns from the motion to the load
 * or back, or that leads to a value, has in the place of what comes before the value with which it
 * began; before it has begun, it and what comes after it are left out.
 *
 * @param bodies those of the input
 */
template <int dim>
void set_motions(const std::vector<StageParameters<dim>> &stages, const StageRecord<dim> &record,
                 std::vector<BodyParameters<dim>> &bodies);

/** Whether a load drives a component of the body in a stage. */
template <int dim>
bool is_ever_free(const std::vector<StageParameters<dim>> &stages, const std::string &body);

/** Whether the stage that a run has reached is one without inertia. */
template <int dim>
bool is_static(const std::vector<StageParameters<dim>> &stages, const StageRecord<dim> &record);

/** @throws UserError if a checkpoint's record is not of a run through these stages */
template <int dim>
void require_record_of(const std::vector<StageParameters<dim>> &stages,
                       const StageRecord<dim>                  &record);

/** Friction as the stages that have begun have left it. @return whether it is not as it was */
template <int dim>
bool set_friction(const std::vector<StageParameters<dim>> &stages, const StageRecord<dim> &record,
                  ContactParameters &contact);
} // namespace scree
