// The bulk of a step in increments on points of another kind.
#include <gtest/gtest.h>

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
} // namespace scree
