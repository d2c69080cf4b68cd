// PointEvaluator: values and gradients of displacements at points of cells.
#include <gtest/gtest.h>

#include <scree/discretization/point_evaluator.h>

#include <random>

#include "cut_bodies.h"

namespace scree
{
namespace
{
using namespace dealii;

/** A polynomial of the degree at all nodes, a field of the space also at hanging ones. */
template <int dim>
Tensor<1, dim>
polynomial(const Point<dim> &x, const unsigned int degree)
{
  Tensor<1, dim> u;
  for (unsigned int i = 0; i < dim; ++i)
    {
      u[i] = 0.1 * i + (degree == 2 ? 0.3 * x[0] * x[i] : 0.);
      for (unsigned int j = 0; j < dim; ++j)
        u[i] += (0.2 + i - 0.5 * j) * x[j];
    }
  return u;
}

template <int dim>
Tensor<2, dim>
gradient(const Point<dim> &x, const unsigned int degree)
{
  Tensor<2, dim> g;
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = 0; j < dim; ++j)
      g[i][j] = 0.2 + i - 0.5 * j + (degree == 2 ? 0.3 * (x[i] * (j == 0) + x[0] * (i == j)) : 0.);
  return g;
}

template <int dim>
typename PointEvaluator<dim>::Vector
interpolated(const DisplacementSpace<dim> &space)
{
  typename PointEvaluator<dim>::Vector u(space.owned(), space.relevant(), MPI_COMM_WORLD),
    owned(space.owned(), MPI_COMM_WORLD);
  for (unsigned int a = 0; a < space.cells().size(); ++a)
    for (unsigned int i = 0; i < space.basis.n_nodes; ++i)
      if (const DofIndex node = space.nodes(a)[i]; space.owned().is_element(node))
        {
          const auto value = polynomial(space.position(a, space.basis.node(i)), space.basis.degree);
          for (unsigned int d = 0; d < dim; ++d)
            owned(node + d) = value[d];
        }
  for (unsigned int i = 0; i < space.n_trailing(); ++i)
    if (const DofIndex index = space.n_dofs() - space.n_trailing() + i;
        space.owned().is_element(index))
      owned(index) = 7. + i;
  owned.compress(VectorOperation::insert);
  u = owned;
  return u;
}

template <int dim>
void
check(const CutBodies<dim> &model)
{
  const DisplacementSpace<dim>          &space  = *model.space;
  const unsigned int                     degree = space.basis.degree;
  const PointEvaluator<dim>              u(space, interpolated(space));
  std::mt19937                           engine(3);
  std::uniform_real_distribution<double> number(0., 1.);
  ShapeValues<dim>                       shape;
  for (unsigned int a = 0; a < space.cells().size(); ++a)
    {
      PointInCell<dim> point{a, {}};
      for (unsigned int d = 0; d < dim; ++d)
        point.unit_point[d] = number(engine);
      const Point<dim> x    = space.position(a, point.unit_point);
      const auto       here = u.evaluate(point);
      EXPECT_LE((here.value - polynomial(x, degree)).norm(), 1e-13);
      EXPECT_LE((here.gradient - gradient(x, degree)).norm(), 1e-12);
      EXPECT_LE((u.value(point) - here.value).norm(), 1e-14);
      EXPECT_EQ(u.gradient(point), here.gradient);
      space.basis.evaluate_gradients(point.unit_point, shape);
      EXPECT_LE((u.gradient(a, &shape.gradient[0][0]) - here.gradient).norm(), 1e-13);
    }
  for (unsigned int i = 0; i < space.n_trailing(); ++i)
    EXPECT_EQ(u.trailing_value(space.n_dofs() - space.n_trailing() + i), 7. + i);
  EXPECT_FALSE(PointEvaluator<dim>(space) == u);
  EXPECT_TRUE(u == u);
}

std::string
disc(const unsigned int degree)
{
  const std::string mean
    = "  subsection Boundary conditions\n   set Names = mean\n   subsection mean\n"
      "    set Type = mean support\n    set Components = x, y, rotation\n   end\n  end\n";
  return grid_text("-1, -1", "1, 1", "4, 4", 3, graded_text(1)) + degree_text(degree)
         + bodies_text({{"disc", ball_text("0.1, 0.01", 0.6) + mean}});
}

void
check_discs()
{
  for (const unsigned int degree : {1u, 2u})
    check(CutBodies<2>(disc(degree)));
}
} // namespace

TEST(PointEvaluator, PolynomialsOfTheDegree)
{
  check_discs();
  check(CutBodies<3>(grid_text("-1, -1, -1", "1, 1, 1", "2, 2, 2", 2) + degree_text(2)
                     + bodies_text({{"ball", ball_text("0.1, 0.01, 0", 0.7)}})));
}

TEST(PointEvaluatorMPI, PolynomialsOfTheDegree)
{
  check_discs();
}
} // namespace scree
