#pragma once

#include <scree/contact/contact_history.h>
#include <scree/contact/contact_response.h>
#include <scree/contact/contact_surface.h>
#include <scree/contact/enforcement.h>

#include <vector>

namespace scree
{
/**
 * The laws between all pairs, and what the solver changes in them for a while. Points are given by
 * their numbers, those of a pair one after the other: each law is asked once for all of them.
 */
template <int dim>
class ContactLaws
{
public:
  explicit ContactLaws(const std::vector<ContactPair> &pairs)
      : of_pairs(pairs)
  {
  }

  const std::vector<ContactPair> &pairs() const
  {
    return of_pairs;
  }

  /**
   * Whether points that touch without pressure, gaps from 0 to 1e-8 h, count as closed in the
   * tangent: so a body that touches without load is held before anything has moved.
   */
  void set_touching_holds(const bool holds)
  {
    touching_holds = holds;
  }

  /**
   * Resolves initial overlap: no friction until the next call, but what is tied stays tied, and the
   * gaps of each pair are larger by its allowance [L]. Empty: friction again, and no allowance.
   */
  void resolve_overlap(const std::vector<double> &allowances)
  {
    pair_allowances = allowances;
  }

  /** Whether what can slide with friction sticks for a while, whatever its pressure. */
  void set_sticks(const bool sticks)
  {
    all_stick = sticks;
  }

  /** Whether there is something that set_sticks() changes. */
  bool have_friction() const;

  /** Keeps the bounds b(p) and the f of these responses of all points until unfreeze(). */
  void freeze(const std::vector<ContactPoint<dim>>    &points,
              const std::vector<ContactResponse<dim>> &responses);
  void unfreeze();

  /** How the bodies move at the points when the jumps there are these. */
  std::vector<ContactMotion<dim>> motions(const std::vector<ContactPoint<dim>>      &points,
                                          const std::vector<unsigned int>           &numbers,
                                          const std::vector<dealii::Tensor<1, dim>> &jumps,
                                          const ContactHistory<dim>                 &history) const;

  /** Gaps beyond it are open but for multipliers and laws with b(0) > 0 [cells]. */
  static constexpr double surely_open = 1e-6;

  /**
   * The numbers of the points that may not be open, in ascending order: without those surely_open.
   *
   * @param jumps of all points
   */
  std::vector<unsigned int> acting(const std::vector<ContactPoint<dim>>      &points,
                                   const std::vector<dealii::Tensor<1, dim>> &jumps,
                                   const Enforcement<dim>                    &enforcement) const;

  /** What the laws make of trial tractions. */
  std::vector<ContactResponse<dim>> respond(const std::vector<ContactPoint<dim>>  &points,
                                            const std::vector<unsigned int>       &numbers,
                                            const std::vector<ContactMotion<dim>> &motions,
                                            const std::vector<TrialTraction<dim>> &trials) const;

  /** The b of points under these pressures >= 0; what is frozen does not count. */
  std::vector<FrictionBound> bounds(const std::vector<ContactPoint<dim>> &points,
                                    const std::vector<unsigned int>      &numbers,
                                    const std::vector<double>            &pressures) const;

private:
  /** The law that acts between a pair now. */
  const ContactLaw &acting_law(const unsigned int pair) const;

  std::vector<ContactPair> of_pairs;
  std::vector<double>      pair_allowances; //!< while overlap is resolved
  bool                     touching_holds = true;
  bool                     all_stick      = false;
  std::vector<double>      frozen_bounds, frozen_closed_parts; //!< of points; empty: not frozen
};
} // namespace scree
