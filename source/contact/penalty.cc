#include <scree/contact/penalty.h>

namespace scree
{
template <int dim>
std::vector<TrialTraction<dim>>
Penalty<dim>::trial_tractions(const std::vector<unsigned int>       &numbers,
                              const std::vector<ContactMotion<dim>> &motions,
                              const ContactHistory<dim>             &history) const
{
  std::vector<TrialTraction<dim>> result;
  result.reserve(numbers.size());
  for (unsigned int i = 0; i < numbers.size(); ++i)
    {
      const unsigned int        p      = numbers[i];
      const ContactMotion<dim> &motion = motions[i];
      const auto [eps_n, eps_t]        = penalties[p];
      const ClosedPart closed_part     = motion.closed_part(-motion.gap);
      result.push_back(
        {motion.is_glued ? history.pressure[p] - eps_n * motion.opening : -eps_n * motion.gap,
         history.tau[p] - eps_t * closed_part.value * motion.slide, eps_n, eps_t, closed_part});
    }
  return result;
}

template <int dim>
std::vector<double>
Penalty<dim>::stored_energy(const std::vector<double>                 &pressures,
                            const std::vector<dealii::Tensor<1, dim>> &tau) const
{
  std::vector<double> result;
  result.reserve(pressures.size());
  for (unsigned int p = 0; p < pressures.size(); ++p)
    result.push_back(0.5
                     * (pressures[p] * pressures[p] / penalties[p].normal
                        + tau[p].norm_square() / penalties[p].tangential));
  return result;
}

template <int dim>
std::vector<dealii::Tensor<1, dim>>
Penalty<dim>::elastic_slides(const std::vector<dealii::Tensor<1, dim>> &old_tau,
                             const std::vector<dealii::Tensor<1, dim>> &tau) const
{
  std::vector<dealii::Tensor<1, dim>> result;
  result.reserve(tau.size());
  for (unsigned int p = 0; p < tau.size(); ++p)
    result.push_back((old_tau[p] - tau[p]) / penalties[p].tangential);
  return result;
}

template class Penalty<2>;
template class Penalty<3>;
} // namespace scree
