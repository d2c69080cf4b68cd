#pragma once

#include <scree/contact/contact_surface.h>

#include <array>
#include <vector>

namespace scree
{
/**
 * Tractions on contact surfaces, continuous and multilinear on the cubes of a lattice as fine as
 * the cells of the points: lambda = sum_i N_i Lambda_i, Lambda_i [force/area] at the nodes near the
 * surface. Each pair has its own, and so has each of the 2 dim directions along which normals
 * point most: faces that meet at an edge do not share nodes.
 *
 * Its space has about as many functions as displacements have jumps on the surface. One multiplier
 * at each quadrature point would be too many: pressures would oscillate from point to point.
 * Points that are nodes of the grid have one Lambda each.
 */
template <int dim>
class MultiplierField
{
public:
  using Value = dealii::Tensor<1, dim>;

  static constexpr double smallest_part = 0.05;

  /** Of these points (collective). */
  MultiplierField(const std::vector<ContactPoint<dim>> &points, const MPI_Comm communicator);

  /** lambda = 0. */
  void clear();

  /** lambda at a point. */
  Value operator()(const unsigned int point) const;

  /**
   * Adds the field that fits values at closed points best: the least int |lambda - v|^2, by
   * conjugate gradients, to 1e-10 (what they leave at slivers of the surface would come and go from
   * update to update), without what the points do not see. Nodes without closed points become
   * zero. Collective.
   */
  void add_fit(const std::vector<Value> &values, const std::vector<bool> &closed);

  /**
   * The largest mean of a node, |int N_i v| / int N_i over the closed points, of nodes near at
   * least `smallest_part` of the face of a cell: what is less is moved by multipliers only slowly,
   * and carries nothing. 0 if there are none. Collective.
   */
  double largest_mean(const std::vector<Value> &values, const std::vector<bool> &closed) const;

private:
  static constexpr unsigned int n_corners = 1u << dim;

  /** N_i at a point. */
  struct Support
  {
    std::array<unsigned int, n_corners> nodes;
    std::array<double, n_corners>       values{};
  };

  Value at(const std::vector<Value> &nodal, const Support &support) const;
  /** int N_i v over closed points, of all nodes and processes. */
  std::vector<Value> moments(const std::vector<Value> &values,
                             const std::vector<bool>  &closed) const;
  /** Of each node the sum of of_point(number, N_i) over closed points and all processes. */
  template <typename Function>
  std::vector<double> sums(const std::vector<bool> &closed, const Function &of_point) const;

  const MPI_Comm       communicator;
  std::vector<Support> supports; //!< of the points
  /** Of the points, over the area of the face of their cells, of which those of a node are alike.
   */
  std::vector<double> weights;
  std::vector<Value>  nodal; //!< Lambda_i
};
} // namespace scree
