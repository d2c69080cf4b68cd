#include <scree/solver/step_size_controller.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace scree
{
namespace
{
constexpr double safety = 0.9, largest_growth = 2., smallest = 0.2;
constexpr double integral = 0.7, proportional = 0.4; // exponents times the order
constexpr double least_ratio = 0.1;
} // namespace

double
StepSizeController::accept(const StepError &error)
{
  const double p      = error.order;
  const double before = std::exchange(ratio_before, std::max(error.ratio, least_ratio));
  if (error.ratio == 0.)
    return largest_growth;
  const double factor
    = safety * std::pow(error.ratio, -integral / p) * std::pow(before, proportional / p);
  return std::clamp(factor, smallest, largest_growth);
}

double
StepSizeController::reject(const StepError &error)
{
  return std::clamp(safety * std::pow(error.ratio, -1. / error.order), smallest, safety);
}
} // namespace scree
