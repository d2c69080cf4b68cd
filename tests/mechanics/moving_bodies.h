#pragma once

#include <gtest/gtest.h>

#include <scree/level_set/closest_point.h>
#include <scree/mechanics/moving_level_sets.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "../discretization/cut_bodies.h"

namespace scree
{
/** A map x = X + f(X) of one step. */
template <int dim>
using Increment = std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &)>;

/** Bodies that are moved by exact increments at the nodes of their cells. */
template <int dim>
struct MovingBodies
{
  using Vector = dealii::TrilinosWrappers::MPI::Vector;

  explicit MovingBodies(const std::string &text, const MPI_Comm communicator = MPI_COMM_WORLD)
      : input(BodiesInput<dim>::from_string(text))
      , cut(input, communicator)
      , communicator(communicator)
  {
    const double h        = cut.grid.finest_size();
    const bool   uniform  = input.grid.refinement == GridRefinement::uniform;
    const double coarsest = uniform ? h : input.grid.cell_size(input.grid.coarsest_level);
    options.margin        = std::max((CutBodies<dim>::shift + 2.) * h, 2. * coarsest);
  }

  /** The increment as a vector with ghosts, hanging nodes distributed. */
  Vector nodal(const Increment<dim> &increment) const
  {
    const DisplacementSpace<dim> &space = *cut.space;
    Vector                        owned(space.owned(), communicator);
    for (unsigned int a = 0; a < space.n_owned_cells(); ++a)
      {
        const auto &cell = cut.grid.cells()[space.cells()[a].grid_cell];
        for (unsigned int i = 0; i < space.basis.n_nodes; ++i)
          {
            const dealii::Tensor<1, dim> value
              = increment(cell.lower + cell.size * dealii::Tensor<1, dim>(space.basis.node(i)));
            for (unsigned int d = 0; d < dim; ++d)
              if (space.owned().is_element(space.nodes(a)[i] + d))
                owned(space.nodes(a)[i] + d) = value[d];
          }
      }
    owned.compress(dealii::VectorOperation::insert);
    space.hanging_constraints().distribute(owned);
    Vector result(space.owned(), space.relevant(), communicator);
    result = owned;
    return result;
  }

  /** One step; the unknowns are built anew for the next. */
  BodyMotion<dim> step(const Increment<dim> &increment)
  {
    const Vector du = nodal(increment);
    // u = x - X is of no use to the other motions, and costs.
    const Vector u       = options.motion == IncrementMotion::reference_map
                             ? nodal([&](const dealii::Point<dim> &x) {
                           return dealii::Tensor<1, dim>(x - pulled_back(x));
                         })
                             : du;
    const auto   motions = move_level_sets(cut.bodies, *cut.space, du, u, options);
    cut.space = std::make_unique<DisplacementSpace<dim>>(cut.grid, cut.space->basis.degree,
                                                         *cut.level_set_nodes, cut.bodies, 0);
    EXPECT_EQ(motions.front().n_unconverged, 0u);
    EXPECT_EQ(motions.front().n_islands, 0u);
    steps.push_back(increment);
    return motions.front();
  }

  void run(const unsigned int n_steps, const Increment<dim> &increment)
  {
    for (unsigned int i = 0; i < n_steps; ++i)
      step(increment);
  }

  /** The position at the start of the point that all steps moved to x, by fixed points. */
  dealii::Point<dim> pulled_back(const dealii::Point<dim> &x) const
  {
    dealii::Point<dim> X = x;
    for (auto step = steps.rbegin(); step != steps.rend(); ++step)
      {
        const dealii::Point<dim> end    = X;
        double                   change = 1.;
        for (unsigned int i = 0; i < 100 && change > 1e-15; ++i)
          {
            const dealii::Point<dim> next = end - (*step)(X);
            change                        = next.distance(X);
            X                             = next;
          }
      }
    return X;
  }

  const Lattice<dim> &lattice() const
  {
    return cut.bodies.front().level_set;
  }

  /**
   * The largest distance of the contour of the cubic interpolant inside the grid from the exact
   * image of phi_0 = 0, measured at the start, in cells.
   */
  double contour_error(const std::function<double(const dealii::Point<dim> &)> &phi_0) const
  {
    double       largest = 0.;
    unsigned int n       = 0;
    for (std::size_t i = 0; i < lattice().values().size(); ++i)
      if (std::abs(lattice().values()[i]) < 1.1 * lattice().spacing())
        {
          const dealii::Point<dim> x
            = project(lattice(), lattice().node(lattice().index(i)), 3).point;
          if (!cut.grid.box().point_inside(x))
            continue;
          ++n;
          largest = std::max(largest, std::abs(phi_0(pulled_back(x))));
        }
    EXPECT_GT(n, 20u);
    return largest / cut.grid.finest_size();
  }

  /** The volume of the cubic interpolant inside the grid, by samples that straddle smoothly. */
  double volume() const
  {
    constexpr int             n = dim == 2 ? 10 : 4;
    const double              h = lattice().spacing(), edge = h / n;
    double                    sum = 0.;
    dealii::Point<dim>        centre_of_first;
    const auto                box = cut.grid.box();
    std::array<unsigned, dim> index{}, count;
    for (unsigned int d = 0; d < dim; ++d)
      count[d] = static_cast<unsigned int>(std::lround(box.side_length(d) / h));
    while (index[dim - 1] < count[dim - 1])
      {
        dealii::Point<dim> lower = box.get_boundary_points().first;
        dealii::Point<dim> centre;
        for (unsigned int d = 0; d < dim; ++d)
          {
            lower[d] += index[d] * h;
            centre[d] = lower[d] + 0.5 * h;
          }
        const double phi = lattice().value(centre, 1);
        if (std::abs(phi) > 2. * h)
          sum += phi < 0. ? std::pow(double(n), dim) : 0.;
        else
          for (int s = 0; s < dealii::Utilities::fixed_power<dim>(n); ++s)
            {
              dealii::Point<dim> x    = lower;
              int                rest = s;
              for (unsigned int d = 0; d < dim; ++d, rest /= n)
                x[d] += (rest % n + 0.5) * edge;
              sum += std::clamp(0.5 - lattice().value(x, 3) / edge, 0., 1.);
            }
        for (unsigned int d = 0; ++index[d] == count[d] && d + 1 < dim; ++d)
          index[d] = 0;
      }
    return sum * std::pow(edge, dim);
  }

  BodiesInput<dim>            input;
  CutBodies<dim>              cut;
  LevelSetMotion              options;
  MPI_Comm                    communicator;
  std::vector<Increment<dim>> steps;
};

/** The increment A (x - centre) + shift. */
template <int dim>
Increment<dim>
affine(const dealii::Tensor<2, dim> &A, const dealii::Point<dim> &centre,
       const dealii::Tensor<1, dim> &shift = dealii::Tensor<1, dim>())
{
  return [=](const dealii::Point<dim> &x) { return A * (x - centre) + shift; };
}

/** R - I for a rotation in the plane of the first two axes. */
template <int dim>
dealii::Tensor<2, dim>
turn(const double angle)
{
  dealii::Tensor<2, dim> result;
  result[0][0] = result[1][1] = std::cos(angle) - 1.;
  result[1][0]                = std::sin(angle);
  result[0][1]                = -result[1][0];
  return result;
}
} // namespace scree
