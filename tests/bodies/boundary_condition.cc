// What a boundary condition says, and what is wrong with it.
#include <gtest/gtest.h>

#include <scree/base/exceptions.h>
#include <scree/bodies/boundary_condition.h>
#include <scree/parameters/file.h>

#include <functional>

namespace scree
{
namespace
{
using namespace dealii;

template <int dim>
BoundaryCondition<dim>
condition(const std::string &text)
{
  ParameterFile                    file    = ParameterFile::from_string(text);
  ParameterSection                 section = file.root();
  BoundaryConditionParameters<dim> parameters;
  parameters.declare(section);
  file.check();
  return BoundaryCondition<dim>("top", "Bodies/disc/Boundary conditions/top", parameters);
}

std::string
message(const std::function<void()> &action)
{
  try
    {
      action();
    }
  catch (const UserError &error)
    {
      return error.what();
    }
  return "";
}

void
expect_refused(const std::string &text, const std::string &part)
{
  const std::string told = message([&]() { condition<2>(text); });
  EXPECT_NE(told.find(part), std::string::npos) << "'" << part << "' is not in:\n" << told;
}

TEST(BoundaryCondition, ValuesOfComponents)
{
  const auto c = condition<3>("set On = z+\nset Components = z, x\nset Value = 2*t*x; y - z");
  EXPECT_EQ(c.components, (std::vector<unsigned int>{2, 0}));
  EXPECT_EQ(c.box_face, 5u);
  EXPECT_TRUE(c.is_strong());
  const Point<3> point(1., 2., 5.);
  EXPECT_EQ(c.value(0, point, 3.), 6.);
  const Tensor<1, 3> vector = c.vector(point, 3.);
  EXPECT_EQ(vector[0], -3.);
  EXPECT_EQ(vector[1], 0.);
  EXPECT_EQ(vector[2], 6.);
}

TEST(BoundaryCondition, Defaults)
{
  const auto c = condition<2>("");
  EXPECT_EQ(c.box_face, BoundaryCondition<2>::no_face);
  EXPECT_EQ(c.components, (std::vector<unsigned int>{0, 1}));
  EXPECT_FALSE(c.is_strong());
  EXPECT_EQ(c.vector(Point<2>(1., 1.), 1.).norm(), 0.);
  EXPECT_TRUE(c.selects(Point<2>(1., 1.)));
}

TEST(BoundaryCondition, RegionsAndRotations)
{
  const auto c = condition<2>("set Type = mean support\nset Where = x > 1 && y < 0\n"
                              "set Components = y, rotation\nset Value = 1; 2");
  EXPECT_EQ(c.components, (std::vector<unsigned int>{1, BoundaryCondition<2>::rotation}));
  EXPECT_TRUE(c.selects(Point<2>(1.5, -0.5)));
  EXPECT_FALSE(c.selects(Point<2>(1.5, 0.5)));
  EXPECT_FALSE(condition<2>("set On = x-\nset Method = nitsche").is_strong());
}

TEST(BoundaryCondition, WrongEntriesAreExplained)
{
  expect_refused("set Components = x, x", "'x' is listed twice");
  expect_refused("set Components = z\nset Value = 1", "'z' is no component here");
  expect_refused("set Value = 1", "has 1 component(s)");
  expect_refused("set Type = springs", "needs a value");
  expect_refused("set Type = pressure\nset Value = 1\nset Components = x", "does not use it");
  expect_refused("set Type = traction\nset Value = 1; 2\nset Method = penalty", "does not use it");
  expect_refused("set Type = traction\nset Value = 1; 2\nset Penalty factor = 3",
                 "does not use it");
  expect_refused("set Point = 1, 2", "does not use it");
  expect_refused("set Type = point support\nset On = x-", "does not use it");
  expect_refused("set Type = point support\nset Where = x > 0", "does not use it");
  expect_refused("set Penalty factor = 0", "without a penalty");
  EXPECT_EQ(
    message([]() { condition<2>("set Method = nonsymmetric nitsche\nset Penalty factor = 0"); }),
    "");
}

TEST(BoundaryCondition, KindsAnswerForThemselves)
{
  const auto spring = condition<2>("set Type = springs\nset Value = 1; 2");
  const auto load   = condition<2>("set Type = traction\nset Value = 1; 2");
  const auto mean   = condition<2>("set Type = mean support\nset Components = x, rotation");
  const auto point  = condition<2>("set Type = point support\nset Point = 1, 2");
  const auto held   = condition<2>("set On = x-");
  for (const auto &c : {spring, mean, point, held})
    EXPECT_TRUE(c.resists_motion()) << c.parameters.type;
  EXPECT_FALSE(load.resists_motion());
  EXPECT_EQ(mean.n_multipliers(), 2u);
  EXPECT_EQ(held.n_multipliers(), 0u);
  EXPECT_TRUE(point.is_at_vertex());
  EXPECT_TRUE(held.prescribes_displacement());
  EXPECT_FALSE(point.prescribes_displacement());
}

namespace
{
// t, dt/du, dt/dF and the energy of a kind at a point.
template <int dim>
SurfaceTraction<dim>
traction_at(const BoundaryCondition<dim> &c, const Tensor<1, dim> &u, const Tensor<2, dim> &F)
{
  Point<dim>     X;
  Tensor<1, dim> normal;
  for (unsigned int d = 0; d < dim; ++d)
    {
      X[d]      = 0.3 + 0.2 * d;
      normal[d] = 1. + d;
    }
  const SurfacePoint<dim> point = {X, normal / normal.norm(), 1.1, u, F};
  SurfaceTraction<dim>    result;
  c.kind().law.evaluate(c, ArrayView<const SurfacePoint<dim>>(&point, 1), 0.5,
                        ArrayView<SurfaceTraction<dim>>(&result, 1));
  return result;
}

// The derivatives are those by differences, and what a kind stores is the work against it.
template <int dim>
void
check_derivatives(const ConditionKind<dim> &kind)
{
  const std::string one   = "(2 + x*y + t)";
  std::string       value = one;
  for (unsigned int d = 1; d < dim && kind.uses("Components"); ++d)
    value += "; " + one;
  const auto     c = condition<dim>("set Type = " + kind.name + "\nset Value = " + value);
  Tensor<1, dim> u;
  Tensor<2, dim> F = unit_symmetric_tensor<dim>();
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = 0; j < dim; ++j)
      {
        u[i] = 0.1 * (i + 1);
        F[i][j] += 0.1 * i - 0.07 * j + 0.02;
      }
  const double step = 1e-6, tolerance = 1e-8;
  const auto   here         = traction_at(c, u, F);
  bool         depends_on_u = false, depends_on_F = false;
  for (unsigned int k = 0; k < dim; ++k)
    {
      const Tensor<1, dim> du = step * Point<dim>::unit_vector(k);
      const auto after = traction_at<dim>(c, u + du, F), before = traction_at<dim>(c, u - du, F);
      for (unsigned int i = 0; i < dim; ++i)
        EXPECT_NEAR(here.by_displacement[i][k],
                    (after.traction[i] - before.traction[i]) / (2. * step), tolerance);
      EXPECT_NEAR((after.energy - before.energy) / (2. * step),
                  kind.law.resists_motion ? -here.traction[k] : 0., tolerance);
      depends_on_u = depends_on_u || here.by_displacement.norm() > 0.;
      for (unsigned int l = 0; l < dim; ++l)
        {
          Tensor<2, dim> more = F, less = F;
          more[k][l] += step;
          less[k][l] -= step;
          const auto slope
            = (traction_at(c, u, more).traction - traction_at(c, u, less).traction) / (2. * step);
          for (unsigned int i = 0; i < dim; ++i)
            EXPECT_NEAR(here.by_increment[i][k][l], slope[i], tolerance);
          depends_on_F = depends_on_F || slope.norm() > 0.;
        }
    }
  EXPECT_EQ(depends_on_u, kind.law.resists_motion);
  EXPECT_EQ(depends_on_F, kind.law.follows_surface);
}

template <int dim>
void
check_all_kinds()
{
  for (const auto &kind : registered_conditions<dim>())
    {
      EXPECT_EQ(kind.law.evaluate != nullptr, kind.imposition == Imposition::traction) << kind.name;
      SCOPED_TRACE(kind.name);
      if (kind.law.evaluate != nullptr)
        check_derivatives(kind);
    }
}
} // namespace

TEST(SurfaceLaws, HaveTheirDerivatives)
{
  check_all_kinds<2>();
  check_all_kinds<3>();
}

TEST(BoundaryCondition, ValuesMustBeFinite)
{
  const auto c = condition<2>("set Type = traction\nset Value = 1/x; log(y)");
  EXPECT_EQ(c.value(0, Point<2>(2., 1.), 0.), 0.5);
  for (const auto &point : {Point<2>(0., 1.), Point<2>(1., -1.)})
    {
      const std::string told = message([&]() { c.vector(point, 0.25); });
      EXPECT_NE(told.find("Bodies/disc/Boundary conditions/top/Value"), std::string::npos) << told;
      EXPECT_NE(told.find("no finite number"), std::string::npos) << told;
      EXPECT_NE(told.find("t = 0.25"), std::string::npos) << told;
    }
}
} // namespace
} // namespace scree
