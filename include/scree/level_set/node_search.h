#pragma once

#include <scree/level_set/reboxing.h>

#include <cmath>
#include <optional>
#include <vector>

namespace scree
{
/**
 * Searches the nodes of a box by branch and bound: calls `is_promising(part, centre, radius)`,
 * first for the whole box and then for the halves (in every direction) of the parts for which it
 * returned true, down to single nodes. `centre` is a node of the part, and no node of it is farther
 * from the centre than `radius` spacings.
 */
template <int dim, typename Predicate>
void search_nodes(const NodeBox<dim> &part, const Predicate &is_promising);

/**
 * The bound of the slopes that the searches below expect. A distance has 1; one that a user
 * declares or that is marched on a lattice may have more at places.
 */
constexpr double slope_bound = 1.5;

/**
 * The smallest box around the nodes of `box` at which `phi`, a distance, is negative; nothing if
 * there are none.
 */
template <int dim>
std::optional<NodeBox<dim>>
box_of_negative_nodes(const LatticeFrame<dim> &frame, const NodeBox<dim> &box,
                      const std::function<double(const dealii::Point<dim> &)> &phi);

/** The smallest value of the nodes of a lattice, which is dense or a distance. */
template <int dim>
double smallest_value(const Lattice<dim> &lattice);

/** The nodes of such a lattice at which the value is less than `level`, x fastest. */
template <int dim>
std::vector<typename Lattice<dim>::Index> nodes_below(const Lattice<dim> &lattice, double level);

template <int dim, typename Predicate>
void
search_nodes(const NodeBox<dim> &part, const Predicate &is_promising)
{
  typename Lattice<dim>::Index centre;
  double                       square = 0.;
  bool                         single = true;
  for (unsigned int d = 0; d < dim; ++d)
    {
      const int before = part.n_nodes[d] / 2;
      centre[d]        = part.lower[d] + before;
      square += double(before) * before;
      single &= part.n_nodes[d] == 1;
    }
  if (!is_promising(part, centre, std::sqrt(square)) || single)
    return;
  for (unsigned int side = 0; side < 1u << dim; ++side)
    {
      NodeBox<dim> half     = part;
      bool         is_empty = false;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const int n_first = (part.n_nodes[d] + 1) / 2;
          if (side >> d & 1)
            {
              half.lower[d] += n_first;
              half.n_nodes[d] -= n_first;
            }
          else
            half.n_nodes[d] = n_first;
          is_empty |= half.n_nodes[d] == 0;
        }
      if (!is_empty)
        search_nodes(half, is_promising);
    }
}
} // namespace scree
