#pragma once

#include <scree/discretization/face_jumps.h>
#include <scree/discretization/small_cut_treatment.h>

namespace scree
{
/**
 * The ghost penalty gamma E rho s_h(u, v), s_h the jumps over faces of cut cells, E the stiffness
 * of the body and rho the smaller ratio of the two cells of a face: condition numbers do not depend
 * on the cut (Burman 2010; theory.md section 6).
 */
template <int dim>
class GhostPenalty : public SmallCutTreatment<dim>
{
public:
  using typename SmallCutTreatment<dim>::Matrix;

  /** @param factor gamma */
  GhostPenalty(const DisplacementSpace<dim> &space, const double factor);

  std::vector<std::vector<DofIndex>> couplings() const override;

  void add_to_matrix(const CutStiffness &stiffness, Matrix &matrix) const override;

  double energy(const CutStiffness &stiffness, const PointEvaluator<dim> &u) const override;

private:
  /** gamma E rho of a face. */
  double factor_of(const GhostFace &face, const CutStiffness &stiffness) const;

  const DisplacementSpace<dim> &space;
  const double                  gamma;
  const FaceJumps<dim>          jumps;
};
} // namespace scree
