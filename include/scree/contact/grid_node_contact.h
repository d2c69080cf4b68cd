#pragma once

#include <scree/contact/contact_discretisation.h>
#include <scree/contact/expected_slide.h>
#include <scree/contact/grid_node_parameters.h>

namespace scree
{
/**
 * Contact at the nodes I of the grid that both bodies of a pair reach: each has a cell there that
 * it fills or cuts (theory.md section 8; Chen et al. 2017). The jump is that of the two
 * displacements of the node, a rigid body moves with it as if the node were part of it. With
 * g = grad of the nodal volume
 *
 *     g^b_I = int_{Omega_b} grad N_I dV = int_{Gamma_b} N_I n dS,
 *
 * where the second form leaves out the faces of the background box, n_I is the direction of
 * rho_a g^a_I - rho_b g^b_I, without densities by default: collinear for both bodies, from a to b.
 * The nodal area is |g^a_I - g^b_I|/2; areas of a flat contact add up to its area. Gaps are
 * those of NodeGaps, or zero without the test of early contact. The basis is of
 * degree 1: functions of degree 2 are negative in parts, and so would be areas. Collective.
 *
 * @param prediction empty, or without the test of early contact: as at the start of the step
 * @param start_displacement see discretise_contact()
 * @param secant_ratios see discretise_contact()
 * @param start_gaps see discretise_contact()
 * @throws UserError if normals need a density that is missing, or a law the gaps beyond reach
 */
template <int dim>
ContactDiscretisation<dim>
grid_node_contact(const DisplacementSpace<dim> &space, const LevelSetNodes<dim> &level_set_nodes,
                  const std::vector<Body<dim>> &bodies, const std::vector<ContactPair> &pairs,
                  const GridNodeParameters                    &parameters,
                  const IncrementPrediction<dim>              &prediction         = {},
                  const dealii::TrilinosWrappers::MPI::Vector *start_displacement = nullptr,
                  const dealii::TrilinosWrappers::MPI::Vector *secant_ratios      = nullptr,
                  StartGaps                                   *start_gaps         = nullptr);
} // namespace scree
