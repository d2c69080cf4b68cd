#include <scree/contact/least_gap.h>
#include <scree/contact/surface_fit.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <cmath>

namespace scree
{
namespace
{
/** Curvatures whose gaps over a cell are this part of it at least make a minimum. */
constexpr double least_bend = 0.02;

/** Places are known to this part of a cell: the gradients of interpolants jump between lattice
 * cells. */
constexpr double accuracy = 0.02;

/** A least gap that the first step expects so many cells from a cell's point is not in the cell. */
constexpr double far = 3.;

/** The part of a cell's surface that the point of least gap takes. */
constexpr double share = 0.125;

/** H^{-1} f in the directions in which H curves; none if the gap is flat or a saddle. */
template <int n>
std::optional<dealii::Tensor<1, n>>
newton_step(const dealii::SymmetricTensor<2, n> &H, const dealii::Tensor<1, n> &f,
            const double least_curvature)
{
  dealii::Tensor<1, n> result;
  bool                 is_curved = false;
  if constexpr (n == 1)
    {
      is_curved = H[0][0] > least_curvature;
      if (is_curved)
        result[0] = f[0] / H[0][0];
    }
  else
    for (const auto &[curvature, direction] : dealii::eigenvectors(H))
      {
        if (curvature < -least_curvature)
          return {};
        if (curvature < least_curvature)
          continue;
        is_curved = true;
        result += f * direction / curvature * direction;
      }
  if (!is_curved)
    return {};
  return result;
}
} // namespace

template <int dim>
LeastGap<dim>::LeastGap(const ExactDistances<dim> &distances, const std::vector<Body<dim>> &bodies,
                        const ContactPair &pair)
    : distances(distances)
    , bodies(bodies)
    , pair(pair)
{
}

template <int dim>
std::pair<double, dealii::Tensor<1, dim>>
LeastGap<dim>::distance(const unsigned int body, const dealii::Point<dim> &x) const
{
  if (is_known[body == pair.a ? 0 : 1])
    return distances.value_and_normal(body, x);
  return bodies[body].level_set.value_and_gradient(x, 3);
}

template <int dim>
dealii::Point<dim>
LeastGap<dim>::on_surface(const dealii::Point<dim> &x) const
{
  const auto [phi_a, n_a]  = distance(pair.a, x);
  const auto [phi_b, n_b]  = distance(pair.b, x);
  const Tensor difference  = n_a - n_b;
  const double norm_square = std::max(0.1, difference.norm_square());
  return x - (phi_a - phi_b) / norm_square * difference;
}

template <int dim>
double
LeastGap<dim>::gap(const dealii::Point<dim> &x) const
{
  double result = 0.;
  for (const unsigned int body : {pair.a, pair.b})
    result += is_known[body == pair.a ? 0 : 1] ? distances.value(body, x)
                                               : bodies[body].level_set.value(x, 3);
  return result;
}

template <int dim>
std::optional<typename LeastGap<dim>::Minimum>
LeastGap<dim>::minimum(const dealii::Point<dim> &start, const double size) const
{
  constexpr unsigned int most_iterations = 10;
  const double           step            = 0.25 * size; // smooths interpolants
  Minimum                result{on_surface(start), 0.};
  double                 length = 0.;
  for (unsigned int iteration = 0; iteration < most_iterations; ++iteration)
    {
      const auto [phi_a, n_a] = distance(pair.a, result.x);
      const auto [phi_b, n_b] = distance(pair.b, result.x);
      const Tensor normal     = n_a - n_b;
      const auto   tangents   = surface_tangents<dim>(normal / normal.norm());
      const auto   at         = [&](const Tensor &offset) { return gap(result.x + step * offset); };
      const double here       = phi_a + phi_b;
      dealii::Tensor<1, dim - 1>          f;
      dealii::SymmetricTensor<2, dim - 1> H;
      for (unsigned int k = 0; k < dim - 1; ++k)
        {
          const double before = at(-tangents[k]), after = at(tangents[k]);
          f[k]    = (after - before) / (2. * step);
          H[k][k] = (before - 2. * here + after) / (step * step);
          for (unsigned int l = 0; l < k; ++l)
            H[k][l] = (at(tangents[k] + tangents[l]) - at(tangents[k] - tangents[l])
                       - at(tangents[l] - tangents[k]) + at(-tangents[k] - tangents[l]))
                      / (4. * step * step);
        }
      result.curvature     = trace(H);
      const auto reduction = newton_step<dim - 1>(H, f, least_bend / size);
      if (!reduction)
        return {};
      length = reduction->norm();
      if (iteration == 0 && length > far * size)
        return {};
      const double limit = std::min(1., size / length);
      for (unsigned int k = 0; k < dim - 1; ++k)
        result.x -= limit * (*reduction)[k] * tangents[k];
      result.x = on_surface(result.x);
      if (result.x.distance(start) > 2. * size)
        return {};
      if (length < 1e-12 * size)
        break;
    }
  if (length > accuracy * size)
    return {};
  return result;
}

template <int dim>
bool
LeastGap<dim>::is_least(const dealii::Point<dim> &x, const double least_gap, const Tensor &normal,
                        const double size) const
{
  for (const auto &tangent : surface_tangents<dim>(normal))
    for (const double offset : {-2., -1.5, -1., -0.5, 0.5, 1., 1.5, 2.})
      {
        const double beside = gap(x + offset * size * tangent);
        if (beside < least_gap - 1e-6 * size || (std::abs(offset) == 0.5 && beside < 0.))
          return false;
      }
  return true;
}

template <int dim>
ContactPoint<dim>
LeastGap<dim>::point_at(const dealii::Point<dim> &x, const double weight, const double least_gap,
                        const ContactPoint<dim> &beside) const
{
  ContactPoint<dim> point = beside;
  point.position          = x;
  point.weight            = weight;
  point.initial_gap = point.start_gap = least_gap;
  point.is_exact = distances.is_known(pair.a, x) && distances.is_known(pair.b, x);
  if (point.normal_of == NormalOf::both)
    point.normal = distance(pair.a, x).second - distance(pair.b, x).second;
  else if (point.normal_of == NormalOf::body_a)
    point.normal = distances.normal(pair.a, x);
  else
    point.normal = -distances.normal(pair.b, x);
  point.normal /= point.normal.norm();
  point.start_normal = point.normal;
  return point;
}

template <int dim>
void
LeastGap<dim>::add_point(const GridCell<dim> &cell, std::vector<ContactPoint<dim>> &points)
{
  if (points.empty())
    return;
  const auto first
    = *std::min_element(points.begin(), points.end(),
                        [](const auto &p, const auto &q) { return p.initial_gap < q.initial_gap; });
  if (first.initial_gap < 0.)
    return; // points of the cell lie in the contact already
  is_known
    = {{distances.is_known(pair.a, first.position), distances.is_known(pair.b, first.position)}};
  auto least = minimum(first.position, cell.size);
  if (!least)
    return;
  for (unsigned int d = 0; d < dim; ++d)
    {
      const double inside = std::clamp(least->x[d], cell.lower[d], cell.lower[d] + cell.size);
      if (std::abs(least->x[d] - inside) > accuracy * cell.size)
        return;
      least->x[d] = inside;
    }

  const auto   tangents  = surface_tangents<dim>(first.normal);
  const double least_gap = gap(least->x);
  if (!is_least(least->x, least_gap, first.normal, cell.size))
    return;

  // The points beside it: on the same faces, seen in the tangent plane.
  constexpr double                   same = 0.9; // cosine
  std::vector<SurfaceNeighbour<dim>> beside;
  double                             area = 0.;
  for (unsigned int q = 0; q < points.size(); ++q)
    if (points[q].normal * first.normal > same)
      {
        const Tensor arm = points[q].position - least->x;
        beside.push_back({q, arm.norm_square(), points[q].weight, {}});
        for (unsigned int k = 0; k < dim - 1; ++k)
          beside.back().place[k] = arm * tangents[k];
        area += points[q].weight;
      }
  for (auto &neighbour : beside)
    neighbour.weight /= area;
  const LinearFit<dim>       fit(beside, cell.size);
  dealii::Tensor<1, dim - 1> direction;
  if (fit.is_linear)
    direction = fit.direction(fit.mean);
  std::vector<double> lambda;
  double              omega = share * area, interpolated = 0.;
  for (const auto &neighbour : beside)
    {
      lambda.push_back(neighbour.weight * (1. - direction * (neighbour.place - fit.mean)));
      if (lambda.back() > 0.)
        omega = std::min(omega, 0.5 * points[neighbour.entry].weight / lambda.back());
      interpolated += lambda.back() * points[neighbour.entry].initial_gap;
    }

  // Of thin bodies the points see the side that faces the other body, the distances the nearest.
  if (std::abs(interpolated - least_gap) > least->curvature * cell.size * cell.size)
    return;
  for (unsigned int i = 0; i < beside.size(); ++i)
    points[beside[i].entry].weight -= omega * lambda[i];
  points.push_back(point_at(least->x, omega, least_gap, first));
}

template class LeastGap<2>;
template class LeastGap<3>;
} // namespace scree
