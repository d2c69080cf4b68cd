#pragma once

#include <scree/discretization/displacement_space.h>

#include <deal.II/lac/full_matrix.h>

#include <map>
#include <vector>

namespace scree
{
/** A face of a cut cell shared with another active cell of the same body, seen from the finer cell.
 */
struct GhostFace
{
  unsigned int cell;     //!< active cell, never coarser than the neighbour
  unsigned int neighbor; //!< active cell
  unsigned int face;     //!< of `cell`, in deal.II's order x-, x+, y-, ...
};

/**
 * Jumps of normal derivatives over the faces of cut cells, s_h(w, v) = sum_F sum_j c_j int_F
 * h^(2j-1) [d_n^j w].[d_n^j v], j = 1..k, c_1 = 1, c_2 = 1/4, h the edge of the finer cell (Burman
 * 2010; theory.md section 6). Polynomials of degree k have none.
 */
template <int dim>
class FaceJumps
{
public:
  explicit FaceJumps(const DisplacementSpace<dim> &space);

  /** The faces that this process integrates, each once over all processes. */
  const std::vector<GhostFace> &faces() const
  {
    return ghost_faces;
  }

  /**
   * The matrix of a face for one displacement component; first the nodes of the cell, then those
   * of the neighbour.
   */
  dealii::FullMatrix<double> matrix(const GhostFace &face) const;

  /** The same on the distinct nodes of the two cells. */
  struct Block
  {
    std::vector<DofIndex>      nodes;
    dealii::FullMatrix<double> matrix;
  };
  Block block(const GhostFace &face) const;

private:
  dealii::FullMatrix<double> unit_matrix(const unsigned int            face,
                                         const dealii::Tensor<1, dim> &offset,
                                         const double                  ratio) const;

  const DisplacementSpace<dim> &space;
  std::vector<GhostFace>        ghost_faces;
  /** Matrices for unit cell edge by (face, position in a coarser neighbour). */
  mutable std::map<std::pair<unsigned int, unsigned int>, dealii::FullMatrix<double>> unit_matrices;
};
} // namespace scree
