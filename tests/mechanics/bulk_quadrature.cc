// The bulk of a step in increments on points of another kind.
#include <gtest/gtest.h>

#include <scree/mechanics/material_point_quadrature.h>

#include <cmath>

#include "started_step.h"

namespace scree
{
namespace
{
using namespace dealii;

/** Each point of the cut cells twice, with half the weight. */
class DoublePoints : public BulkQuadrature<2>
{
public:
  DoublePoints(const StartedStep<2> &step)
      : BulkQuadrature<2>(*step.cut.space, step.cut.bodies)
      , start(step.start)
  {
    const CutCellGauss<2> gauss(*step.cut.space, step.quadrature, step.cut.bodies, step.start);
    for (unsigned int a = 0; a < step.cut.space->n_owned_cells(); ++a)
      {
        const CellRule<2> cell = gauss.rule(a);
        begin.push_back(points.size());
        for (unsigned int q = 0; q < 2 * cell.n_points; ++q)
          {
            points.push_back(cell.points[q / 2]);
            weights.push_back(0.5 * cell.weights[q / 2] * cell.weight_scale);
          }
      }
    begin.push_back(points.size());
    tabulate();
  }

  CellRule<2> rule(const unsigned int a) const override
  {
    return {&points[begin[a]], &weights[begin[a]], begin[a + 1] - begin[a], 1.};
  }
  std::vector<PointHistory<2>> histories(const std::vector<PointInCell<2>> &places) const override
  {
    return start.histories(places);
  }
  MaterialPoints<2> moved(const MaterialPoints<2> &before, const IncrementalBulk<2> &,
                          const PointEvaluator<2> &) const override
  {
    return before;
  }

private:
  const StepStart<2>       &start;
  std::vector<unsigned int> begin;
  std::vector<Point<2>>     points;
  std::vector<double>       weights;
};

Tensor<1, 2>
wavy(const Point<2> &x)
{
  return Tensor<1, 2>({0.05 * std::sin(2. * x[1]) + 0.1 * x[0], 0.04 * x[0] * x[1]});
}
} // namespace

TEST(BulkQuadrature, PointsMayBeOfAnotherKind)
{
  const std::string text
    = grid_text("-1.1, -1.1", "1.1, 1.1", "1, 1", 3) + degree_text(2)
      + bodies_text({{"disc", ball_text("0.01, 0.02", 0.9) + "set Body force = 1; -x\n"}});
  for (const std::string law : {"Hencky", "J2"})
    {
      const StartedStep<2>        step(text, law, wavy, law == "J2" ? 0.01 : 0.);
      const DisplacementSpace<2> &space = *step.cut.space;
      const DoublePoints          points(step);
      const IncrementalBulk<2>    bulk(space, step.quadrature, step.cut.bodies, *step.small_cuts,
                                       points, step.start.displacement_field());
      const auto                  u        = step.equilibrium.at_points(step.random(0.003, 1));
      auto                        expected = zero_displacement(space), found = expected;
      const auto                  compare = [&](const double tolerance) {
        for (auto *vector : {&expected, &found})
          vector->compress(VectorOperation::add);
        EXPECT_GT(expected.l2_norm(), 0.);
        found -= expected;
        EXPECT_LT(found.l2_norm(), tolerance * expected.l2_norm());
        expected = found = 0.;
      };
      step.bulk.add_internal_forces(u, expected);
      bulk.add_internal_forces(u, found);
      compare(1e-10);
      step.bulk.add_body_forces(expected, 1.);
      bulk.add_body_forces(found, 1.);
      compare(1e-12);
      const double energy = step.bulk.work(u).energy;
      EXPECT_NEAR(bulk.work(u).energy, energy, 1e-12 * energy);
      EXPECT_NEAR(bulk.volumes()[0], step.bulk.volumes()[0], 1e-14);
    }
}

// sum_p V_p f(x_p), each point with the F that it carries; forces are the derivative of the energy.
TEST(BulkQuadrature, MaterialPointsAreAskedWithWhatTheyCarry)
{
  StartedStep<2>     step(grid_text("-1.1, -1.1", "1.1, 1.1", "1, 1", 3) + degree_text(1)
                            + bodies_text({{"disc", ball_text("0.01, 0.02", 0.9)}}),
                          "Hencky", wavy);
  const Tensor<2, 2> F_n({{1.1, 0.1}, {-0.05, 0.9}}), F_D({{1.02, 0.03}, {0.01, 0.99}});
  for (auto &F : step.points.deformation_gradient)
    F = F_n;
  const DisplacementSpace<2>      &space = *step.cut.space;
  const MaterialPointQuadrature<2> points(space, step.cut.bodies, step.start);
  const IncrementalBulk<2> bulk(space, step.quadrature, step.cut.bodies, *step.small_cuts, points,
                                step.start.displacement_field());
  EXPECT_EQ(points.n_points(), step.points.size());

  auto u = zero_displacement(space);
  for (unsigned int a = 0; a < space.cells().size(); ++a)
    for (unsigned int i = 0; i < space.basis.n_nodes; ++i)
      {
        const Tensor<1, 2> x       = space.position(a, space.basis.node(i));
        const Tensor<1, 2> nodal_u = F_D * x - x;
        for (unsigned int d = 0; d < 2; ++d)
          u(space.nodes(a)[i] + d) = nodal_u[d];
      }
  u.compress(VectorOperation::insert);
  double volume = 0., volume_0 = 0.;
  for (unsigned int a = 0; a < space.n_owned_cells(); ++a)
    for (unsigned int q = 0; q < points.rule(a).n_points; ++q)
      volume += points.rule(a).weights[q];
  for (const double v : step.points.initial_volume)
    volume_0 += v;
  EXPECT_NEAR(volume, determinant(F_n) * volume_0, 1e-13);

  PointHistory<2> history;
  history.deformation_gradient = F_n;
  const auto          &law     = *step.cut.bodies[0].law;
  const IncrementStart start   = law.start(history);
  IncrementResponse<2> response;
  law.respond(ArrayView<const Tensor<2, 2>>(&F_D, 1), ArrayView<const IncrementStart>(&start, 1),
              ArrayView<IncrementResponse<2>>(&response, 1), {});
  const double energy = bulk.work(step.equilibrium.at_points(u)).energy;
  EXPECT_NEAR(energy, volume_0 * response.energy, 1e-12 * energy);

  const auto   du   = step.random(1., 3);
  const double size = 1e-6;
  double       ends[2];
  for (const int sign : {-1, 1})
    {
      auto there = u;
      there.add(sign * size, du);
      ends[(sign + 1) / 2] = bulk.work(step.equilibrium.at_points(there)).energy;
    }
  auto forces = zero_displacement(space);
  bulk.add_internal_forces(step.equilibrium.at_points(u), forces);
  forces.compress(VectorOperation::add);
  const double work = forces * du;
  EXPECT_NEAR((ends[1] - ends[0]) / (2. * size), work, 1e-7 * std::abs(work));
}
} // namespace scree
