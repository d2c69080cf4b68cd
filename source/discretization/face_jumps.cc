#include <scree/discretization/face_jumps.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace scree
{
template <int dim>
FaceJumps<dim>::FaceJumps(const DisplacementSpace<dim> &space)
    : space(space)
{
  const auto &grid = space.grid;
  for (unsigned int a = 0; a < space.n_owned_cells(); ++a)
    {
      const ActiveCell &active   = space.cells()[a];
      const auto       &iterator = grid.cells()[active.grid_cell].iterator;
      for (const unsigned int f : iterator->face_indices())
        {
          if (iterator->at_boundary(f) || iterator->neighbor(f)->has_children())
            continue; // finer neighbours integrate the face themselves
          const auto other    = iterator->neighbor(f);
          const int  neighbor = space.active_cell(grid.local_index(*other), active.body);
          if (neighbor < 0 || !(active.is_cut || space.cells()[neighbor].is_cut))
            continue;
          if (!iterator->neighbor_is_coarser(f))
            {
              // Equal cells: the first of two owned ones, or the process of lower rank.
              const bool is_mine = other->is_locally_owned()
                                     ? int(a) < neighbor
                                     : iterator->subdomain_id() < other->subdomain_id();
              if (!is_mine)
                continue;
            }
          ghost_faces.push_back({a, static_cast<unsigned int>(neighbor), f});
        }
    }
}

template <int dim>
dealii::FullMatrix<double>
FaceJumps<dim>::matrix(const GhostFace &face) const
{
  const auto &cell     = space.grid.cells()[space.cells()[face.cell].grid_cell];
  const auto &neighbor = space.grid.cells()[space.cells()[face.neighbor].grid_cell];
  // Position of the cell in units of its edge, relative to the neighbour.
  const dealii::Tensor<1, dim> offset = (cell.lower - neighbor.lower) / cell.size;
  const double                 ratio  = neighbor.size / cell.size;
  unsigned int                 code   = ratio > 1.5 ? 1 : 0;
  for (unsigned int d = 0; d < dim; ++d)
    if (d != face.face / 2)
      code = 2 * code + (offset[d] > 0.5 ? 1 : 0);
  auto found = unit_matrices.find({face.face, code});
  if (found == unit_matrices.end())
    found = unit_matrices
              .emplace(std::make_pair(face.face, code), unit_matrix(face.face, offset, ratio))
              .first;
  dealii::FullMatrix<double> result = found->second;
  result *= std::pow(cell.size, dim - 2);
  return result;
}

template <int dim>
typename FaceJumps<dim>::Block
FaceJumps<dim>::block(const GhostFace &face) const
{
  const unsigned int        n     = space.basis.n_nodes;
  const auto                jumps = matrix(face);
  Block                     result;
  std::vector<unsigned int> position(2 * n);
  result.nodes.assign(space.nodes(face.cell), space.nodes(face.cell) + n);
  for (unsigned int i = 0; i < 2 * n; ++i)
    {
      const DofIndex node  = i < n ? space.nodes(face.cell)[i] : space.nodes(face.neighbor)[i - n];
      const auto     found = std::find(result.nodes.begin(), result.nodes.end(), node);
      position[i]          = found - result.nodes.begin();
      if (found == result.nodes.end())
        result.nodes.push_back(node);
    }
  result.matrix.reinit(result.nodes.size(), result.nodes.size());
  for (unsigned int i = 0; i < 2 * n; ++i)
    for (unsigned int j = 0; j < 2 * n; ++j)
      result.matrix(position[i], position[j]) += jumps(i, j);
  return result;
}

template <int dim>
dealii::FullMatrix<double>
FaceJumps<dim>::unit_matrix(const unsigned int face, const dealii::Tensor<1, dim> &offset,
                            const double ratio) const
{
  const auto                      &basis     = space.basis;
  const unsigned int               direction = face / 2;
  const unsigned int               n         = basis.n_nodes;
  const dealii::QGauss<dim - 1>    gauss(basis.degree + 1);
  dealii::FullMatrix<double>       result(2 * n, 2 * n);
  ShapeValues<dim>                 shape;
  std::vector<std::vector<double>> jump(2, std::vector<double>(2 * n));
  for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      dealii::Point<dim> here;
      here[direction] = face % 2;
      for (unsigned int d = 0, i = 0; d < dim; ++d)
        if (d != direction)
          here[d] = gauss.point(q)[i++];
      const dealii::Point<dim> there((here + offset) / ratio);
      basis.evaluate(here, shape);
      for (unsigned int i = 0; i < n; ++i)
        {
          jump[0][i] = shape.gradient[i][direction];
          jump[1][i] = shape.hessian[i][direction][direction];
        }
      basis.evaluate(there, shape);
      for (unsigned int i = 0; i < n; ++i)
        {
          jump[0][n + i] = -shape.gradient[i][direction] / ratio;
          jump[1][n + i] = -shape.hessian[i][direction][direction] / (ratio * ratio);
        }
      for (unsigned int order = 0; order < basis.degree; ++order)
        for (unsigned int i = 0; i < 2 * n; ++i)
          for (unsigned int j = 0; j < 2 * n; ++j)
            result(i, j)
              += (order == 0 ? 1. : 0.25) * gauss.weight(q) * jump[order][i] * jump[order][j];
    }
  return result;
}

template class FaceJumps<2>;
template class FaceJumps<3>;
} // namespace scree
