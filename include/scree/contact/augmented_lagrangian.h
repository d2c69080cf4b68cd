#pragma once

#include <scree/contact/enforcement.h>
#include <scree/contact/enforcement_parameters.h>
#include <scree/contact/multiplier_field.h>

#include <array>

namespace scree
{
/**
 * Multipliers lambda = lambda_n n + lambda_t, a MultiplierField each, and penalties eps_n, eps_t
 * (theory.md section 8; Simo & Laursen 1992; Chen et al. 2017, section 4.3):
 *
 *     p_t = lambda_n - eps_n g, of glued points lambda_n - eps_n n.([[u]] - [[u]]_n),
 *     tau_t = lambda_t - eps_t f P ([[u]] - [[u]]_n).
 *
 * In each equilibrium lambda <- p n + tau (Uzawa), until the mean gap of closed points is zero near
 * each node, and so is the mean slide of those that stick. Open points have none, whatever the
 * field is there: beyond the edge of contact it would press what comes near. A point that opens
 * loses its multiplier, but only once in a step, else those at the edge would open and close in
 * turns. Gaps in between are of higher order in h. Points that close in a step have no lambda_t
 * yet: what slid before they closed is not to be undone. A step starts with the tractions at the
 * end of the last one. If an update does not make the means four times smaller, the penalties of
 * the rest of the step grow. Nothing is stored. Grid nodes with less than a twentieth of the area
 * of a cell's face keep their penalty and have no multiplier, which it would hardly move.
 */
template <int dim>
class AugmentedLagrangian : public Enforcement<dim>
{
public:
  /** Of these points, in their order (collective). */
  AugmentedLagrangian(const std::vector<ContactStiffness>  &penalties,
                      const std::vector<ContactPoint<dim>> &points,
                      const EnforcementParameters &parameters, const MPI_Comm communicator);

  std::vector<TrialTraction<dim>>
  trial_tractions(const std::vector<unsigned int>       &numbers,
                  const std::vector<ContactMotion<dim>> &motions,
                  const ContactHistory<dim>             &history) const override;

  std::vector<double> stored_energy(const std::vector<double> &pressures,
                                    const std::vector<dealii::Tensor<1, dim>> &) const override
  {
    return std::vector<double>(pressures.size());
  }

  std::vector<dealii::Tensor<1, dim>>
  elastic_slides(const std::vector<dealii::Tensor<1, dim>> &,
                 const std::vector<dealii::Tensor<1, dim>> &tau) const override
  {
    return std::vector<dealii::Tensor<1, dim>>(tau.size());
  }

  bool may_press_apart(const unsigned int point) const override
  {
    return points[point].has_multiplier;
  }

  void start_step(const ContactHistory<dim> &history) override;

  bool update(const std::vector<ContactResponse<dim>> &responses) override;

private:
  using Enforcement<dim>::penalties;

  /** What a point needs in an update. */
  struct Point
  {
    dealii::Tensor<1, dim> normal;
    double                 initial_gap, cell_size; //!< [L]
    bool                   may_have_multiplier;
    bool                   is_closed_at_start = true; //!< of the step: has a lambda_t
    bool                   has_multiplier     = false;
    bool                   has_opened         = false; //!< in this step, after it had one
  };

  /** lambda at a point, 0 where it has none. */
  dealii::Tensor<1, dim> multiplier(const unsigned int point) const;
  /** Decides which points have multipliers after an equilibrium. */
  void choose_points(const std::vector<ContactResponse<dim>> &responses);
  /** Whether points have multipliers; whether they have tangential ones. */
  std::array<std::vector<bool>, 2> masks() const;
  /** The normal and the tangential parts of vectors at the points. */
  std::array<std::vector<dealii::Tensor<1, dim>>, 2>
  parts(const std::vector<dealii::Tensor<1, dim>> &vectors) const;

  void stiffen(const double factor);

  const EnforcementParameters parameters;
  std::vector<Point>          points;
  MultiplierField<dim>        normal, tangential; //!< lambda_n n, lambda_t
  double                      last_mean = 0.;     //!< gap or slide, in cells
  double                      growth    = 1.;     //!< of the penalties in this step
};
} // namespace scree
