#pragma once

#include <scree/contact/contact_parameters.h>
#include <scree/contact/exact_distance.h>
#include <scree/discretization/displacement_space.h>

#include <array>
#include <string>
#include <vector>

namespace scree
{
/** Two bodies that may touch, a < b, and the law between them. */
struct ContactPair
{
  unsigned int          a, b;
  std::string           name; //!< "block-cylinder"
  ContactPairParameters law;
};

/** The body whose surface has a normal, turned to point from a to b. */
enum class NormalOf
{
  both,
  body_a,
  body_b
};

/** A point of contact between two bodies: on the surface between them, or a node of the grid. */
template <int dim>
struct ContactPoint
{
  unsigned int           pair;
  dealii::Point<dim>     position;
  dealii::Tensor<1, dim> normal;            //!< from a to b, in which gap and pressure are counted
  double                 weight;            //!< length or area
  double                 initial_gap;       //!< g_0 = phi_a + phi_b of degree k
  double                 cell_size;         //!< h of the penalties
  dealii::Tensor<1, dim> start_normal = {}; //!< of the surface at the start of a step
  double                 start_gap    = 0.; //!< phi_a + phi_b at the start of a step
  bool                   is_glued     = false; //!< of a tied pair, closed when the run began
  bool                   is_exact  = false; //!< near a kink or of least gap, from exact distances
  bool                   is_beyond = false; //!< an edge: the surfaces there do not face each other
  NormalOf               normal_of = NormalOf::both; //!< known from exact distances
  double                 stiffness_ratio = 1.;       //!< E'/E of bodies that flow
  /** x_a and x_b, where the displacements of a and b are taken. */
  std::array<dealii::Point<dim>, 2> feet    = {};
  bool                              is_node = false; //!< of the grid, which both bodies reach
  unsigned int cell = dealii::numbers::invalid_unsigned_int; //!< local one that the surface crosses
};

/**
 * The unbiased contact surface S = {phi_a = phi_b <= shift} of all pairs, cut from the background
 * cells of this process (theory.md section 8).
 *
 * @param shift bound on phi on the contact surface [L]
 * @param nodal_normals interpolates normals away from edges and corners from gradients at the
 * nodes, for surfaces that slide on a moving geometry; else they are those of contact_normal()
 */
template <int dim>
std::vector<ContactPoint<dim>>
contact_surface(const DisplacementSpace<dim> &space, const LevelSetNodes<dim> &level_set_nodes,
                const std::vector<Body<dim>> &bodies, const std::vector<ContactPair> &pairs,
                const double shift, const ExactDistances<dim> &distances, const bool nodal_normals);
} // namespace scree
