#pragma once

#include <scree/mechanics/equilibrium.h>
#include <scree/mechanics/velocity_field.h>
#include <scree/output/body_fields.h>

#include <string>
#include <vector>

namespace scree
{
/**
 * Writes the bodies as VTU (with PVTU record on several processes): only the physical part of cut
 * cells, as triangles or tetrahedra of the contour's linear interpolation, with BodyFields. On a
 * fixed geometry they are undeformed (ParaView: Warp By Vector), on a moving one they are where
 * they are at the end of the step: the field datum points_are_moved is 0 or 1, TimeValue the time,
 * body.NAME the number of each body. Rigid bodies come whole, from a coarse lattice with
 * exact edges and corners, without stress; the first process writes them.
 */
template <int dim>
class BodyOutput
{
public:
  BodyOutput(const DisplacementSpace<dim> &space, const LevelSetNodes<dim> &level_set_nodes,
             const std::vector<Body<dim>> &bodies, const FieldParameters &parameters = {});

  /**
   * Writes DIR/bodies_NNNN.vtu or .pvtu of a time, see write_vtu_files(). `u` is ghosted.
   *
   * @param velocities null without inertia
   */
  std::string write(const Kinematics<dim>                       &kinematics,
                    const dealii::TrilinosWrappers::MPI::Vector &u,
                    const VelocityField<dim> *velocities, const std::string &directory,
                    const unsigned int number, const double time) const;

  /**
   * A piece of a cell: a whole cell, or a simplex of positive orientation; vertices in unit
   * coordinates.
   */
  struct Piece
  {
    unsigned int                    active_cell;
    std::vector<dealii::Point<dim>> vertices;
  };

  /** What is written, on this process. */
  const std::vector<Piece> &pieces() const
  {
    return body_pieces;
  }

private:
  /** A piece of a rigid body, vertices in initial coordinates. */
  struct RigidPiece
  {
    unsigned int                    body;
    std::vector<dealii::Point<dim>> vertices;
  };

  void cut_cell(const unsigned int active_cell, const LagrangeBasis<dim> &basis,
                const std::array<double, max_nodes_per_cell<dim>> &phi);
  /** Of all rigid bodies, on the first process. */
  std::vector<RigidPiece> cut_rigid_bodies() const;
  void cut_rigid_body(const unsigned int body, std::vector<RigidPiece> &pieces) const;
  /** What of a cell of the lattice of a rigid body lies inside. */
  void cut_rigid_cell(const unsigned int body, const std::vector<dealii::Point<dim>> &corners,
                      const std::vector<double> &phi, std::vector<RigidPiece> &pieces) const;

  const DisplacementSpace<dim> &space;
  const std::vector<Body<dim>> &bodies;
  const FieldParameters         parameters;
  std::vector<Piece>            body_pieces;
};
} // namespace scree
