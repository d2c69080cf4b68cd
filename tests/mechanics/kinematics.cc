// A kinematics and a treatment of small cuts of another kind, which mechanics knows nothing of.
#include <gtest/gtest.h>

#include <cmath>

#include "equilibrium_model.h"

namespace scree
{
namespace
{
using namespace dealii;
using Vector = TrilinosWrappers::MPI::Vector;

/** A block held on a face of the box that moves, by penalty, springs and loads. */
std::string
driven_block()
{
  return grid_text("-1, -1", "1, 1", "4, 4", 2) + degree_text(2)
         + bodies_text(
           {{"block",
             half_space_text("0, 0.37", "0.1, 1") + "set Body force = 3*x*t; -2\n"
               + conditions_text(
                 {{"base", "set On = y-\nset Value = 0.01*t; 0.02*x*t"},
                  {"grip", "set On = surface\nset Method = penalty\nset Value = 0.03*t; -0.02*t"},
                  {"springs", "set Type = springs\nset On = x-\nset Value = 20; 50"},
                  {"wind", "set Type = traction\nset On = x+\nset Value = -4*t; 2"}})}});
}

/** u is the increment since a displacement u_0 at `start_time`, the geometry stays, as does Hooke.
 */
class LinearIncrement : public TotalKinematics<2>
{
public:
  LinearIncrement(const EquilibriumModel<2> &model, const Vector &u_0, const double start_time)
      : TotalKinematics<2>(*model.cut.space, model.quadrature, model.cut.bodies, *model.small_cuts)
      , u_0(u_0)
      , field(model.equilibrium.at_points(u_0))
      , start_time(start_time)
  {
  }

  const Vector &start_displacement() const override
  {
    return u_0;
  }
  PointEvaluator<2> start_displacement_field() const override
  {
    return field;
  }
  SurfaceHistory<2> surface_history(const PointInCell<2> &point,
                                    const Tensor<1, 2> &) const override
  {
    return {field.value(point), 1.};
  }
  double prescribed(const BoundaryCondition<2> &condition, const PrescribedUnknown<2> &unknown,
                    const double time) const override
  {
    return TotalKinematics<2>::prescribed(condition, unknown, time)
           - TotalKinematics<2>::prescribed(condition, unknown, start_time);
  }

private:
  const Vector            u_0;
  const PointEvaluator<2> field;
  const double            start_time;
};

/** A spring at every unknown, as stiff as its body; of its energy that of the first one. */
class NodalSprings : public SmallCutTreatment<2>
{
public:
  explicit NodalSprings(const DisplacementSpace<2> &space)
      : space(space)
  {
  }

  std::vector<std::vector<DofIndex>> couplings() const override
  {
    return {};
  }
  void add_to_matrix(const CutStiffness &stiffness, Matrix &matrix) const override
  {
    for (const DofIndex index : space.owned())
      matrix.add(index, index, stiffness.of_bodies[0]);
  }
  void add_start_forces(const CutStiffness &, const PointEvaluator<2> &, Vector &) const override
  {
  }
  double energy(const CutStiffness &stiffness, const PointEvaluator<2> &start,
                const PointEvaluator<2> &u) const override
  {
    const double whole = start.nodal_values(0)[0] + u.nodal_values(0)[0];
    return 0.5 * stiffness.of_bodies[0] * whole * whole;
  }

private:
  const DisplacementSpace<2> &space;
};
} // namespace

TEST(Kinematics, LinearIncrementsAddUp)
{
  EquilibriumModel<2> model(driven_block() + solver_text(1e-13));
  ASSERT_TRUE(model.step(0.5).converged());
  const Vector half = model.state.displacement;
  ASSERT_TRUE(model.step(1.).converged());
  const Vector whole = model.state.displacement;

  const LinearIncrement       kinematics(model, half, 0.5);
  const DisplacementSpace<2> &space = *model.cut.space;
  const BoundaryTerms<2>      terms(space, *model.cut.level_set_nodes, model.quadrature,
                                    model.cut.bodies, kinematics);
  Equilibrium<2> equilibrium(space, model.cut.bodies, kinematics, terms, model.contact);
  const auto     history = model.contact.initial_history();
  Vector         u       = zero_displacement(space), r(u), du(u);
  equilibrium.set_time(1., u);
  equilibrium.residual(u, history, r);
  model.linear_solver.solve(equilibrium.tangent(), du, r, equilibrium.is_symmetric());
  u += du;
  equilibrium.residual(u, history, r);
  EXPECT_LT(r.l2_norm(), 1e-10 * equilibrium.force_scale());
  u += half;
  u -= whole;
  EXPECT_LT(u.linfty_norm(), 1e-12);
  EXPECT_GT(whole.linfty_norm(), 1e-2);
}

TEST(Kinematics, TotalStartsFromNothing)
{
  const EquilibriumModel<2> model(driven_block());
  const auto               &kinematics = model.kinematics;
  EXPECT_EQ(kinematics.start_displacement().l2_norm(), 0.);
  EXPECT_TRUE(kinematics.bulk().is_linear());
  const PointInCell<2> point = {0, Point<2>(0.3, 0.8)};
  EXPECT_EQ(kinematics.reference_position(point), model.cut.space->position(0, point.unit_point));
  for (const auto &region : model.boundary_terms.regions())
    for (const auto &p : region.points)
      EXPECT_EQ(p.start_displacement.norm(), 0.);
}

TEST(SmallCutTreatment, IsAddedToTheBulk)
{
  EquilibriumModel<2>          model(driven_block());
  const DisplacementSpace<2>  &space = *model.cut.space;
  const NodalSprings           springs(space);
  const NoSmallCutTreatment<2> none;
  const auto                   forces = [&](const SmallCutTreatment<2> &treatment) {
    const TotalKinematics<2> kinematics(space, model.quadrature, model.cut.bodies, treatment);
    const BoundaryTerms<2>   terms(space, *model.cut.level_set_nodes, model.quadrature,
                                                     model.cut.bodies, kinematics);
    Equilibrium<2>           equilibrium(space, model.cut.bodies, kinematics, terms, model.contact);
    Vector                   u = zero_displacement(space), r(u);
    equilibrium.set_time(0., u);
    u = 1.;
    equilibrium.residual(u, model.contact.initial_history(), r);
    return r;
  };
  Vector       change = forces(springs);
  const Vector before = forces(none);
  change -= before;
  // 2 mu + min(lambda, 4 mu) of E = 1000, nu = 0.3
  const double stiffness = 1000. / 1.3 + 300. / (1.3 * 0.4);
  EXPECT_NEAR(change.linfty_norm(), stiffness, 1e-9 * stiffness);

  const TotalKinematics<2> kinematics(space, model.quadrature, model.cut.bodies, springs);
  Vector                   ones = zero_displacement(space);
  ones                          = 1.;
  const auto u                  = model.equilibrium.at_points(ones);
  EXPECT_NEAR(kinematics.bulk().energy_of_small_cuts(kinematics.start_displacement_field(), u),
              0.5 * stiffness, 1e-9 * stiffness);
}
} // namespace scree
