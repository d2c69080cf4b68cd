// Finite rigid motions and their derivatives; what section Motion allows.
#include <gtest/gtest.h>

#include <scree/base/exceptions.h>
#include <scree/bodies/body.h>
#include <scree/parameters/file.h>

#include <cmath>
#include <random>

namespace scree
{
namespace
{
using namespace dealii;

template <int dim>
using Unknowns = typename RigidPose<dim>::Unknowns;

/** A rigid body of radius 2.5 with free components. */
template <int dim>
RigidBody<dim>
rigid_body()
{
  MotionParameters<dim> parameters;
  parameters.reference_point.assign(dim, 0.3);
  parameters.load.fill("0");
  Point<dim> lower, upper;
  for (unsigned int d = 0; d < dim; ++d)
    upper[d] = 4. + 0.5 * d;
  upper[0] = 5.;
  const BoundingBox<dim>       box({lower, upper});
  typename Lattice<dim>::Index first, n_nodes;
  first.fill(0);
  n_nodes.fill(4);
  return RigidBody<dim>(parameters, box, Lattice<dim>({lower, 1., box}, first, n_nodes), nullptr);
}

/** Unknowns with a rotation of about the given angle. */
template <int dim>
Unknowns<dim>
unknowns(const double angle)
{
  Unknowns<dim>      q{};
  const Tensor<1, 3> axis = Point<3>(0.48, -0.6, 0.64);
  for (unsigned int m = 0; m < q.size(); ++m)
    q[m] = m < dim ? 0.1 * (m + 1) : 2.5 * angle * (dim == 2 ? 1. : axis[m - dim]);
  return q;
}

/** (f(q + step e_m) - f(q - step e_m))/(2 step). */
template <int dim, typename Function>
auto
difference(const RigidBody<dim> &body, const Unknowns<dim> &q, const unsigned int m,
           const Function &f)
{
  constexpr double step = 1e-5;
  Unknowns<dim>    plus = q, minus = q;
  plus[m] += step;
  minus[m] -= step;
  return (f(RigidPose<dim>(body, plus)) - f(RigidPose<dim>(body, minus))) / (2. * step);
}

template <int dim>
void
check_derivatives(const double angle)
{
  const RigidBody<dim> body = rigid_body<dim>();
  const Unknowns<dim>  q    = unknowns<dim>(angle);
  const RigidPose<dim> pose(body, q);
  Point<dim>           X;
  Tensor<1, dim>       f;
  for (unsigned int d = 0; d < dim; ++d)
    {
      X[d] = 0.7 + 0.9 * d;
      f[d] = 1.1 - 0.8 * d;
    }
  typename RigidPose<dim>::Load load;
  load.add(X - body.reference_point, f);
  const Tensor<1, 3> M({0.4, -1.2, 0.7});
  const auto         of_X = pose.derivative(X);
  for (unsigned int m = 0; m < n_rigid_components<dim>; ++m)
    {
      const Tensor<1, dim> du = difference<dim>(
        body, q, m, [&](const RigidPose<dim> &moved) { return moved.displacement(X); });
      EXPECT_LE((du - of_X[m]).norm(), 1e-9) << angle;
      EXPECT_NEAR(pose.generalised_force(load)[m], f * of_X[m], 1e-13);
      for (unsigned int n = dim; m >= dim && n < n_rigid_components<dim>; ++n)
        {
          const unsigned int i = rotation_axis<dim>(n), j = rotation_axis<dim>(m);
          const double       force = difference<dim>(body, q, m, [&](const RigidPose<dim> &moved) {
            return moved.generalised_force(load)[n];
          });
          EXPECT_NEAR(force, pose.curvature(load)[i][j], 1e-9) << angle;
          const double moment = difference<dim>(body, q, m, [&](const RigidPose<dim> &moved) {
            return moved.generalised_moment(M)[i];
          });
          EXPECT_NEAR(moment, pose.generalised_moment_derivative(M)[i][j], 1e-9) << angle;
        }
    }
  // The moment of the forces does the same as the forces.
  for (unsigned int m = dim; m < n_rigid_components<dim>; ++m)
    EXPECT_NEAR(pose.generalised_moment(pose.moment(load))[rotation_axis<dim>(m)],
                pose.generalised_force(load)[m], 1e-13);
}

TEST(RigidPose, DerivativesEqualFiniteDifferences)
{
  // The functions of the angle change from series to closed form at 1.
  for (const double angle : {0., 1e-5, 0.3, 0.999, 1.001, 2.5, 5.})
    {
      check_derivatives<2>(angle);
      check_derivatives<3>(angle);
    }
}

TEST(RigidPose, TurnsAboutTheReferencePoint)
{
  const RigidBody<2> body  = rigid_body<2>();
  const double       angle = numbers::PI / 6.;
  const RigidPose<2> pose(body, {{1., 2., body.radius * angle}});
  EXPECT_LE((pose.displacement(body.reference_point) - Tensor<1, 2>({1., 2.})).norm(), 1e-15);
  const Point<2> X = body.reference_point + Point<2>(1., 0.);
  EXPECT_LE((pose.displacement(X) - Tensor<1, 2>({std::cos(angle), 2. + std::sin(angle)})).norm(),
            1e-14);
}

template <int dim>
void
check_initial_position()
{
  const RigidBody<dim> body = rigid_body<dim>();
  Point<dim>           X;
  for (unsigned int d = 0; d < dim; ++d)
    X[d] = 1.7 - 2. * d;
  for (const double angle : {0., 0.3, 2.5})
    {
      const RigidPose<dim> pose(body, unknowns<dim>(angle));
      EXPECT_LE(pose.initial_position(X + pose.displacement(X)).distance(X), 1e-14);
    }
  EXPECT_EQ(RigidPose<dim>(body, {}).initial_position(X), X);
}

TEST(RigidPose, FindsInitialPositions)
{
  check_initial_position<2>();
  check_initial_position<3>();
}

TEST(RigidPose, KeepsLengthsIn3D)
{
  const RigidBody<3> body = rigid_body<3>();
  for (const double angle : {0.5, 1.5, 4.})
    {
      const RigidPose<3> pose(body, unknowns<3>(angle));
      const Point<3>     X(1., 2., 3.), Y(-2., 0.5, 1.);
      const Point<3>     x = X + pose.displacement(X), y = Y + pose.displacement(Y);
      EXPECT_NEAR(x.distance(y), X.distance(Y), 1e-14);
      // Points on the axis stay on it.
      const Point<3> on_axis = body.reference_point + pose.rotation();
      EXPECT_LE((pose.displacement(on_axis) - pose.translation()).norm(), 1e-14);
    }
}

/** Makes a body of the material "soft" or "hard" (rigid) with the given lines. */
std::vector<Body<2>>
make(const std::string &material, const std::string &lines)
{
  ParameterFile file = ParameterFile::from_string(
    "set Names = it\nsubsection it\nset Material = " + material
    + "\nsubsection Shape\nset Type = disc\nset Centre = 0, 0\nset Radius = 3\nend\n" + lines
    + "\nend\n");
  ParameterSection section    = file.root();
  const auto       parameters = declare_bodies<2>(section, {{"soft", {}}, {"hard", {}}});
  file.check();
  MaterialParameters soft, hard;
  soft.young   = 1.;
  soft.poisson = 0.;
  hard.law     = "rigid";
  std::map<std::string, std::shared_ptr<const Material<2>>> materials;
  materials["soft"] = make_material<2>(soft);
  materials["hard"] = make_material<2>(hard);
  const Point<2> lower(-1., -1.), upper(1., 4.);
  return make_bodies<2>(parameters, materials, {lower, 0.05, BoundingBox<2>({lower, upper})}, 0.3);
}

std::string
message(const std::string &material, const std::string &lines)
{
  try
    {
      make(material, lines);
    }
  catch (const UserError &error)
    {
      return error.what();
    }
  return "";
}

TEST(RigidBody, ReadsItsMotion)
{
  const auto body
    = make("hard", "subsection Motion\nset Force y = -2*t\nset Rotation = 0.5*t\nend").front();
  ASSERT_TRUE(body.is_rigid());
  const RigidBody<2> &rigid = *body.rigid;
  EXPECT_NEAR(rigid.reference_point.norm(), 0., 1e-14); // of the whole disc, not of the clipped one
  EXPECT_NEAR(rigid.radius, 3., 1e-14);
  EXPECT_FALSE(rigid.is_free(0));
  EXPECT_TRUE(rigid.is_free(1));
  EXPECT_FALSE(rigid.is_free(2));
  EXPECT_EQ(rigid.value(0, 3.), 0.);
  EXPECT_EQ(rigid.value(1, 3.), -6.);
  EXPECT_EQ(rigid.value(2, 3.), 1.5);
}

TEST(RigidBody, TellsWrongUse)
{
  const std::string motion = "subsection Motion\n";
  const auto        expect = [](const std::string &text, const std::string &part) {
    EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in:\n" << text;
  };
  expect(message("hard", motion + "set Force x = 1\nset Displacement x = 0.1\nend"), "both");
  expect(message("hard", motion + "set Force x = 1*\nend"), "Force x");
  expect(message("hard", motion + "set Reference point = 1\nend"), "coordinates");
  expect(message("soft", motion + "set Moment = 1\nend"), "not rigid");
  expect(message("hard", "set Body force = 0; -1"), "no volume");
  expect(message("hard", "subsection Boundary conditions\nset Names = a\nend"),
         "no boundary conditions");
  const auto body = make("hard", motion + "set Force x = 1/t\nend").front();
  EXPECT_THROW(body.rigid->value(0, 0.), UserError);
}
} // namespace
} // namespace scree
