#pragma once

#include <scree/solver/linear_solver.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

#include <map>
#include <vector>

namespace scree
{
namespace test
{
using namespace dealii;
using Vector = LinearSolver::Vector;
using Matrix = LinearSolver::Matrix;

/** The unit square under its weight, with its boundary held or free; lambda = mu = modulus. */
struct Square
{
  Square(const unsigned int level, const bool held, const MPI_Comm communicator,
         const double modulus = 1)
      : triangulation(communicator)
      , fe(FE_Q<2>(1), 2)
      , dof_handler(triangulation)
  {
    GridGenerator::hyper_cube(triangulation);
    triangulation.refine_global(level);
    dof_handler.distribute_dofs(fe);
    const IndexSet owned = dof_handler.locally_owned_dofs();
    IndexSet       relevant;
    DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);
    AffineConstraints<double> constraints(relevant);
    if (held)
      DoFTools::make_zero_boundary_constraints(dof_handler, 0, constraints);
    constraints.close();
    DynamicSparsityPattern pattern(relevant);
    DoFTools::make_sparsity_pattern(dof_handler, pattern, constraints, false);
    SparsityTools::distribute_sparsity_pattern(pattern, owned, communicator, relevant);
    matrix.reinit(owned, owned, pattern, communicator);
    x.reinit(owned, communicator);
    b.reinit(owned, communicator);
    assemble(constraints, modulus);
  }

  void assemble(const AffineConstraints<double> &constraints, const double modulus)
  {
    FEValues<2> fe_values(fe, QGauss<2>(2), update_values | update_gradients | update_JxW_values);
    const unsigned int               n = fe.dofs_per_cell;
    const FEValuesExtractors::Vector displacement(0);
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          fe_values.reinit(cell);
          FullMatrix<double>     cell_matrix(n, n);
          dealii::Vector<double> cell_vector(n);
          for (const unsigned int q : fe_values.quadrature_point_indices())
            for (unsigned int i = 0; i < n; ++i)
              {
                const auto eps_i = fe_values[displacement].symmetric_gradient(i, q);
                for (unsigned int j = 0; j < n; ++j)
                  {
                    const auto eps_j = fe_values[displacement].symmetric_gradient(j, q);
                    cell_matrix(i, j) += modulus
                                         * (trace(eps_i) * trace(eps_j) + 2 * (eps_i * eps_j))
                                         * fe_values.JxW(q);
                  }
                cell_vector(i) -= fe_values[displacement].value(i, q)[1] * fe_values.JxW(q);
              }
          std::vector<types::global_dof_index> indices(n);
          cell->get_dof_indices(indices);
          constraints.distribute_local_to_global(cell_matrix, cell_vector, indices, matrix, b);
        }
    matrix.compress(VectorOperation::add);
    b.compress(VectorOperation::add);
  }

  /** Translations and rotation. */
  std::vector<Vector> rigid_motions() const
  {
    std::map<types::global_dof_index, Point<2>> points;
    DoFTools::map_dofs_to_support_points(MappingQ1<2>(), dof_handler, points);
    std::vector<Vector> modes(3, x);
    const IndexSet      vertical
      = DoFTools::extract_dofs(dof_handler, fe.component_mask(FEValuesExtractors::Scalar(1)));
    for (const auto i : x.locally_owned_elements())
      {
        const bool is_y = vertical.is_element(i);
        modes[0](i)     = is_y ? 0 : 1;
        modes[1](i)     = is_y ? 1 : 0;
        modes[2](i)     = is_y ? points.at(i)[0] : -points.at(i)[1];
      }
    for (auto &mode : modes)
      mode.compress(VectorOperation::insert);
    return modes;
  }

  parallel::distributed::Triangulation<2> triangulation;
  FESystem<2>                             fe;
  DoFHandler<2>                           dof_handler;
  Matrix                                  matrix;
  Vector                                  x, b;
};
} // namespace test
} // namespace scree
