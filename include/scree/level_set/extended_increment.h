#pragma once

#include <scree/level_set/advection.h>

#include <boost/serialization/array.hpp>
#include <boost/serialization/vector.hpp>
#include <vector>

namespace scree
{
/**
 * Vectors of a body at the nodes of a lattice, as they are when it is made: a displacement or its
 * increment, finite element values in the body's cells, continued linearly off them.
 */
template <int dim>
class ExtendedIncrement
{
public:
  ExtendedIncrement() = default;

  ExtendedIncrement(const Lattice<dim> &lattice, NodalVectors<dim> &&values);

  bool is_empty() const
  {
    return nodal[0].empty();
  }

  /** Whether there are values below `limit` [L] for all nodes: of what comes from a file there need
   * not be. */
  bool is_whole(const double limit) const;

  /** The multilinear interpolant [L], at points outside the lattice the value of the nearest. */
  dealii::Tensor<1, dim> operator()(const dealii::Point<dim> &x) const;

  /** At the nodes, x fastest. */
  const NodalVectors<dim> &values() const
  {
    return nodal;
  }

  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &first &spacing &n_nodes &nodal;
  }

private:
  dealii::Point<dim>           first; // position of the first node
  double                       spacing = 0.;
  typename Lattice<dim>::Index n_nodes = {};
  NodalVectors<dim>            nodal;
};
} // namespace scree
