#include <scree/contact/grid_node_parameters.h>

namespace scree
{
namespace
{
const EnumNames<NodeNormal> node_normal_names = {{NodeNormal::facing_surfaces, "facing surfaces"},
                                                 {NodeNormal::volume_gradient, "volume gradient"},
                                                 {NodeNormal::mass_gradient, "mass gradient"}};
} // namespace

void
GridNodeParameters::declare(ParameterSection &section)
{
  const std::string surfaces = "level sets", nodes = "grid nodes";
  is_chosen = section.choice("Surface", is_chosen ? nodes : surfaces, {surfaces, nodes},
                             "Where contact is evaluated. level sets: on the surface between the "
                             "bodies; grid nodes: at nodes that both bodies reach, as in the "
                             "material point method, of degree 1.")
              == nodes;
  ParameterSection own
    = section.subsection("Grid nodes", "Contact at grid nodes (theory.md section 8).");
  own.entry("Normal", normal, node_normal_names,
            "facing surfaces: from the surfaces of both bodies near a node as far as they face the "
            "other one; volume gradient: from the gradients of the nodal volumes, as in the "
            "material point method, which lean at edges; mass gradient: from those of the nodal "
            "masses, which need Density.");
  const std::string none = "none";
  has_gaps = own.choice("Early contact test", has_gaps ? surfaces : none, {surfaces, none},
                        "level sets: bodies touch where their distances to a node add up to zero; "
                        "none: as soon as both reach the node and approach each other.")
             == surfaces;
  for (const std::string key : {"Normal", "Early contact test"})
    if (!is_chosen && own.is_set(key))
      own.error(key, "contact is not evaluated at grid nodes",
                "remove it, or set Contact/Surface = grid nodes");
}
} // namespace scree
