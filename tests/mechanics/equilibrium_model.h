#pragma once

#include <scree/contact/grid_node_contact.h>
#include <scree/contact/level_set_surface.h>
#include <scree/mechanics/equilibrium.h>
#include <scree/mechanics/linear_prediction.h>
#include <scree/mechanics/total_kinematics.h>
#include <scree/solver/linear_solver.h>
#include <scree/solver/newton.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "../discretization/cut_bodies.h"

namespace scree
{
/** The sections of a parameter text without time and output. */
template <int dim>
struct EquilibriumInput
{
  explicit EquilibriumInput(const std::string &text)
  {
    ParameterFile file = ParameterFile::from_string(text);
    bodies.declare(file);
    std::vector<std::string> names;
    for (const auto &body : bodies.bodies)
      names.push_back(body.name);
    ParameterSection section = file.root().subsection("Contact", "");
    contact.declare(section, names);
    const ParameterSection solver         = file.root().subsection("Solver", "");
    ParameterSection       newton_section = solver.subsection("Newton", "");
    newton.declare(newton_section);
    ParameterSection linear_section = solver.subsection("Linear", "");
    linear.declare(linear_section);
    file.check();
  }

  BodiesInput<dim>       bodies;
  ContactParameters      contact;
  NewtonParameters       newton;
  LinearSolverParameters linear;
};

/** The modules from the grid to the equilibrium, and load steps, without output. */
template <int dim>
struct EquilibriumModel
{
  using Vector = dealii::TrilinosWrappers::MPI::Vector;

  explicit EquilibriumModel(const std::string &text, const MPI_Comm communicator = MPI_COMM_WORLD,
                            const bool has_inertia = false)
      : input(text)
      , cut(input.bodies, communicator)
      , quadrature(*cut.space, *cut.level_set_nodes, cut.bodies)
      , small_cuts(make_small_cut_treatment(*cut.space, input.bodies.discretization.ghost_penalty))
      , kinematics(*cut.space, quadrature, cut.bodies, *small_cuts)
      , bulk(kinematics.bulk())
      , boundary_terms(*cut.space, *cut.level_set_nodes, quadrature, cut.bodies, kinematics)
      , contact(cut.bodies, contact_pairs(),
                input.contact.grid_nodes.is_chosen
                  ? grid_node_contact(*cut.space, *cut.level_set_nodes, cut.bodies, contact_pairs(),
                                      input.contact.grid_nodes)
                  : level_set_surface(*cut.space, *cut.level_set_nodes, cut.bodies, contact_pairs(),
                                      input.contact.shift * cut.grid.finest_size()))
      , mass(!has_inertia ? nullptr
                          : std::make_shared<const Mass<dim>>(*cut.space, cut.bodies, *small_cuts,
                                                              kinematics.mass_points()))
      , equilibrium(*cut.space, cut.bodies, kinematics, boundary_terms, contact, mass)
      , linear_solver(input.linear, dim, cut.space->basis.degree)
  {
    state.displacement = zero_displacement(*cut.space);
    state.contact      = contact.initial_history();
    linear_solver.set_near_null_space(equilibrium.rigid_motions());
    linear_solver.set_border(cut.space->n_trailing());
  }

  std::vector<ContactPair> contact_pairs() const
  {
    std::vector<ContactPair> pairs;
    for (const auto &[a, b] : cut.pairs)
      {
        const auto law = input.contact.law_of(cut.bodies[a].name, cut.bodies[b].name);
        if (law.kind->acts)
          pairs.push_back({a, b, cut.bodies[a].name + "-" + cut.bodies[b].name, law});
      }
    return pairs;
  }

