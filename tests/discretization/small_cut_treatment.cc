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
matrix_of(const SmallCutTreatment<2> &treatment, const Fields<2> &fields,
          const CutStiffness &stiffness)
{
  DynamicSparsityPattern pattern(fields.n_dofs(), fields.n_dofs(), fields.relevant());
  for (const auto &nodes : treatment.couplings())
    fields.hanging_constraints().add_entries_local_to_global(
      unknowns_of_nodes<2>(nodes.data(), nodes.size()), pattern, true);
  for (const DofIndex index : fields.owned())
    pattern.add(index, index);
  TrilinosWrappers::SparseMatrix matrix;
  matrix.reinit(fields.owned(), fields.owned(), pattern, MPI_COMM_SELF, true);
  treatment.add_to_matrix(stiffness, matrix);
  matrix.compress(VectorOperation::add);
  return matrix;
}

/** A displacement with second derivatives that jump between cells. */
TrilinosWrappers::MPI::Vector
waves(const Fields<2> &fields)
{
  TrilinosWrappers::MPI::Vector u(fields.owned(), MPI_COMM_SELF);
  for (const DofIndex index : fields.owned())
    u(index) = std::sin(3. * index) + 0.2 * (index % 5);
  u.compress(VectorOperation::insert);
  return u;
}
} // namespace

TEST(SmallCutTreatment, EnergyOfGhostPenaltyIsThatOfItsMatrix)
{
  for (const unsigned int degree : {1u, 2u})
    {
      const CutBodies<2> model(graded_ball(degree));
      const Fields<2>   &fields    = *model.fields;
      CutStiffness       stiffness = {{7.}, {}};
      for (unsigned int a = 0; a < fields.cells().size(); ++a)
        stiffness.ratios.push_back(1. / (1. + a % 3));
      const auto   treatment = make_small_cut_treatment(fields, 0.1);
      const auto   matrix    = matrix_of(*treatment, fields, stiffness);
      const auto   u         = waves(fields);
      const double energy    = treatment->energy(stiffness, PointEvaluator<2>(fields, u));
      EXPECT_GT(energy, 0.);
      EXPECT_NEAR(energy, 0.5 * matrix.matrix_norm_square(u), 1e-12 * energy);
      // The smaller ratio of two cells counts; factor and stiffness are factors.
      const double of_twice
        = GhostPenalty<2>(fields, 0.2).energy(stiffness, PointEvaluator<2>(fields, u));
      EXPECT_NEAR(of_twice, 2. * energy, 1e-12 * energy);
      stiffness.of_bodies[0] *= 3.;
      EXPECT_NEAR(treatment->energy(stiffness, PointEvaluator<2>(fields, u)), 3. * energy,
                  1e-12 * energy);
    }
}

TEST(SmallCutTreatment, NoneAddsNothing)
{
  const CutBodies<2> model(graded_ball(1));
  const Fields<2>   &fields    = *model.fields;
  const CutStiffness stiffness = {{7.}, std::vector<double>(fields.cells().size(), 1.)};
  const auto         none      = make_small_cut_treatment(fields, 0.);
  EXPECT_TRUE(none->couplings().empty());
  EXPECT_EQ(matrix_of(*none, fields, stiffness).frobenius_norm(), 0.);
  EXPECT_EQ(none->energy(stiffness, PointEvaluator<2>(fields, waves(fields))), 0.);
}
} // namespace scree
