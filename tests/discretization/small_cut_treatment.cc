// What treatments of small cuts add to couplings, matrix and energy.
#include <gtest/gtest.h>

#include <scree/discretization/ghost_penalty.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include "cut_bodies.h"

namespace scree
{
namespace
{
using namespace dealii;

std::string
graded_ball(const unsigned int degree)
{
  return grid_text("-1, -1", "1, 1", "4, 4", 3) + degree_text(degree)
         + bodies_text({{"ball", ball_text("0.013, 0.021", 0.7)}});
}

/** The matrix of a treatment on cells and what it couples. */
TrilinosWrappers::SparseMatrix
matrix_of(const SmallCutTreatment<2> &treatment, const DisplacementSpace<2> &space,
          const CutStiffness &stiffness)
{
  DynamicSparsityPattern pattern(space.n_dofs(), space.n_dofs(), space.relevant());
  for (const auto &nodes : treatment.couplings())
    space.hanging_constraints().add_entries_local_to_global(
      unknowns_of_nodes<2>(nodes.data(), nodes.size()), pattern, true);
  for (const DofIndex index : space.owned())
    pattern.add(index, index);
  TrilinosWrappers::SparseMatrix matrix;
  matrix.reinit(space.owned(), space.owned(), pattern, MPI_COMM_SELF, true);
  treatment.add_to_matrix(stiffness, matrix);
  matrix.compress(VectorOperation::add);
  return matrix;
}

/** A displacement with second derivatives that jump between cells. */
TrilinosWrappers::MPI::Vector
waves(const DisplacementSpace<2> &space)
{
  TrilinosWrappers::MPI::Vector u(space.owned(), MPI_COMM_SELF);
  for (const DofIndex index : space.owned())
    u(index) = std::sin(3. * index) + 0.2 * (index % 5);
  u.compress(VectorOperation::insert);
  return u;
}
} // namespace

TEST(SmallCutTreatment, EnergyOfGhostPenaltyIsThatOfItsMatrix)
{
  for (const unsigned int degree : {1u, 2u})
    {
      const CutBodies<2>          model(graded_ball(degree));
      const DisplacementSpace<2> &space     = *model.space;
      CutStiffness                stiffness = {{7.}, {}};
      for (unsigned int a = 0; a < space.cells().size(); ++a)
        stiffness.ratios.push_back(1. / (1. + a % 3));
      const auto              treatment = make_small_cut_treatment(space, 0.1);
      const auto              matrix    = matrix_of(*treatment, space, stiffness);
      const auto              u         = waves(space);
      const PointEvaluator<2> rest(space), of_u(space, u);
      const double            energy = treatment->energy(stiffness, rest, of_u);
      EXPECT_GT(energy, 0.);
      EXPECT_NEAR(energy, 0.5 * matrix.matrix_norm_square(u), 1e-12 * energy);
      // The smaller ratio of two cells counts; factor and stiffness are factors.
      const double of_twice = GhostPenalty<2>(space, 0.2).energy(stiffness, rest, of_u);
      EXPECT_NEAR(of_twice, 2. * energy, 1e-12 * energy);
      stiffness.of_bodies[0] *= 3.;
      EXPECT_NEAR(treatment->energy(stiffness, rest, of_u), 3. * energy, 1e-12 * energy);
    }
}

TEST(SmallCutTreatment, NoneAddsNothing)
{
  const CutBodies<2>          model(graded_ball(1));
  const DisplacementSpace<2> &space     = *model.space;
  const CutStiffness          stiffness = {{7.}, std::vector<double>(space.cells().size(), 1.)};
  const auto                  none      = make_small_cut_treatment(space, 0.);
  EXPECT_TRUE(none->couplings().empty());
  EXPECT_EQ(matrix_of(*none, space, stiffness).frobenius_norm(), 0.);
  const PointEvaluator<2> u(space, waves(space));
  EXPECT_EQ(none->energy(stiffness, u, u), 0.);
}

// A body that is rough by r after it turned, X = Q^T (x - r), is as good as one that never turned.
TEST(SmallCutTreatment, GhostPenaltySmoothsWhatHasTurned)
{
  for (const unsigned int degree : {1u, 2u})
    for (const double angle : {0., 0.5, 2., numbers::PI})
      {
        const CutBodies<2>          model(graded_ball(degree));
        const DisplacementSpace<2> &space = *model.space;
        const CutStiffness    stiffness   = {{7.}, std::vector<double>(space.cells().size(), 1.)};
        const GhostPenalty<2> treatment(space, 0.1);
        const double          c = std::cos(angle), s = std::sin(angle);
        TrilinosWrappers::MPI::Vector rough = waves(space), u_n = waves(space);
        rough *= 1e-6;
        space.hanging_constraints().distribute(rough);
        for (unsigned int a = 0; a < space.cells().size(); ++a)
          for (unsigned int i = 0; i < space.basis.n_nodes; ++i)
            {
              const DofIndex     node = space.nodes(a)[i];
              const Point<2>     x    = space.position(a, space.basis.node(i));
              const Tensor<1, 2> y{{x[0] - rough(node), x[1] - rough(node + 1)}};
              u_n(node)     = x[0] - (c * y[0] + s * y[1]);
              u_n(node + 1) = x[1] - (-s * y[0] + c * y[1]);
            }
        const PointEvaluator<2> rest(space), turned(space, u_n), of_rough(space, rough);
        const double            energy = treatment.energy(stiffness, rest, of_rough);
        EXPECT_NEAR(treatment.energy(stiffness, turned, rest), energy, 3e-4 * energy);

        TrilinosWrappers::MPI::Vector forces(space.owned(), MPI_COMM_SELF), of_matrix(forces);
        treatment.add_start_forces(stiffness, turned, forces);
        forces.compress(VectorOperation::add);
        matrix_of(treatment, space, stiffness).vmult(of_matrix, rough);
        const double size = of_matrix.l2_norm();
        forces -= of_matrix;
        EXPECT_LE(forces.l2_norm(), 3e-4 * size);
      }
}
} // namespace scree
