#include <scree/level_set/closest_point.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree
{
using namespace dealii;

namespace
{
// (I + lambda P H P)^{-1} r for the tangential vector r, or r where that matrix is not safely
// positive definite.
template <int dim>
Tensor<1, dim>
tangential_step(const LevelSetExpansion<dim> &phi, const double lambda,
                const Tensor<1, dim> &normal, const Tensor<1, dim> &r)
{
  Tensor<2, dim> tangential = unit_symmetric_tensor<dim>();
  tangential -= outer_product(normal, normal);
  Tensor<2, dim> matrix = unit_symmetric_tensor<dim>();
  matrix += lambda * tangential * Tensor<2, dim>(phi.hessian) * tangential;
  if (determinant(matrix) < 0.1)
    return r;
  const Tensor<1, dim> step = invert(matrix) * r;
  return step * r > 0 && step.norm_square() < 16 * r.norm_square() ? step : r;
}

// A distance of `fraction` spacings, or what rounding of the coordinates leaves of it.
template <int dim>
double
normal_tolerance(const Lattice<dim> &lattice, const double fraction)
{
  const auto &[lower, upper] = lattice.box().get_boundary_points();
  const double rounding      = 8 * std::numeric_limits<double>::epsilon();
  return std::max(fraction * lattice.spacing(), rounding * std::max(lower.norm(), upper.norm()));
}

// Plain gradient projection from `start`.
template <int dim>
ClosestPoint<dim>
project_from(const Lattice<dim> &lattice, const unsigned int degree, const Point<dim> &start)
{
  constexpr unsigned int max_iterations = 20;
  const double           tolerance      = normal_tolerance(lattice, 1e-13);

  ClosestPoint<dim> result{start, {}, false};
  for (unsigned int iteration = 0; iteration <= max_iterations; ++iteration)
    {
      const auto [value, gradient] = lattice.value_and_gradient(result.point, degree);
      const double norm            = gradient.norm();
      if (!(norm > 0))
        return result;
      result.normal    = gradient / norm;
      result.converged = std::abs(value) < tolerance * norm;
      if (result.converged)
        return result;
      result.point -= value / norm * result.normal;
    }
  return result;
}

// What the search sees at a point y: the normal step to the contour, and the tangential Newton step
// towards the foot of x.
template <int dim>
struct Steps
{
  Steps(const Lattice<dim> &lattice, const unsigned int degree, const Point<dim> &x,
        const Point<dim> &y)
  {
    const LevelSetExpansion<dim> phi  = lattice.expansion(y, degree);
    const double                 norm = phi.gradient.norm();
    valid                             = norm > 0;
    if (!valid)
      return;
    normal                        = phi.gradient / norm;
    to_contour                    = -phi.value / norm;
    const Tensor<1, dim> offset   = x - y;
    const double         distance = offset * normal;
    const Tensor<1, dim> r        = offset - distance * normal;
    residual                      = r.norm();
    // The distance that remains once y is on the contour goes with the curvature.
    tangential = tangential_step(phi, (distance - to_contour) / norm, normal, r);
  }

  bool           valid;
  Tensor<1, dim> normal, tangential;
  double         to_contour = 0., residual = 0.;
};

constexpr double tangential_tolerance = 1e-8; // spacings

// Newton's method without safeguards except for the length of a step: a few iterations on smooth
// data.
template <int dim>
ClosestPoint<dim>
newton_search(const Lattice<dim> &lattice, const Point<dim> &x, const unsigned int degree,
              const Point<dim> &start)
{
  constexpr unsigned int max_iterations = 12;
  const double           spacing        = lattice.spacing();
  const double           tolerance      = normal_tolerance(lattice, 1e-12);

  ClosestPoint<dim> result{start, {}, false};
  for (unsigned int iteration = 0; iteration < max_iterations; ++iteration)
    {
      const Steps<dim> steps(lattice, degree, x, result.point);
      if (!steps.valid)
        break;
      result.normal = steps.normal;
      if (std::abs(steps.to_contour) < tolerance && steps.residual < tangential_tolerance * spacing)
        {
          result.converged = true;
          break;
        }
      Tensor<1, dim> step  = steps.to_contour * steps.normal + steps.tangential;
      const double   limit = 2 * std::max(spacing, std::abs(steps.to_contour));
      if (step.norm() > limit)
        step *= limit / step.norm();
      result.point += step;
    }
  return result;
}

// Descent along the contour: tangential steps, projected, that are halved until the distance falls.
// Ends at kinks too.
template <int dim>
ClosestPoint<dim>
descent_search(const Lattice<dim> &lattice, const Point<dim> &x, const unsigned int degree,
               const Point<dim> &start)
{
  constexpr unsigned int max_iterations = 200;
  const double           tolerance      = tangential_tolerance * lattice.spacing();

  ClosestPoint<dim> result = project_from(lattice, degree, start);
  if (!result.converged)
    return result;
  result.converged = false;
  Steps<dim> steps(lattice, degree, x, result.point);
  double     factor = 1;
  for (unsigned int iteration = 0; iteration < max_iterations; ++iteration)
    {
      if (factor * steps.residual < tolerance)
        {
          result.converged = true;
          break;
        }
      const ClosestPoint<dim> trial
        = project_from(lattice, degree, Point<dim>(result.point + factor * steps.tangential));
      if (trial.converged && x.distance(trial.point) < x.distance(result.point))
        {
          result.point  = trial.point;
          result.normal = trial.normal;
          steps         = Steps<dim>(lattice, degree, x, result.point);
          factor        = std::min(1., 2 * factor);
        }
      else
        factor *= 0.5;
    }
  return result;
}
} // namespace

template <int dim>
ClosestPoint<dim>
closest_point(const Lattice<dim> &lattice, const Point<dim> &x, const unsigned int degree,
              const Point<dim> &start)
{
  const ClosestPoint<dim> result = newton_search(lattice, x, degree, start);
  return result.converged ? result : descent_search(lattice, x, degree, start);
}

template <int dim>
ClosestPoint<dim>
closest_point(const Lattice<dim> &lattice, const Point<dim> &x, const unsigned int degree)
{
  return closest_point(lattice, x, degree, x);
}

template <int dim>
ClosestPoint<dim>
project(const Lattice<dim> &lattice, const Point<dim> &x, const unsigned int degree)
{
  return project_from(lattice, degree, x);
}

#define INSTANTIATE(dim)                                                                           \
  template ClosestPoint<dim> closest_point(const Lattice<dim> &, const Point<dim> &, unsigned int, \
                                           const Point<dim> &);                                    \
  template ClosestPoint<dim> closest_point(const Lattice<dim> &, const Point<dim> &,               \
                                           unsigned int);                                          \
  template ClosestPoint<dim> project(const Lattice<dim> &, const Point<dim> &, unsigned int);

INSTANTIATE(2)
INSTANTIATE(3)
} // namespace scree
