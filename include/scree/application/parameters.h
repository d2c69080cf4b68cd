#pragma once

#include <scree/application/stages.h>
#include <scree/application/study_parameters.h>
#include <scree/contact/contact_parameters.h>
#include <scree/grid/background_grid.h>
#include <scree/mechanics/moving_geometry_parameters.h>
#include <scree/mechanics/time_scheme_parameters.h>
#include <scree/output/field_parameters.h>
#include <scree/output/probes.h>
#include <scree/parameters/file.h>
#include <scree/solver/linear_solver.h>
#include <scree/solver/newton.h>
#include <scree/solver/step_control.h>

#include <map>
#include <string>
#include <vector>

namespace scree
{
/** Parameters of section Output. */
template <int dim>
struct OutputParameters
{
  unsigned int    fields_every       = 1;     //!< VTU of the bodies, 0: never
  unsigned int    contact_every      = 1;     //!< CSV and VTU of contact, 0: never
  unsigned int    points_every       = 0;     //!< VTU of the material points, 0: never
  bool            log_iterations     = false; //!< a line in the log per Newton iteration
  unsigned int    checkpoint_every   = 10;    //!< steps, 0: not by steps
  double          checkpoint_minutes = 10.;   //!< wall time, 0: not by time
  FieldParameters fields;
  std::vector<ProbeParameters<dim>> probes;

  void declare(ParameterSection &section);
};

/** Everything a run needs to know: the parameters of all modules. */
template <int dim>
struct Parameters
{
  std::string              title;
  std::string              units; //!< names of those of length, stress and force; empty: not known
  GridParameters<dim>      grid;
  DiscretizationParameters discretization;
  std::map<std::string, MaterialParameters> materials;
  std::vector<BodyParameters<dim>>          bodies;
  ContactParameters                         contact;
  MovingGeometryParameters                  moving;
  TimeParameters                            time;   //!< with those of the stages
  std::vector<StageParameters<dim>>         stages; //!< empty: one motion for the whole run
  TimeSchemeParameters                      time_scheme;
  NewtonParameters                          newton;
  LinearSolverParameters                    linear_solver;
  OutputParameters<dim>                     output;
  StudyParameters<dim>                      study;
  std::map<std::string, std::string>        resolved; //!< all entries, value by path
  std::vector<std::string>                  warnings; //!< what is strange in the input

  /** Lets every module visit its section; problems are collected in the file. */
  void declare(ParameterFile &file);
};

/** The entry Dimension: 2 or 3. */
unsigned int declare_dimension(ParameterFile &file);
} // namespace scree
