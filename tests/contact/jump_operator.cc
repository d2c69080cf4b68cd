// The jump operator B: forces are B^T f, stiffness is B^T D B, and whatever discretises contact
// makes one.
#include <gtest/gtest.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <map>
#include <random>

#include "contact_model.h"

namespace scree
{
namespace
{
using namespace dealii;
using Vector = TrilinosWrappers::MPI::Vector;

template <int dim>
void
expect_couplings_of_a_group(const JumpOperator<dim> &B, const unsigned int n)
{
  EXPECT_TRUE(B.couplings(std::vector<bool>(n, false)).empty());
  std::vector<bool> of_one_group(n, false);
  of_one_group[n / 2] = true;
  B.complete_groups(of_one_group);
  const auto of_group = B.couplings(of_one_group);
  ASSERT_EQ(of_group.size(), 1u);
  const auto all = B.all_unknowns();
  EXPECT_TRUE(
    std::includes(all.begin(), all.end(), of_group.front().begin(), of_group.front().end()));
  EXPECT_FALSE(of_one_group[0]);
  EXPECT_TRUE(of_one_group[n / 2]);
}

template <int dim>
void
check_adjoint(const CutBodies<dim> &model, ContactDiscretisation<dim> &&discretisation)
{
  JumpOperator<dim> &B = discretisation.jump_operator;
  const unsigned int n = discretisation.points.size();
  ASSERT_GT(n, 8u);
  std::mt19937                           engine(1);
  std::uniform_real_distribution<double> number(-1., 1.);
  Vector                                 u(model.space->owned(), MPI_COMM_WORLD);
  for (const auto i : model.space->owned())
    u(i) = number(engine);
  u.compress(VectorOperation::insert);
  std::vector<Tensor<1, dim>> forces(n);
  std::vector<Tensor<2, dim>> D(n);
  for (unsigned int p = 0; p < n; ++p)
    for (unsigned int d = 0; d < dim; ++d)
      {
        forces[p][d] = number(engine);
        for (unsigned int e = 0; e < dim; ++e)
          D[p][d][e] = number(engine);
      }
  const ContactJumps<dim> at_u   = B.evaluate(u);
  double                  work   = 0.;
  double                  energy = 0.;
  for (unsigned int p = 0; p < n; ++p)
    {
      work += forces[p] * at_u.jumps[p];
      energy += at_u.jumps[p] * (D[p] * at_u.jumps[p]);
    }
  Vector f(u), Ku(u);
  f = 0.;
  B.add_forces(B.forces(std::move(forces)), f);
  f.compress(VectorOperation::add);
  EXPECT_NEAR(f * u, work, 1e-12 * f.l2_norm() * u.l2_norm());

  DynamicSparsityPattern pattern(model.space->n_dofs());
  for (const auto &unknowns : B.couplings(std::vector<bool>(n, true)))
    for (const auto row : unknowns)
      pattern.add_entries(row, unknowns.begin(), unknowns.end());
  TrilinosWrappers::SparseMatrix K;
  K.reinit(pattern);
  B.add_stiffness(D, K);
  K.compress(VectorOperation::add);
  K.vmult(Ku, u);
  EXPECT_NEAR(u * Ku, energy, 1e-12 * Ku.l2_norm() * u.l2_norm());

  expect_couplings_of_a_group(B, n);

  const SparseRows rows = B.rows();
  ASSERT_EQ(rows.n_rows(), n * dim);
  for (std::size_t row = 0; row < rows.n_rows(); ++row)
    {
      double jump = 0.;
      for (std::size_t i = rows.begin[row]; i < rows.begin[row + 1]; ++i)
        jump += rows.values[i] * u(rows.columns[i]);
      EXPECT_NEAR(jump, at_u.jumps[row / dim][row % dim], 1e-12);
    }
}

std::vector<ContactPair>
one_pair()
{
  ContactPairParameters law;
  law.kind = &contact_law("frictionless");
  return {{0, 1, "lower-upper", law}};
}

TEST(JumpOperator, OfTheLevelSetSurface)
{
  for (const unsigned int degree : {1, 2})
    {
      const CutBodies<2> model(two_half_planes(0.3, 0.02, degree));
      check_adjoint(model, level_set_surface(*model.space, *model.level_set_nodes, model.bodies,
                                             one_pair(), 4. * model.grid.finest_size()));
    }
}

/** Contact between the nodes that both bodies have: no surface, no feet. */
ContactDiscretisation<2>
grid_nodes(const CutBodies<2> &model)
{
  const DisplacementSpace<2>              &space = *model.space;
  std::map<unsigned int, std::vector<int>> cells; // of the bodies 0 and 1 in a cell of the grid
  for (unsigned int a = 0; a < space.cells().size(); ++a)
    {
      auto &of_cell = cells[space.cells()[a].grid_cell];
      of_cell.resize(2, -1);
      of_cell[space.cells()[a].body] = a;
    }
  ContactDiscretisation<2>         result{{}, JumpOperator<2>(space, model.bodies, one_pair())};
  std::map<DofIndex, unsigned int> known;
  for (const auto &[c, of_cell] : cells)
    for (unsigned int i = 0; i < space.basis.n_nodes && of_cell[0] >= 0 && of_cell[1] >= 0; ++i)
      {
        const DofIndex a = space.nodes(of_cell[0])[i], b = space.nodes(of_cell[1])[i];
        if (!known.emplace(a, c).second)
          continue;
        const auto     &cell = model.grid.cells()[c];
        ContactPoint<2> point{0,
                              cell.lower + cell.size * Tensor<1, 2>(space.basis.node(i)),
                              Tensor<1, 2>({0., 1.}),
                              cell.size,
                              0.,
                              cell.size};
        result.jump_operator.append(point, {{a, {-1., -1.}}, {b, {1., 1.}}});
        result.points.push_back(point);
      }
  return result;
}

TEST(JumpOperator, OfGridNodes)
{
  const CutBodies<2> model(two_half_planes(0., 0., 1));
  check_adjoint(model, grid_nodes(model));
  // Laws and enforcement are the same.
  ContactPoints<2> contact(model.bodies, one_pair(), grid_nodes(model));
  const double     overlap = 1e-3;
  contact.evaluate(displacement<2>(model, contact,
                                   [&](const unsigned int body, const Point<2> &) {
                                     return Tensor<1, 2>({0., body == 0 ? 0. : -overlap});
                                   }),
                   contact.initial_history());
  for (unsigned int i = 0; i < contact.points().size(); ++i)
    {
      const double expected = overlap * contact.enforcement().stiffness()[i].normal;
      EXPECT_NEAR(contact.responses()[i].pressure, expected, 1e-10 * expected);
    }
}
} // namespace
} // namespace scree
