#include <scree/mechanics/body_holds.h>

#include <algorithm>

namespace scree
{
namespace
{
// The constants that body_holds.h documents.
constexpr double far      = 1.5;
constexpr double near     = 0.25;
constexpr double growth   = 10.;
constexpr double decrease = 0.3;
} // namespace

template <int dim>
BodyHolds<dim>::BodyHolds(const FreeBodies<dim> &free)
    : free(free)
{
  release();
}

template <int dim>
void
BodyHolds<dim>::release()
{
  factors.assign(free.motions().size(), 0.);
}

template <int dim>
bool
BodyHolds<dim>::are_any() const
{
  return std::any_of(factors.begin(), factors.end(), [](const double s) { return s > 0.; });
}

template <int dim>
bool
BodyHolds<dim>::adapt(const Vector &du, const double length, const double of_all)
{
  const std::vector<double> motions = free.largest_components(du),
                            loose   = free.of_not_held(motions, far * length);
  bool is_raised                    = false;
  for (unsigned int i = 0; i < factors.size(); ++i)
    if (loose[i] > 0.)
      {
        factors[i] = (factors[i] + of_all) * std::max(growth, loose[i] / length);
        is_raised  = true;
      }
  for (unsigned int i = 0; i < factors.size() && !is_raised; ++i)
    if (motions[i] < near * length)
      factors[i] = factors[i] > of_all ? decrease * factors[i] : 0.;
  return is_raised;
}

template <int dim>
void
BodyHolds<dim>::add_to(const Vector &mass, Matrix &matrix) const
{
  for (unsigned int i = 0; i < factors.size(); ++i)
    if (factors[i] > 0.)
      for (const DofIndex unknown : free.unknowns(i))
        matrix.add(unknown, unknown, factors[i] * mass(unknown));
}

template class BodyHolds<2>;
template class BodyHolds<3>;
} // namespace scree
