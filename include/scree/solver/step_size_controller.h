#pragma once

namespace scree
{
/** The estimated error of a step. */
struct StepError
{
  double       ratio = 0.; //!< to the tolerance
  unsigned int order = 1;  //!< it goes with this power of the step size
};

/**
 * The next step size by the error of the last ones: a PI controller (Gustafsson 1991; Hairer &
 * Wanner, Solving ODEs II, IV.2),
 *
 *     dt_{n+1}/dt_n = 0.9 r_n^{-0.7/p} r_{n-1}^{0.4/p},
 *
 * r the StepError::ratio of accepted steps, at least 0.1 as r_{n-1}, p the order. Steps become at
 * most twice as long, at least a fifth as long.
 */
class StepSizeController
{
public:
  /** dt_{n+1}/dt_n after an accepted step. */
  double accept(const StepError &error);

  /** The same if the step is to be done again: 0.9 r^{-1/p}, 0.9 at most. */
  static double reject(const StepError &error);

  /** r_{n-1}, which a run that is resumed needs. */
  double last_ratio() const
  {
    return ratio_before;
  }
  void set_last_ratio(const double ratio)
  {
    ratio_before = ratio;
  }

private:
  double ratio_before = 1.;
};
} // namespace scree