  /** One load step to `time`; the state is taken over if it converged. */
  NewtonResult step(const double time)
  {
    Newton::Hooks hooks;
    hooks.residual = [&](const Vector &u, Vector &r) { equilibrium.residual(u, state.contact, r); };
    hooks.solve    = [&](const Vector &, const Vector &r, double, Vector &du) {
      linear_iterations
        = linear_solver.solve(equilibrium.tangent(), du, r, equilibrium.is_symmetric()).iterations;
      equilibrium.shorten(du, cut.grid.finest_size());
    };
    hooks.reference = [&]() {
      return std::max(equilibrium.force_scale(),
                      equilibrium.round_off() / input.newton.relative_tolerance);
    };
    Vector u = state.displacement;
    equilibrium.set_time(time, u);
    if (state.time > 0. && cut.space->n_trailing() > 0)
      u = linear_prediction<dim>(
        equilibrium, state.contact, state.displacement, u,
        [&](const Vector &b, Vector &x) { hooks.solve(b, b, input.linear.tolerance, x); });
    const NewtonResult result = Newton(input.newton, hooks).solve(u);
    if (result.converged())
      {
        equilibrium.accept(u, state.contact);
        state.displacement = u;
        state.contact      = contact.current_history();
        state.time         = time;
      }
    return result;
  }

  /** sqrt(int |u - exact|^2) over the bodies, and sqrt(int |exact|^2). */
  std::pair<double, double> l2_error(const Expression<dim> &exact)
  {
    const auto u     = equilibrium.at_points(state.displacement);
    double     error = 0., norm = 0.;
    for (unsigned int a = 0; a < cut.space->n_owned_cells(); ++a)
      {
        const auto &active = cut.space->cells()[a];
        const auto &cell   = cut.grid.cells()[active.grid_cell];
        const auto  add    = [&](const dealii::Point<dim> &unit, const double weight) {
          const auto value
            = exact.vector(cell.lower + cell.size * dealii::Tensor<1, dim>(unit), state.time);
          error += weight * (bulk.sample(a, unit, u).displacement - value).norm_square();
          norm += weight * value.norm_square();
        };
        if (active.is_cut)
          for (unsigned int q = quadrature.bulk.begin[a]; q < quadrature.bulk.begin[a + 1]; ++q)
            add(quadrature.bulk.points[q], quadrature.bulk.weights[q]);
        else
          for (unsigned int q = 0; q < quadrature.whole_cell.points.size(); ++q)
            add(quadrature.whole_cell.points[q],
                quadrature.whole_cell.weights[q] * std::pow(cell.size, dim));
      }
    const MPI_Comm communicator = cut.grid.communicator();
    return {std::sqrt(dealii::Utilities::MPI::sum(error, communicator)),
            std::sqrt(dealii::Utilities::MPI::sum(norm, communicator))};
  }

  EquilibriumInput<dim>                         input;
  CutBodies<dim>                                cut;
  CutQuadrature<dim>                            quadrature;
  std::unique_ptr<const SmallCutTreatment<dim>> small_cuts;
  TotalKinematics<dim>                          kinematics;
  const Bulk<dim>                              &bulk;
  BoundaryTerms<dim>                            boundary_terms;
  ContactPoints<dim>                            contact;
  std::shared_ptr<const Mass<dim>>              mass; //!< null without inertia
  Equilibrium<dim>                              equilibrium;
  LinearSolver                                  linear_solver;
  State<dim>                                    state;
  unsigned int                                  linear_iterations = 0; //!< of the last system
};

/** Section Contact with one law for all pairs. */
inline std::string
contact_text(const std::string &law, const std::string &surface = "level sets")
{
  return "subsection Contact\n set Surface = " + surface + "\n set Names = all\n subsection all\n  "
         + law + "\n end\nend\n";
}

/** Section Solver. */
inline std::string
solver_text(const double relative_tolerance, const std::string &linear_type = "direct")
{
  std::ostringstream text;
  text << "subsection Solver\n subsection Newton\n  set Relative tolerance = " << relative_tolerance
       << "\n end\n subsection Linear\n  set Type = " << linear_type << "\n end\nend\n";
  return text.str();
}
} // namespace scree
