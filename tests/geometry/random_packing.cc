#include <gtest/gtest.h>

#include <scree/geometry/random_packing.h>
#include <scree/geometry/touching_scale.h>

#include <deal.II/base/symmetric_tensor.h>

#include <cmath>
#include <iostream>

namespace scree
{
namespace
{
using namespace dealii;

template <int dim>
BoundingBox<dim>
unit_box()
{
  Point<dim> upper;
  for (unsigned int d = 0; d < dim; ++d)
    upper[d] = 1.;
  return BoundingBox<dim>({Point<dim>(), upper});
}

/** n shapes in a box, without rounding, of six corners. */
template <int dim>
PackingParameters<dim>
packing(const unsigned int n, const RandomShapeType type, const double size_ratio,
        const std::vector<double> &aspect = {1., 1.}, const std::uint64_t seed = 1)
{
  PackingParameters<dim> p;
  p.n                 = n;
  p.box               = unit_box<dim>();
  p.seed              = seed;
  p.shapes.type       = type;
  p.shapes.size_ratio = size_ratio;
  p.shapes.aspect     = aspect;
  return p;
}

/** Directions all around, evenly spread. */
template <int dim>
std::vector<Tensor<1, dim>>
directions()
{
  std::vector<Tensor<1, dim>> result;
  constexpr unsigned int      n = dim == 2 ? 300 : 500;
  for (unsigned int i = 0; i < n; ++i)
    {
      const double   height = dim == 2 ? 0. : (2. * i + 1.) / n - 1.;
      const double   angle  = dim == 2 ? 2. * M_PI * i / n : 2.399963229728653 * i;
      Tensor<1, dim> x;
      x[0] = std::sqrt(1. - height * height) * std::cos(angle);
      x[1] = std::sqrt(1. - height * height) * std::sin(angle);
      if constexpr (dim == 3)
        x[2] = height;
      result.push_back(x);
    }
  return result;
}

/** What a packing is like, by the shapes that are made of it. */
struct Findings
{
  double least_gap     = 1e300; //!< of points of outlines to other shapes, about
  double least_in_wall = 1e300; //!< of points of outlines to the container
  double core          = 0.;    //!< solid fraction away from the walls
};

/** The solid fraction two diameters and more away from the walls, by points at random. */
template <int dim>
double
core_fraction(const PackingParameters<dim> &p, const std::vector<PackedShape<dim>> &members,
              const std::vector<ShapePointer<dim>> &shapes)
{
  double largest = 0.;
  for (const auto &member : members)
    largest = std::max(largest, member.shape->outer_radius());
  const double           margin = std::min(4. * largest, 0.3);
  constexpr unsigned int n      = 10000;
  std::mt19937_64        random(7);
  unsigned int           n_in = 0, n_all = 0;
  while (n_all < n)
    {
      Point<dim> x;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] = margin + (1. - 2. * margin) * uniform(random);
      if (p.in_cylinder && std::hypot(x[0] - 0.5, x[1] - 0.5) > 0.5 - margin)
        continue;
      ++n_all;
      for (unsigned int i = 0; i < members.size(); ++i)
        if (x.distance(members[i].centre) < members[i].shape->outer_radius()
            && shapes[i]->signed_distance(x) < 0.)
          {
            ++n_in;
            break;
          }
    }
  return static_cast<double>(n_in) / n_all;
}

/** Points of the outline of each shape, against all others that are near and the container. */
template <int dim>
Findings
look_at(const PackingParameters<dim> &p, const RandomPacking<dim> &packed)
{
  const auto                    &members = packed.members;
  std::vector<ShapePointer<dim>> shapes;
  for (const auto &member : members)
    shapes.push_back(make_shape(member.shape->placed(member.centre, member.rotation)));
  Findings   found;
  const auto all_around = directions<dim>();
  for (unsigned int i = 0; i < members.size(); ++i)
    {
      const TurnedShape<dim>    a{*members[i].shape, members[i].rotation};
      std::vector<unsigned int> near;
      for (unsigned int j = 0; j < members.size(); ++j)
        if (j != i
            && members[i].centre.distance(members[j].centre)
                 < 1.01 * (a.shape.outer_radius() + members[j].shape->outer_radius()))
          near.push_back(j);
      for (const auto &n : all_around)
        {
          const Point<dim> x = members[i].centre + a.support(n);
          EXPECT_NEAR(shapes[i]->signed_distance(x), 0., 1e-10);
          for (unsigned int d = 0; d < dim; ++d)
            if (!p.in_cylinder || d == 2)
              found.least_in_wall = std::min(
                {found.least_in_wall, x[d] - p.box.lower_bound(d), p.box.upper_bound(d) - x[d]});
          if (p.in_cylinder)
            found.least_in_wall
              = std::min(found.least_in_wall, 0.5 - std::hypot(x[0] - 0.5, x[1] - 0.5));
          for (const unsigned int j : near)
            found.least_gap = std::min(found.least_gap, shapes[j]->signed_distance(x));
        }
    }
  found.core = core_fraction(p, members, shapes);
  return found;
}

/** Checks a packing: in the container, without overlap, as dense as `fraction` and `core` tell. */
template <int dim>
void
check_packing(const char *name, const PackingParameters<dim> &p, const double fraction,
              const std::pair<double, double> &core)
{
  const auto packed = pack_at_random(p);
  ASSERT_EQ(packed.members.size(), p.n);
  double volume = 0.;
  for (const auto &member : packed.members)
    volume += member.shape->volume();
  volume *= p.in_cylinder ? 4. / M_PI : 1.;
  const Findings found = look_at(p, packed);
  std::cout << name << " fill " << packed.solid_fraction << ", " << found.core
            << " away from walls; least gap " << found.least_gap << ", to walls "
            << found.least_in_wall << "\n";
  EXPECT_NEAR(packed.solid_fraction, volume, 1e-12) << name;
  EXPECT_GT(packed.solid_fraction, fraction) << name;
  EXPECT_GT(found.core, core.first) << name;
  EXPECT_LT(found.core, core.second) << name;
  EXPECT_GT(found.least_gap, -1e-11) << name;
  EXPECT_GT(found.least_in_wall, -1e-11) << name;
}

// Jammed without friction discs of several sizes fill 0.84, ellipses of aspect 1.4 0.89
// (Donev et al., Phys. Rev. E 75, 051304, 2007), far from walls.
TEST(RandomPacking, IsDenseInThePlane)
{
  using Type = RandomShapeType;
  check_packing<2>("discs", packing<2>(200, Type::ball, 1.4), 0.77, {0.79, 0.85});
  check_packing<2>("ellipses", packing<2>(150, Type::ellipsoid, 1.4, {1.4, 1.4}), 0.82,
                   {0.86, 0.91});
  check_packing<2>("long ellipses", packing<2>(60, Type::ellipsoid, 1.4, {3., 3.}), 0.78,
                   {0.8, 0.9});
  auto p            = packing<2>(60, Type::superellipsoid, 1.2, {1.2, 1.8});
  p.shapes.exponent = 4.;
  check_packing<2>("superellipses", p, 0.82, {0.85, 0.95});
}

TEST(RandomPacking, IsDenseOfPolygons)
{
  auto p = packing<2>(60, RandomShapeType::regular_polygon, 1.4);
  check_packing<2>("hexagons", p, 0.75, {0.8, 0.93});
  p.shapes.corners = {3, 3};
  check_packing<2>("triangles", p, 0.75, {0.75, 0.95});
  p                 = packing<2>(60, RandomShapeType::random_polygon, 2., {1., 1.5});
  p.shapes.corners  = {4, 8};
  p.shapes.rounding = 0.2;
  check_packing<2>("rounded polygons", p, 0.75, {0.8, 0.95});
}

// Balls 0.64, spheroids of aspect 1.4 0.70 to 0.71 (Donev et al., Science 303, 990, 2004).
TEST(RandomPacking, IsDenseInSpace)
{
  using Type = RandomShapeType;
  check_packing<3>("balls", packing<3>(150, Type::ball, 1.3), 0.5, {0.58, 0.66});
  check_packing<3>("long spheroids", packing<3>(60, Type::ellipsoid, 1., {1.4, 1.4}), 0.5,
                   {0.63, 0.75});
  auto p                 = packing<3>(60, Type::superellipsoid, 1.2, {1., 1.2});
  p.shapes.second_aspect = {1.3, 1.3};
  p.shapes.exponent      = 3.;
  check_packing<3>("superellipsoids", p, 0.5, {0.58, 0.8});
}

// Few bodies: the fractions of so small cores scatter.
TEST(RandomPacking, FillsACylinder)
{
  using Type             = RandomShapeType;
  const auto in_cylinder = [](auto parameters) {
    parameters.in_cylinder = true;
    return parameters;
  };
  check_packing<2>("ellipses in a disc",
                   in_cylinder(packing<2>(40, Type::ellipsoid, 1.4, {2., 2.})), 0.8, {0.82, 0.92});
  check_packing<2>("discs in a disc", in_cylinder(packing<2>(100, Type::ball, 1.4)), 0.74,
                   {0.75, 0.86});
  check_packing<2>("hexagons in a disc", in_cylinder(packing<2>(30, Type::regular_polygon, 1.4)),
                   0.74, {0.78, 0.93});
  check_packing<3>("spheroids in a cylinder",
                   in_cylinder(packing<3>(25, Type::ellipsoid, 1., {1.4, 1.4})), 0.45, {0.45, 0.8});
  check_packing<3>("balls in a cylinder", in_cylinder(packing<3>(40, Type::ball, 1.3)), 0.4,
                   {0.4, 0.7});
  check_packing<2>("a disc", packing<2>(1, Type::ball, 1.), 0.78, {0.99, 1.01});
}

TEST(RandomPacking, HasTheSolidFraction)
{
  auto p           = packing<2>(60, RandomShapeType::ellipsoid, 1.4, {1.4, 2.});
  p.solid_fraction = 0.6;
  check_packing<2>("loose ellipses", p, 0.6 - 1e-12, {0.4, 0.8});
  EXPECT_NEAR(pack_at_random(p).solid_fraction, 0.6, 1e-12);
  p.solid_fraction = 0.05;
  EXPECT_NEAR(pack_at_random(p).solid_fraction, 0.05, 1e-12);
  p.solid_fraction  = 0.97;
  const auto jammed = pack_at_random(p);
  EXPECT_GT(jammed.solid_fraction, 0.82);
  EXPECT_LT(jammed.solid_fraction, 0.9);
}

// What mt19937_64 and IEEE arithmetic give, on every machine.
TEST(RandomPacking, IsTheSameEverywhere)
{
  const auto balls = packing<2>(20, RandomShapeType::ball, 2., {1., 1.}, 5);
  EXPECT_EQ(pack_at_random(balls).members[7].centre,
            Point<2>(0.69132706209694361, 0.42343076526347778));
  EXPECT_EQ(pack_at_random(balls).members[7].shape->outer_radius(), 0.11544130952426229);
  const auto p     = packing<3>(15, RandomShapeType::ellipsoid, 1.5, {1., 1.5}, 5);
  const auto first = pack_at_random(p).members, again = pack_at_random(p).members;
  auto       other = p;
  other.seed       = 6;
  EXPECT_NE(pack_at_random(other).members[7].centre, first[7].centre);
  for (unsigned int i = 0; i < p.n; ++i)
    {
      EXPECT_EQ(first[i].centre, again[i].centre);
      EXPECT_EQ(first[i].rotation, again[i].rotation);
    }
}

TEST(RandomShapes, HaveTheDistributions)
{
  const auto             p = packing<2>(1, RandomShapeType::ellipsoid, 2., {1.2, 1.8});
  constexpr unsigned int n = 10000;
  std::mt19937_64        random(3);
  double                 radii = 0., aspects = 0., least = 1e300, most = 0., squares = 0.;
  Tensor<1, 3>           turned;
  RandomShapes<3>        in_space;
  in_space.type = RandomShapeType::ellipsoid;
  for (unsigned int i = 0; i < n; ++i)
    {
      const auto   shape  = p.shapes.draw(random);
      const double radius = std::sqrt(shape->volume() / M_PI);
      const double aspect = std::pow(shape->outer_radius() / radius, 2);
      radii += radius / n;
      aspects += aspect / n;
      least                = std::min({least, radius / 1., aspect / 1.2});
      most                 = std::max({most, radius / 2., aspect / 1.8});
      const Tensor<2, 3> r = in_space.draw_rotation(random);
      EXPECT_NEAR((r * transpose(r) - unit_symmetric_tensor<3>()).norm(), 0., 1e-14);
      EXPECT_NEAR(determinant(r), 1., 1e-14);
      turned += 1. / n * (r * Tensor<1, 3>({0., 0., 1.}));
      squares += r[0][1] * r[0][1] / n;
    }
  // Within four standard deviations of the means.
  EXPECT_NEAR(radii, 1.5, 4. * std::sqrt(1. / 12. / n));
  EXPECT_NEAR(aspects, 1.5, 4. * 0.6 * std::sqrt(1. / 12. / n));
  EXPECT_GT(least, 1. - 1e-12);
  EXPECT_LT(most, 1. + 1e-12);
  EXPECT_LT(turned.norm(), 4. / std::sqrt(n));
  EXPECT_NEAR(squares, 1. / 3., 4. * 0.3 / std::sqrt(n));
}

TEST(RandomShapes, HaveTheirVolume)
{
  std::mt19937_64 random(3);
  RandomShapes<2> shapes;
  for (const auto type : {RandomShapeType::ball, RandomShapeType::superellipsoid,
                          RandomShapeType::regular_polygon, RandomShapeType::random_polygon})
    {
      shapes.type        = type;
      shapes.exponent    = 3.;
      shapes.aspect      = {1.3, 1.3};
      shapes.rounding    = 0.4;
      const auto   shape = shapes.draw(random);
      double       area  = 0.; // of the points of the outline
      Tensor<1, 2> last;
      for (unsigned int i = 0; i <= 20000; ++i)
        {
          const double       angle = 2. * M_PI * (i + 0.5) / 20000;
          const Tensor<1, 2> x = shape->support(Tensor<1, 2>({std::cos(angle), std::sin(angle)}));
          area += i == 0 ? 0. : 0.5 * (last[0] * x[1] - last[1] * x[0]);
          last = x;
        }
      EXPECT_NEAR(shape->volume(), M_PI, 1e-12);
      EXPECT_NEAR(area, M_PI, 1e-5);
    }
}
} // namespace
} // namespace scree
