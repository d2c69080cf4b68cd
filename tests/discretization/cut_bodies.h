#pragma once

#include <scree/bodies/broad_phase.h>
#include <scree/discretization/discretization_parameters.h>
#include <scree/discretization/displacement_space.h>
#include <scree/parameters/file.h>

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace scree
{
/** The sections of a parameter text that describe grid, materials and bodies. */
template <int dim>
struct BodiesInput
{
  GridParameters<dim>                       grid;
  DiscretizationParameters                  discretization;
  std::map<std::string, MaterialParameters> materials;
  std::vector<BodyParameters<dim>>          bodies;

  void declare(ParameterFile &file)
  {
    const ParameterSection root         = file.root();
    ParameterSection       grid_section = root.subsection("Grid", "");
    grid.declare(grid_section);
    ParameterSection discretization_section = root.subsection("Discretization", "");
    discretization.declare(discretization_section);
    materials                = declare_materials(root);
    ParameterSection section = root.subsection("Bodies", "");
    bodies                   = declare_bodies<dim>(section, materials);
  }

  static BodiesInput from_string(const std::string &text)
  {
    ParameterFile file = ParameterFile::from_string(text);
    BodiesInput   input;
    input.declare(file);
    file.check();
    return input;
  }
};

/** Bodies on their grid with their unknowns: what the tests of the modules start from. */
template <int dim>
struct CutBodies
{
  /** Largest level set on the contact surface, in finest cells. */
  static constexpr double shift = 4.;

  explicit CutBodies(const BodiesInput<dim> &input, const MPI_Comm communicator = MPI_COMM_WORLD)
      : grid(input.grid, communicator)
  {
    std::map<std::string, std::shared_ptr<const Material<dim>>> materials;
    for (const auto &[name, material] : input.materials)
      materials[name] = make_material<dim>(material);
    const DiscretizationParameters &settings = input.discretization;
    const double                    h        = grid.finest_size();
    const double                    coarsest
      = input.grid.refinement == GridRefinement::uniform
          ? h
          : input.grid.cell_size(std::min(input.grid.coarsest_level, input.grid.finest_level));
    bodies = make_bodies<dim>(input.bodies, materials,
                              {input.grid.lower, h / settings.degree_of_level_sets(), grid.box()},
                              std::max((shift + 2.) * h, 2. * coarsest));
    pairs  = BodyBoxes<dim>(bodies).pairs(2. * shift * h);
    grid.refine(bodies, pairs);
    level_set_nodes = std::make_unique<LevelSetNodes<dim>>(grid, settings.degree_of_level_sets(),
                                                           settings.gauss_points());
    unsigned int n_multipliers = 0;
    for (const auto &body : bodies)
      for (const auto &condition : body.conditions)
        n_multipliers += condition.n_multipliers();
    space = std::make_unique<DisplacementSpace<dim>>(grid, settings.degree, *level_set_nodes,
                                                     bodies, n_multipliers);
  }

  explicit CutBodies(const std::string &text)
      : CutBodies(BodiesInput<dim>::from_string(text))
  {
  }

  BackgroundGrid<dim>                                grid;
  std::vector<Body<dim>>                             bodies;
  std::vector<std::pair<unsigned int, unsigned int>> pairs;
  std::unique_ptr<LevelSetNodes<dim>>                level_set_nodes;
  std::unique_ptr<DisplacementSpace<dim>>            space;
};

/** Section Grid. */
inline std::string
grid_text(const std::string &lower, const std::string &upper, const std::string &cells,
          const unsigned int finest_level, const std::string &more = "")
{
  return "subsection Grid\n set Lower corner = " + lower + "\n set Upper corner = " + upper
         + "\n set Cells = " + cells + "\n set Finest level = " + std::to_string(finest_level)
         + "\n" + more + "\nend\n";
}

/** Lines for section Grid: finest around contact, coarser elsewhere. */
inline std::string
graded_text(const unsigned int coarsest_level, const std::string &more = "")
{
  return " set Refinement = contact\n set Coarsest level = " + std::to_string(coarsest_level)
         + "\n set Band = 2\n set Grading = 0.5\n" + more;
}

/** Section Discretization. */
inline std::string
degree_text(const unsigned int degree, const double ghost_penalty = 0.1)
{
  return "subsection Discretization\n set Degree = " + std::to_string(degree)
         + "\n set Ghost penalty = " + std::to_string(ghost_penalty) + "\nend\n";
}

/** Material and subsection Motion of a rigid body. */
inline std::string
motion_text(const std::string &lines)
{
  return "  set Material = rigid\n  subsection Motion\n" + lines + "\n  end\n";
}

/** Sections Materials (E = 1000, nu = 0.3; rigid) and Bodies, which are soft if they do not say. */
inline std::string
bodies_text(const std::vector<std::pair<std::string, std::string>> &bodies)
{
  std::string text = "subsection Materials\n set Names = soft, rigid\n subsection soft\n"
                     "  set Young's modulus = 1000\n  set Poisson's ratio = 0.3\n end\n"
                     " subsection rigid\n  set Law = rigid\n end\nend\n"
                     "subsection Bodies\n set Names = ";
  for (unsigned int i = 0; i < bodies.size(); ++i)
    text += (i > 0 ? ", " : "") + bodies[i].first;
  for (const auto &[name, content] : bodies)
    text += "\n subsection " + name + "\n"
            + (content.find("Material") == std::string::npos ? "  set Material = soft\n" : "")
            + content + "\n end";
  return text + "\nend\n";
}

/** Subsection Shape of a body. */
inline std::string
shape_text(const std::string &type, const std::string &entries)
{
  return "  subsection Shape\n   set Type = " + type + "\n" + entries + "\n  end\n";
}

inline std::string
ball_text(const std::string &centre, const double radius)
{
  return shape_text("ball", "set Centre = " + centre + "\nset Radius = " + std::to_string(radius));
}

inline std::string
half_space_text(const std::string &point, const std::string &normal)
{
  return shape_text("half space", "set Point = " + point + "\nset Normal = " + normal);
}

inline std::string
box_text(const std::string &lower, const std::string &upper)
{
  return shape_text("box", "set Lower corner = " + lower + "\nset Upper corner = " + upper);
}

/** Subsection Boundary conditions of a body: names and the lines of each. */
inline std::string
conditions_text(const std::vector<std::pair<std::string, std::string>> &conditions)
{
  std::string text = "  subsection Boundary conditions\n   set Names = ";
  for (unsigned int i = 0; i < conditions.size(); ++i)
    text += (i > 0 ? ", " : "") + conditions[i].first;
  for (const auto &[name, content] : conditions)
    text += "\n   subsection " + name + "\n" + content + "\n   end";
  return text + "\n  end\n";
}
} // namespace scree
