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
      const auto   treatment = make_small_cut_treatment(space, 0.1);
      const auto   matrix    = matrix_of(*treatment, space, stiffness);
      const auto   u         = waves(space);
      const double energy    = treatment->energy(stiffness, PointEvaluator<2>(space, u));
      EXPECT_GT(energy, 0.);
      EXPECT_NEAR(energy, 0.5 * matrix.matrix_norm_square(u), 1e-12 * energy);
      // The smaller ratio of two cells counts; factor and stiffness are factors.
      const double of_twice
        = GhostPenalty<2>(space, 0.2).energy(stiffness, PointEvaluator<2>(space, u));
      EXPECT_NEAR(of_twice, 2. * energy, 1e-12 * energy);
      stiffness.of_bodies[0] *= 3.;
      EXPECT_NEAR(treatment->energy(stiffness, PointEvaluator<2>(space, u)), 3. * energy,
                  1e-12 * energy);
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
  EXPECT_EQ(none->energy(stiffness, PointEvaluator<2>(space, waves(space))), 0.);
}
} // namespace scree
