#pragma once

#include <scree/discretization/face_jumps.h>
#include <scree/discretization/small_cut_treatment.h>

namespace scree
{
/**
 * The ghost penalty gamma E rho s_h(u, v), s_h the jumps over faces of cut cells, E the stiffness
 * of the body and rho the smaller ratio of the two cells of a face: condition numbers do not depend
 * on the cut (Burman 2010; theory.md section 6).
 *
 * On moving bodies it acts on the jumps of R u_n + u. Those of u_n = x - X are the jumps of -X, a
 * map to where the body began, and the rotation R turns them to where it is: without it the forces
 * of a body that has turned by more than a right angle would drive its roughness instead of
 * smoothing it.
 */
template <int dim>
class GhostPenalty : public SmallCutTreatment<dim>
{
public:
  using typename SmallCutTreatment<dim>::Matrix;
  using typename SmallCutTreatment<dim>::Vector;

  /** @param factor gamma */
  GhostPenalty(const DisplacementSpace<dim> &space, const double factor);

  std::vector<std::vector<DofIndex>> couplings() const override;

  void add_to_matrix(const CutStiffness &stiffness, Matrix &matrix) const override;

  void add_start_forces(const CutStiffness &stiffness, const PointEvaluator<dim> &start,
                        Vector &forces) const override;

  double energy(const CutStiffness &stiffness, const PointEvaluator<dim> &start,
                const PointEvaluator<dim> &u) const override;

private:
  /** gamma E rho of a face. */
  double factor_of(const GhostFace &face, const CutStiffness &stiffness) const;

  /** R u_n at the nodes of a face's two cells, component by component; R is the rotation of the
   * polar decomposition of F at the middle of the face, by the mean grad u_n of the two. */
  std::vector<dealii::Vector<double>> carried(const GhostFace           &face,
                                              const PointEvaluator<dim> &start) const;

  const DisplacementSpace<dim> &space;
  const double                  gamma;
  const FaceJumps<dim>          jumps;
};
} // namespace scree
