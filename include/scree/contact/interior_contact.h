#pragma once

#include <scree/contact/contact_points.h>

#include <vector>

namespace scree
{
/**
 * Contact as an interior-point method sees it: with the penalty eps (or k_n of the enforcement),
 * the gap g and a slack s of each point
 *
 *     s = g + p/eps,    p s = mu,    p, s > 0,
 *
 * which for mu = 0 is p = eps <-g>. While mu > 0 all points within a cell press, so that a step
 * knows what will close. Newton's method of this system, dp and ds eliminated, is
 *
 *     p + dp = p + c - k n.[[du]],    k = p/(s + p/eps),
 *     c = (mu - p s - p (g + p/eps - s))/(s + p/eps).
 *
 * Friction is that of the present pressure, by its secant: tau = f tau_t, of the stiffness f k_t,
 * f = min(1, b(p)/max(|tau_t|, k_t h/1000)), of all slides from the start of the step on.
 * (Mehrotra, SIAM J. Optim. 2, 1992, 575-601; Nocedal & Wright, Numerical Optimization, ch. 16.)
 */
template <int dim>
class InteriorContact
{
public:
  /** Of each point, times its weight: p n + tau on b, their change f - D [[du]] in a step du. */
  struct Tangent
  {
    std::vector<dealii::Tensor<1, dim>> forces;
    std::vector<dealii::Tensor<1, dim>> changes;   //!< f
    std::vector<dealii::Tensor<2, dim>> stiffness; //!< D
  };

  /**
   * Begins at the jumps of `contact` with the points that are near there, s = max(g, l) and
   * p = mu_0/s, mu_0 = 0.3 l^2 times the mean of E/L over the points, l the largest overlap, at
   * least a tenth of the largest cell.
   *
   * @param lengths L of each pair: half the size of the smaller body [L]
   */
  InteriorContact(ContactPoints<dim> &contact, const ContactHistory<dim> &history,
                  const std::vector<double> &lengths, const MPI_Comm communicator);

  /** Takes up the points that have come within a cell, with s = max(g, l) and p = mu/s, mu the mean
   * of p s; whether there are any (collective). */
  bool take_near();

  /** Those that were taken up. */
  std::vector<bool> taken() const;

  /** Mean of p s over their surface [force/L per area] (collective). */
  double complementarity() const;

  /** Largest |g + p/eps - s| [L] (collective). */
  double infeasibility() const;

  /** Of a step to p s = mu. */
  Tangent tangent(const double mu);

  /** The part of a step du at most 1 that keeps p, s > 0, of the last tangent(); `contact` has the
   * jumps of u + du (collective). */
  double step_length();

  /** p and s go the part alpha of the way; `contact` has the jumps of u + alpha du. */
  void advance(const double alpha);

private:
  /** The points that were taken up and those that are near, in ascending order. */
  std::vector<unsigned int> taken_or_near() const;
  /** Takes up those of `grown` that were not; their places in it, with s and p still to be set. */
  std::vector<unsigned int> take(std::vector<unsigned int> &&grown);
  /** s = max(g, l) and p = mu/s at these places. */
  void start(const std::vector<unsigned int> &places, const double mu);
  /** g, tau_t and stiffnesses at the jumps of `contact`. */
  void look();
  /** Whether a point bears traction as a spring whatever its gap. */
  bool is_spring(const unsigned int i) const
  {
    return contact.points()[i].is_glued;
  }
  /** f of the k-th point. */
  double friction_secant(const unsigned int k, const double bound) const;
  /** Whether it bears none. */
  bool is_idle(const unsigned int i) const;
  /** Whether it has a slack: neither of these. */
  bool has_slack(const unsigned int i) const
  {
    return !is_spring(i) && !is_idle(i);
  }

  ContactPoints<dim>        &contact;
  const ContactHistory<dim> &history;
  const MPI_Comm             communicator;
  double                     overlap = 0.; //!< l
  // What follows is of the points that were taken up.
  std::vector<unsigned int>       numbers;   //!< rising
  double                          area = 0.; //!< of all processes
  std::vector<TrialTraction<dim>> trials;
  std::vector<double>             gap, pressure, slack;
  std::vector<double>             constant, pressure_step, slack_step; //!< of the last tangent()
  std::vector<dealii::Tensor<1, dim>> old_jumps;                       //!< of all points, at it
};
} // namespace scree
