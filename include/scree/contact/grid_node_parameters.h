#pragma once

#include <scree/base/enum_names.h>
#include <scree/parameters/section.h>

namespace scree
{
/** What makes the normals of contact at grid nodes. */
enum class NodeNormal
{
  facing_surfaces,
  volume_gradient,
  mass_gradient
};

/** Contact at the nodes of the grid, if that is chosen instead of a surface between the bodies. */
struct GridNodeParameters
{
  bool       is_chosen = false;
  NodeNormal normal    = NodeNormal::facing_surfaces;
  /** Else bodies are in contact wherever both reach a node and approach each other. */
  bool has_gaps = true;

  /** Bodies share nodes wherever the gap between them is smaller than this [L]. */
  static double reach(const double cell_size)
  {
    return cell_size;
  }

  void declare(ParameterSection &section);
};
} // namespace scree
