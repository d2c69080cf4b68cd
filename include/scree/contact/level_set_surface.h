#pragma once

#include <scree/contact/contact_discretisation.h>
#include <scree/contact/expected_slide.h>

namespace scree
{
/**
 * Discretises contact by the unbiased surface S = {phi_a = phi_b <= shift} of every candidate pair,
 * cut from the background cells (theory.md section 8). A process has the points of its cells.
 *
 * On bodies that slide, x_a and x_b are the points that are expected to meet in the middle of the
 * step: with the jump d that a prediction tells, P = I - n n^T, they are the projections of
 * x + P d/2 and x - P d/2. Then g_0 + n.[[u]] is the gap at the end to second order in d; with
 * d = 0 it misses kappa d^2/2 for surfaces of curvature kappa that touch all along. Tractions act
 * where the bodies are at the end, with normal n': the gap is g_0 + n.d + n'.([[u]] - d), so that
 * g_0 + (n - n').d is stored as the initial gap. With n the force of a dragged tool would be wrong
 * by kappa d/2 times its normal force.
 *
 * The gap at the start of the run, which decides what is glued and what Adjust takes off, is that
 * of the initial level sets at x - u_n, u_n taken at x_a and x_b. It belongs to the material, so
 * nothing needs to be remembered.
 *
 * @param shift bound on phi on the contact surface [L]
 * @param prediction empty: no sliding is expected
 * @param start_displacement u_n of the deformable bodies at the owned unknowns; null: zero
 * @param secant_ratios of plastic flow at the first unknown of each owned node; null: one
 * @param start_gaps see discretise_contact()
 * @throws UserError if the contact surface ends before the gaps that a law adjusts or glues
 */
template <int dim>
ContactDiscretisation<dim>
level_set_surface(const DisplacementSpace<dim> &space, const LevelSetNodes<dim> &level_set_nodes,
                  const std::vector<Body<dim>> &bodies, const std::vector<ContactPair> &pairs,
                  const double shift, const IncrementPrediction<dim> &prediction = {},
                  const dealii::TrilinosWrappers::MPI::Vector *start_displacement = nullptr,
                  const dealii::TrilinosWrappers::MPI::Vector *secant_ratios      = nullptr,
                  StartGaps                                   *start_gaps         = nullptr);
} // namespace scree
