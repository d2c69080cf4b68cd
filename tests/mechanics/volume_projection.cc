// Projected volume changes: orthonormal modes, uniform stresses on cut cells at nu = 0.49999.
#include <gtest/gtest.h>

#include <scree/mechanics/volume_projection.h>

#include <deal.II/base/quadrature_lib.h>

#include <iostream>

#include "equilibrium_model.h"

namespace scree
{
namespace
{
using namespace dealii;

/** bodies_text() of nearly incompressible material. */
std::string
incompressible(const std::string &name, const std::string &body)
{
  std::string       text  = bodies_text({{name, body}});
  const std::string ratio = "Poisson's ratio = 0.3";
  return text.replace(text.find(ratio), ratio.size(), "Poisson's ratio = 0.49999");
}

/** Largest error of the sampled stress over the largest exact one after a field u = A x. */
template <int dim>
double
stress_error(const std::string &text, const Tensor<2, dim> &gradient)
{
  EquilibriumModel<dim> model(text + solver_text(1e-12));
  EXPECT_TRUE(model.step(1.).converged());
  const auto u       = model.equilibrium.at_points(model.state.displacement);
  const auto exact   = model.cut.bodies[0].material->stress(symmetrize(gradient));
  double     largest = 0.;
  const auto compare = [&](const unsigned int a, const Point<dim> &unit_point) {
    largest = std::max(largest, (model.bulk.sample(a, unit_point, u).stress - exact).norm());
  };
  for (unsigned int a = 0; a < model.cut.space->n_owned_cells(); ++a)
    if (model.cut.space->cells()[a].is_cut)
      for (unsigned int q = model.quadrature.bulk.begin[a]; q < model.quadrature.bulk.begin[a + 1];
           ++q)
        compare(a, model.quadrature.bulk.points[q]);
    else
      for (const auto &point : model.quadrature.whole_cell.points)
        compare(a, point);
  return largest / exact.norm();
}
} // namespace

TEST(VolumeModes, AreOrthonormalAndContainTheConstant)
{
  const QGauss<2>     gauss(3);
  std::vector<double> weights;
  // A part of a cell: uneven weights.
  for (unsigned int q = 0; q < gauss.size(); ++q)
    weights.push_back(1e-3 * gauss.weight(q) * (1. + gauss.point(q)[0]));
  for (const unsigned int degree : {0u, 1u})
    {
      const VolumeModes<2> psi(gauss.get_points().data(), weights.data(), gauss.size(), degree);
      ASSERT_EQ(psi.n, degree == 0 ? 1u : 3u);
      double constant = 0.; // the projection of 1 at a point
      for (unsigned int m = 0; m < psi.n; ++m)
        for (unsigned int p = 0; p <= m; ++p)
          {
            double product = 0., mean = 0.;
            for (unsigned int q = 0; q < gauss.size(); ++q)
              {
                const auto values = psi(gauss.point(q));
                product += weights[q] * values[m] * values[p];
                mean += weights[q] * values[m];
              }
            EXPECT_NEAR(product, m == p ? 1. : 0., 1e-13);
            if (m == p)
              constant += mean * psi(Point<2>(0.3, 0.9))[m];
          }
      EXPECT_NEAR(constant, 1., 1e-13);
    }
}

TEST(VolumeModes, ThinPartsHaveNoModeAcross)
{
  const QGauss<2>       gauss(3);
  std::vector<Point<2>> points;
  for (const auto &point : gauss.get_points())
    points.emplace_back(0.01 * point[0], point[1]);
  EXPECT_EQ(VolumeModes<2>(points.data(), gauss.get_weights().data(), points.size(), 1).n, 2u);
}

TEST(ProjectedVolume, AffineFieldsAreExactOnCutCells)
{
  // Straight surfaces, for which the quadrature is exact.
  const Tensor<2, 2> A({{0.01, 0.02}, {-0.005, -0.0099}});
  const std::string  field = "set Value = 0.01*x + 0.02*y; -0.005*x - 0.0099*y";
  for (const unsigned int degree : {1u, 2u})
    for (const std::string point : {"0.01, 0.2", "0.0123, 0.2499"})
      {
        const double error
          = stress_error<2>(grid_text("-1, -1", "1, 1", "4, 4", 1) + degree_text(degree)
                              + incompressible("body", half_space_text(point, "0.2, 0.9")
                                                         + conditions_text({
                                                           {"left", "set On = x-\n" + field},
                                                           {"right", "set On = x+\n" + field},
                                                           {"below", "set On = y-\n" + field},
                                                           {"above", "set On = surface\n" + field},
                                                         })),
                            A);
        std::cout << "degree " << degree << ": largest error of the stress " << error << std::endl;
        EXPECT_LT(error, 1e-7);
      }
}
} // namespace scree
