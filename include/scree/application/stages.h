#pragma once

#include <scree/bodies/body.h>
#include <scree/parameters/section.h>
#include <scree/solver/step_control.h>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace scree
{
/** What a stage adds to the motion, or the load, of each component of a rigid body. */
template <int dim>
struct StageMotion
{
  std::array<std::string, n_rigid_components<dim>> motion; //!< formulas of t, empty: unset
  std::array<std::string, n_rigid_components<dim>> load;   //!< formulas of t, empty: unset
};

/**
 * One stage of loading: an interval of the time of the run with steps of its own. In its formulas
 * t is the time since it began, and they say by how much a motion or a load has changed since then.
 */
template <int dim>
struct StageParameters
{
  std::string                             name;
  double                                  duration = 1.; //!< [time], > 0
  unsigned int                            steps    = 1;  //!< nominal ones, >= 1
  std::map<std::string, StageMotion<dim>> bodies;        //!< by the name of the rigid body
};

/**
 * Reads section Stages. Recorded as problems: bodies that do not exist, are deformable, or of which
 * nothing is said; formulas that are not zero at t = 0; a motion where the load is given in section
 * Bodies, and a load where the motion is.
 *
 * @param is_rigid whether a body of the materials of the run is rigid, by its name
 */
template <int dim>
std::vector<StageParameters<dim>> declare_stages(ParameterSection                       &section,
                                                 const std::vector<BodyParameters<dim>> &bodies,
                                                 const std::map<std::string, bool>      &is_rigid);

/**
 * Puts the stages one after the other on the time axis: times of the nominal steps, and f(t) of a
 * body's section becomes
 *
 *     f(t) + sum over stages k of f_k(min(max(t - T_k, 0), D_k)),
 *
 * T_k the beginning of the stage, D_k its duration. Nothing changes if there are no stages.
 */
template <int dim>
void apply_stages(const std::vector<StageParameters<dim>> &stages,
                  std::vector<BodyParameters<dim>> &bodies, TimeParameters &time);
} // namespace scree
