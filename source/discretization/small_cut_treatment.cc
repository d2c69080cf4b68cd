#include <scree/discretization/ghost_penalty.h>

namespace scree
{
template <int dim>
std::vector<std::vector<DofIndex>>
NoSmallCutTreatment<dim>::couplings() const
{
  return {};
}

template <int dim>
void
NoSmallCutTreatment<dim>::add_to_matrix(const CutStiffness &, Matrix &) const
{
}

template <int dim>
void
NoSmallCutTreatment<dim>::add_start_forces(const CutStiffness &, const PointEvaluator<dim> &,
                                           Vector &) const
{
}

template <int dim>
double
NoSmallCutTreatment<dim>::energy(const CutStiffness &, const PointEvaluator<dim> &,
                                 const PointEvaluator<dim> &) const
{
  return 0.;
}

template <int dim>
std::unique_ptr<const SmallCutTreatment<dim>>
make_small_cut_treatment(const DisplacementSpace<dim> &space, const double ghost_penalty_factor)
{
  if (ghost_penalty_factor == 0.)
    return std::make_unique<NoSmallCutTreatment<dim>>();
  return std::make_unique<GhostPenalty<dim>>(space, ghost_penalty_factor);
}

#define SCREE_INSTANTIATE(dim)                                                     \
  template class NoSmallCutTreatment<dim>;                                         \
  template std::unique_ptr<const SmallCutTreatment<dim>> make_small_cut_treatment( \
    const DisplacementSpace<dim> &, const double);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
