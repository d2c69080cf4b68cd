// The state of a moving geometry from a checkpoint: what contradicts itself is refused before it is
// used.
#include <gtest/gtest.h>

#include <scree/base/exceptions.h>
#include <scree/state/gathered_state.h>

#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace scree
{
namespace
{
using dealii::Point;
using dealii::Tensor;

const dealii::BoundingBox<2> background({Point<2>(), Point<2>(2., 2.)});

Lattice<2>
lattice()
{
  Lattice<2> result(LatticeFrame<2>{{}, 0.5, background}, {{0, 0}}, {{5, 4}});
  result.values().assign(20, -1.);
  return result;
}

/** Of a deformable body with a material point that touches something. */
GatheredState<2>
saved_state()
{
  GatheredState<2> saved;
  saved.last_step_size = 0.1;
  saved.bodies.resize(1);
  saved.bodies[0].n_nodes   = {{5, 4}};
  saved.bodies[0].level_set = lattice().values();
  saved.bodies[0].box       = background;
  saved.increments_of_bodies.emplace_back(
    lattice(), NodalVectors<2>{{lattice().values(), lattice().values()}});
  saved.increments_of_rigid.resize(1);
  MaterialPoints<2> points;
  points.add(Point<2>(0.5, 0.5), 0, 0.25, 0.5, 1.);
  saved.points.resize(1);
  points.pack(0, saved.points[0]);
  saved.step_end.contact = {{0},   {1},   {Point<2>(1., 1.)}, {Tensor<1, 2>({1., 0.})},
                            {0.1}, {0.5}, {Tensor<1, 2>()},   {2.}};
  return saved;
}

State<2>
restored(const GatheredState<2> &saved)
{
  State<2>            state;
  const Expression<2> zero("0; 0", 2, "");
  state.bodies.push_back(
    {BodyDefinition<2>{"body", "", nullptr, nullptr, zero, {}, 0., zero, zero, {}},
     BodyGeometry<2>{lattice(), background}});
  restore_moving(saved, background, MPI_COMM_SELF, "results", state);
  return state;
}

TEST(GatheredState, AMovingStateComesBack)
{
  const State<2> state = restored(saved_state());
  EXPECT_EQ(state.points.size(), 1u);
  EXPECT_EQ(state.step_end.contact.size(), 1u);
  EXPECT_EQ(state.bodies[0].level_set.values(), lattice().values());
}

TEST(GatheredState, WhatContradictsItselfIsRefused)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::pair<std::string, std::function<void(GatheredState<2> &)>>> damages = {
    {"no body", [](auto &s) { s.bodies.clear(); }},
    {"half a point", [](auto &s) { s.points[0].pop_back(); }},
    {"values of a level set", [](auto &s) { s.bodies[0].level_set.pop_back(); }},
    {"nodes of a level set",
     [](auto &s) {
       s.bodies[0].n_nodes = {{-5, -4}};
     }},
    {"a level set far away",
     [](auto &s) { s.bodies[0].lower[1] = std::numeric_limits<int>::max(); }},
    {"a box of nowhere", [nan](auto &s) { s.bodies[0].box.get_boundary_points().first[0] = nan; }},
    {"the displacement of a body",
     [](auto &s) {
       s.bodies[0].displacement = {lattice(), NodalVectors<2>{{{1.}, {1.}}}};
     }},
    {"a displacement beyond all bounds",
     [](auto &s) {
       const std::vector<double> far(20, 1e300);
       s.bodies[0].displacement = {lattice(), NodalVectors<2>{{far, far}}};
     }},
    {"an increment that is no number",
     [nan](auto &s) {
       const std::vector<double> none(20, nan);
       s.increments_of_bodies[0] = {lattice(), NodalVectors<2>{{none, none}}};
     }},
    {"a level set that is no number", [nan](auto &s) { s.bodies[0].level_set[3] = nan; }},
    {"a point that is no number", [nan](auto &s) { s.points[0].back() = nan; }},
    {"the length of the step", [nan](auto &s) { s.last_step_size = nan; }},
    {"no increments of bodies", [](auto &s) { s.increments_of_bodies.clear(); }},
    {"an empty increment", [](auto &s) { s.increments_of_bodies[0] = {}; }},
    {"no increments of rigid bodies", [](auto &s) { s.increments_of_rigid.clear(); }},
    {"no rates of rigid bodies", [](auto &s) { s.has_inertia = true; }},
    {"forces on a rigid body that is not there",
     [](auto &s) { s.step_end.driving.of_rigid = {1.}; }},
    {"pressures of contact", [](auto &s) { s.step_end.contact.pressure.clear(); }},
    {"cells of contact", [](auto &s) { s.step_end.contact.cell_size[0] = 0.; }},
    {"contact at no place", [nan](auto &s) { s.step_end.contact.position[0][0] = nan; }},
    {"contact far away", [](auto &s) { s.step_end.contact.position[0][0] = 1e300; }}};
  for (const auto &[what, damage] : damages)
    {
      GatheredState<2> saved = saved_state();
      damage(saved);
      EXPECT_THROW(restored(saved), UserError) << what;
    }
}
} // namespace
} // namespace scree
