#pragma once

#include <scree/output/assembly_region.h>
#include <scree/output/grain_states.h>

#include <string>
#include <vector>

namespace scree
{
/**
 * The deformable bodies of a step as an assembly of grains between the rigid ones, its walls. Of
 * the closed contacts those count that carry more than 1e-6 of their mean force. With contacts c of
 * normal n, force f on b, branch l from centroid to centroid (at a wall: to the place of the
 * contact), in a region of volume V (doc/results.md):
 *
 *     stress         1/V sum_grains int sigma
 *     force_stress   -1/V sym sum_c f l^T                     (Bagi 1996)
 *     fabric         1/N sum_c n n^T between grains           (Satake 1982)
 *     force_fabric   sum_c f_n n n^T / sum_c f_n of the same
 */
template <int dim>
struct Assembly
{
  AssemblyRegion<dim>             region;
  unsigned int                    n_grains = 0, n_rattlers = 0; //!< without or with one contact
  unsigned int                    n_contacts = 0, n_wall_contacts = 0;
  double                          coordination = 0., mechanical_coordination = 0.;
  double                          solid_fraction = 0.;
  dealii::SymmetricTensor<2, dim> stress, force_stress; //!< tension positive [force/area]
  double                          p = 0.;               //!< -tr(force_stress)/dim [force/area]
  double                          q = 0.; //!< of force_stress: 2D (s_1 - s_2)/2, 3D von Mises
  dealii::SymmetricTensor<2, dim> fabric, force_fabric; //!< of trace 1; zero without contacts
  double mobilised_friction = 0.; //!< sum |f_t| / sum mu f_n where mu > 0 is finite, else 0

  Assembly(const AssemblyRegion<dim> &region, const std::vector<Body<dim>> &bodies,
           const std::vector<ContactPair> &pairs, const std::vector<ContactSummary<dim>> &summaries,
           const std::vector<GrainState<dim>> &grains);

  /** Of values(). */
  static std::vector<std::string> columns();
  std::vector<double>             values() const;

private:
  void add_grains(const std::vector<Body<dim>> &bodies, const std::vector<GrainState<dim>> &grains,
                  const std::vector<unsigned int> &contacts_of_body);
  void set_invariants();
};
} // namespace scree
