#include <scree/application/parameters.h>
#include <scree/parameters/values.h>

#include <algorithm>
#include <set>

namespace scree
{
unsigned int
declare_dimension(ParameterFile &file)
{
  unsigned int dimension = 2;
  file.root().entry("Dimension", dimension, dealii::Patterns::Integer(2, 3),
                    "2: plane strain, unit thickness; 3.");
  return dimension;
}

namespace
{
/**
 * Pairs of bodies are called 'a-b': which of them would have the name of another pair or body, in
 * words; nothing if none.
 */
std::string
clashing_pairs(const std::vector<std::string> &names)
{
  const std::set<std::string> all(names.begin(), names.end());
  for (const std::string &name : names)
    for (std::size_t dash = name.find('-'); dash != std::string::npos;
         dash             = name.find('-', dash + 1))
      {
                    // name = head-tail, and head is a body: head-(tail-other) is (head-tail)-other.
        const std::string head = name.substr(0, dash), tail = name.substr(dash + 1);
        if (all.count(head) == 0)
          continue;
        if (all.count(tail) == 1)
          return "the pair of the bodies '" + head + "' and '" + tail
                 + "' would have the name of the body '" + name + "' in history.csv";
        for (const std::string &other : names)
          if (all.count(tail + "-" + other) == 1)
            return "the pairs of the bodies '" + name + "' and '" + other + "', and of '" + head
                   + "' and '" + tail + "-" + other + "', would both be called '" + name + "-"
                   + other + "' in history.csv";
      }
  return "";
}
} // namespace

template <int dim>
void
OutputParameters<dim>::declare(ParameterSection &section)
{
  section.entry("Fields every", fields_every,
                "The bodies are written as VTU after every so many load steps; 0: never.");
  fields.declare(section);
  section.entry("Contact every", contact_every,
                "The contact surface is written as CSV and VTU after every so many load steps; 0: "
                "never.");
  section.entry("Points every", points_every,
                "The material points of a moving geometry are written as VTU after every so many "
                "load steps; 0: never.");
  section.entry("Log iterations", log_iterations, "Write a line per Newton iteration to the log.");
  section.entry("Checkpoint minutes", checkpoint_minutes, dealii::Patterns::Double(0.),
                "What scree --resume needs is written after a step that ends so many minutes of "
                "wall time or more after the last time, and after the last step; 0: not by time.");
  section.entry("Checkpoint every", checkpoint_every,
                "It is also written after every so many load steps; 0: not by steps.");
  ParameterSection probe_section
    = section.subsection("Probes", "Points and lines where fields are tabulated.");
  for (auto &[name, subsection] : probe_section.named("Names", "Names of points and lines."))
    {
      probes.emplace_back();
      probes.back().name = name;
      probes.back().declare(subsection);
    }
}

namespace
{
void
check_units(const std::string &units, ParameterSection &root)
{
  if (!units.empty() && split_list(units, ',').size() != 3)
    root.error("Units", "'" + units + "' are not three names",
               "give those of length, stress and force, as in mm, MPa, N");
  if (units.find_first_of("&<\"") != std::string::npos)
    root.error("Units", "a name of a unit has none of the characters & < \"", "");
}

/** The first body whose law needs a moving geometry, and what is to be said of it. */
template <int dim>
std::string
law_that_moves(const Parameters<dim> &p)
{
  for (const auto &body : p.bodies)
    if (const auto material = p.materials.find(body.material);
        material != p.materials.end() && needs_moving_geometry(material->second.law))
      return "the body '" + body.name + "' is of the law '" + material->second.law
             + "', which needs a moving geometry";
  return "";
}

/** Settings that make no sense together. */
struct ImpossibleCombination
{
  bool             is_chosen;
  ParameterSection section;
  std::string      key, what, remedy;
};

template <int dim>
void
check_combinations(const Parameters<dim> &p, const ParameterSection &discretization,
                   const ParameterSection &moving, const ParameterSection &output,
                   const ParameterSection &study)
{
  const std::string           law          = law_that_moves(p);
  const unsigned int          n_gauss      = p.discretization.gauss_points().bulk;
  const unsigned int          least_points = p.discretization.degree + 1;
  const ImpossibleCombination table[]
    = {{n_gauss < least_points, discretization, "Bulk Gauss points",
        "with " + std::to_string(n_gauss) + " point(s) per direction some deformations of degree "
          + std::to_string(p.discretization.degree) + " have no stiffness",
        "set at least " + std::to_string(least_points) + ", or 0"},
       {!p.moving.is_moving && !law.empty(), moving, "Update", law,
        "set Update = every step, or choose Law = linear elastic"},
       {p.contact.grid_nodes.is_chosen && p.discretization.degree > 1, discretization, "Degree",
        "contact at grid nodes needs degree 1: areas of nodes of degree 2 may be negative",
        "set Degree = 1, or Contact/Surface = level sets"},
       {p.time_scheme.lumps_mass && p.discretization.degree > 1, discretization, "Degree",
        "a lumped mass needs degree 1: row sums of degree 2 may be negative",
        "set Degree = 1, or Time/Mass = consistent"},
       {!p.moving.is_moving && p.output.points_every > 0, output, "Points every",
        "a geometry that stays has no material points",
        "set Moving geometry/Update = every step, or Points every = 0"},
       {p.moving.is_moving && p.study.n_cycles > 1 && p.study.strategy == StudyStrategy::adaptive,
        study, "Strategy", "the error estimate needs a geometry that stays",
        "set Strategy = uniform, or Moving geometry/Update = none"}};
  for (const auto &combination : table)
    if (combination.is_chosen)
      combination.section.error(combination.key, combination.what, combination.remedy);
}

/** Whether a body is rigid, by its name. */
template <int dim>
std::map<std::string, bool>
rigid_bodies(const Parameters<dim> &p)
{
  std::map<std::string, bool> result;
  for (const auto &body : p.bodies)
    result[body.name]
      = p.materials.count(body.material) && p.materials.at(body.material).is_rigid();
  return result;
}

/** That the stages alone say how long the run is, and that steps by error have an error. */
template <int dim>
void
check_times(const Parameters<dim> &p, const ParameterSection &section)
{
  for (const std::string key : {"End time", "Steps"})
    if (!p.stages.empty() && section.is_set(key))
      section.error(key, "the stages have times and steps of their own",
                    "leave it out, or write it as Duration and Steps of a stage");
  if (p.time.is_by_error() && !p.time_scheme.has_inertia())
    section.error("Local error", "steps without inertia have no error of a time scheme",
                  "set Scheme = Newmark, generalized alpha or backward Euler, or leave it out");
}

/** Why the bodies of a run cannot be reset, and the remedy; empty: they can. */
template <int dim>
std::pair<std::string, std::string>
obstacle_to_reset(const Parameters<dim> &p)
{
  if (!p.moving.is_moving)
    return {"on a geometry that stays all is measured from the start of the run",
            "set Moving geometry/Update = every step"};
  if (p.time_scheme.has_inertia())
    return {"bodies that move with inertia would jump", "reset before, in a run without inertia"};
  for (const auto &law : p.contact.laws)
    if (law.adjust > 0. || law.kind->glues)
      return {"the contact law '" + law.name + "' takes gaps from the start of the run",
              "leave Adjust out: overlap at the start is resolved, and choose no tied law"};
  for (const auto &body : p.bodies)
    for (const auto &[name, condition] : body.conditions)
      if (condition.type != "traction" && condition.type != "pressure")
        return {"the condition '" + name + "' of the body '" + body.name
                  + "' is one on displacements from the start of the run",
                "hold the body by rigid ones"};
  return {};
}

template <int dim>
void
check_resets(const Parameters<dim> &p, const ParameterSection &section)
{
  const auto [what, remedy] = obstacle_to_reset(p);
  for (const auto &stage : p.stages)
    if (stage.resets && !what.empty())
      section.error("", "Reset of stage '" + stage.name + "': " + what, remedy);
}

/** That probes are in deformable bodies. */
template <int dim>
void
check_probes(const Parameters<dim> &p, ParameterSection &section)
{
  for (const auto &probe : p.output.probes)
    {
      const auto body = std::find_if(p.bodies.begin(), p.bodies.end(),
                                     [&](const auto &b) { return b.name == probe.body; });
      if (body == p.bodies.end())
        section.error("Probes", "probe '" + probe.name + "': there is no body '" + probe.body + "'",
                      "name a body of section Bodies");
      else if (p.materials.count(body->material) && p.materials.at(body->material).is_rigid())
        section.error("Probes",
                      "probe '" + probe.name + "': the body '" + probe.body + "' is rigid",
                      "its motion and load are in history.csv");
    }
}
} // namespace

template <int dim>
void
Parameters<dim>::declare(ParameterFile &file)
{
  ParameterSection root = file.root();
  root.entry("Title", title, "A title for logs and plots.");
  root.entry(
    "Units", units,
    "Names of the units of length, stress and force, as labels of pictures and in VTU files: "
    "mm, MPa, N.");
  check_units(units, root);
  output.fields.units = split_list(units, ',');

  ParameterSection grid_section = root.subsection("Grid", "The background grid.");
  grid.declare(grid_section);

  ParameterSection discretization_section
    = root.subsection("Discretization", "Basis and cut cells.");
  discretization.declare(discretization_section);
  materials = declare_materials(root);
  std::vector<std::string> body_names;

  ParameterSection body_section = root.subsection("Bodies", "The bodies.");
  bodies                        = declare_bodies<dim>(body_section, materials);
  for (const auto &body : bodies)
    body_names.push_back(body.name);
  const std::string clash = clashing_pairs(body_names);
  if (!clash.empty())
    body_section.error("Names", clash, "give one of the bodies another name");
  if (bodies.empty())
    body_section.error("Names", "there is no body", "set Names = ... and a subsection for each");

  ParameterSection contact_section = root.subsection("Contact", "Laws between the bodies.");
  contact.declare(contact_section, body_names);

  ParameterSection moving_section
    = root.subsection("Moving geometry", "Whether bodies move through the grid.");
  moving.declare(moving_section);

  ParameterSection time_section = root.subsection("Time", "Load steps.");
  time.declare(time_section);
  time_scheme.declare(time_section);
  ParameterSection stage_section
    = root.subsection("Stages", "Stages of loading, one after the other.");
  stages = declare_stages(stage_section, bodies, rigid_bodies(*this), contact);
  check_times(*this, time_section);
  check_resets(*this, stage_section);
  set_times(stages, StageRecord<dim>(), time);
  file.check_tables(time.end_time);

  ParameterSection solver_section = root.subsection("Solver", "How the equations are solved.");
  ParameterSection newton_section = solver_section.subsection("Newton", "Newton's method.");
  newton.declare(newton_section);
  ParameterSection linear_section = solver_section.subsection("Linear", "Linear systems.");
  linear_solver.declare(linear_section);

  ParameterSection output_section = root.subsection("Output", "What is written.");
  output.declare(output_section);
  check_probes(*this, output_section);

  ParameterSection study_section = root.subsection(
    "Refinement study", "The same problem on finer and finer grids, and how results converge.");
  study.declare(study_section, grid);
  check_combinations(*this, discretization_section, moving_section, output_section, study_section);
}

template struct OutputParameters<2>;
template struct OutputParameters<3>;
template struct Parameters<2>;
template struct Parameters<3>;
} // namespace scree
