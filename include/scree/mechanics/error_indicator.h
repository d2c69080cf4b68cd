#pragma once

#include <scree/mechanics/bulk.h>

#include <vector>

namespace scree
{
/**
 * The squared errors eta_K^2 = int_K (e* - e) : C : (e* - e) of the owned grid cells, summed over
 * the bodies in a cell, where e is the strain of the displacement and e* a recovered one, smoother
 * and more accurate (Zienkiewicz, Zhu, Int. J. Numer. Meth. Engng 33, 1992, 1331-1364).
 *
 * At each vertex of each body a polynomial of the degree k of the displacement is fitted to the
 * strains at the k^dim Gauss points of the cells of that body around it; in a cell, e* is the mean
 * of the polynomials of its vertices, weighted by the multilinear basis. Vertices with fewer than
 * 2^dim cells (at the boundary, hanging ones) count little, as their fits are poor. Strains of
 * different bodies are never mixed.
 *
 * @param u ghosted displacement
 */
template <int dim>
std::vector<double> recovery_errors(const DisplacementSpace<dim> &space,
                                    const CutQuadrature<dim>     &quadrature,
                                    const std::vector<Body<dim>> &bodies, const Bulk<dim> &bulk,
                                    const dealii::TrilinosWrappers::MPI::Vector &u);

/**
 * Which of the local values belong to the largest of all processes that together make up the
 * fraction `share` of the sum of all (Doerfler, SIAM J. Numer. Anal. 33, 1996, 1106-1124). Values
 * equal to the smallest of them up to 1e-6 are marked too, so that symmetric grids stay symmetric.
 */
std::vector<bool> largest_share(const std::vector<double> &values, const double share,
                                const MPI_Comm communicator);
} // namespace scree
