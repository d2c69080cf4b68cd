#pragma once

#include <scree/contact/contact_points.h>
#include <scree/contact/level_set_surface.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "../discretization/cut_bodies.h"

namespace scree
{
/** The pairs of a model, the same law for all of them. */
template <int dim>
std::vector<ContactPair>
pairs_with(const CutBodies<dim> &model, const std::string &law)
{
  std::vector<ContactPair> pairs;
  for (const auto &[a, b] : model.pairs)
    {
      ContactPairParameters parameters;
      parameters.kind = &contact_law(law);
      pairs.push_back({a, b, model.bodies[a].name + "-" + model.bodies[b].name, parameters});
    }
  return pairs;
}

/** The contact points of a model, the same law for all pairs. */
template <int dim>
ContactPoints<dim>
contact_points(const CutBodies<dim> &model, const std::string &law = "frictionless",
               const IncrementPrediction<dim> &prediction = {})
{
  const std::vector<ContactPair> pairs = pairs_with(model, law);
  return ContactPoints<dim>(
    model.bodies, pairs,
    level_set_surface(*model.space, *model.level_set_nodes, model.bodies, pairs,
                      CutBodies<dim>::shift * model.grid.finest_size(), prediction));
}

/** u with values body by body, ghosted wherever the stencils reach. */
template <int dim>
dealii::TrilinosWrappers::MPI::Vector
displacement(const CutBodies<dim> &model, const ContactPoints<dim> &contact,
             const std::function<dealii::Tensor<1, dim>(const unsigned int,
                                                        const dealii::Point<dim> &)> &value)
{
  const DisplacementSpace<dim>         &space = *model.space;
  dealii::TrilinosWrappers::MPI::Vector owned(space.owned(), model.grid.communicator());
  for (unsigned int a = 0; a < space.cells().size(); ++a)
    {
      const auto &cell = model.grid.cells()[space.cells()[a].grid_cell];
      for (unsigned int i = 0; i < space.basis.n_nodes; ++i)
        for (unsigned int d = 0; d < dim; ++d)
          if (space.owned().is_element(space.nodes(a)[i] + d))
            owned(space.nodes(a)[i] + d)
              = value(space.cells()[a].body,
                      cell.lower + cell.size * dealii::Tensor<1, dim>(space.basis.node(i)))[d];
    }
  owned.compress(dealii::VectorOperation::insert);
  dealii::IndexSet relevant = space.relevant();
  const auto       unknowns = contact.jump_operator().all_unknowns();
  relevant.add_indices(unknowns.begin(), unknowns.end());
  relevant.compress();
  dealii::TrilinosWrappers::MPI::Vector result(space.owned(), relevant, model.grid.communicator());
  result = owned;
  return result;
}

/** Two half spaces with a plane gap, turned by an angle whose tangent is `slope`. */
inline std::string
two_half_planes(const double slope, const double gap, const unsigned int degree,
                const std::string &refinement = "")
{
  const auto   number = [](const double x) { return std::to_string(x); };
  const double norm   = std::sqrt(1. + slope * slope);
  return grid_text("-1, -1", "1, 1", "4, 4", 3, refinement) + degree_text(degree)
         + bodies_text({{"lower", half_space_text("0, 0.013", number(-slope) + ", 1")},
                        {"upper", half_space_text("0, " + number(0.013 + gap * norm),
                                                  number(slope) + ", -1")}});
}
} // namespace scree
