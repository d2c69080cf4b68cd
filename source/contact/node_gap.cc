#include <scree/contact/node_gap.h>

#include <algorithm>

namespace scree
{
namespace
{
/** Central differences of a function over a length: one for each direction. */
template <int dim, typename Function>
auto
differences(const Function &function, const dealii::Point<dim> &x, const double length)
{
  dealii::Tensor<1, dim, decltype(function(x))> result;
  for (unsigned int d = 0; d < dim; ++d)
    for (const double sign : {-1., 1.})
      {
        dealii::Point<dim> y = x;
        y[d] += sign * 0.5 * length;
        result[d] += sign / length * function(y);
      }
  return result;
}

/**
 * phi_a + phi_b at the foot y of x on {psi = 0}, psi = phi_a - phi_b:
 *
 *     y <- y - psi grad psi/|grad psi|^2    from y = x.
 *
 * A node without a foot within two cells is its own, and so is one whose foot is where the surfaces
 * do not face each other along its normal: n . grad psi is 2 between two faces, sqrt(2) beside an
 * edge, and negative where n is that of the far side of a thin body.
 */
template <int dim, typename DistanceOfA, typename DistanceOfB>
double
gap_at_foot(const DistanceOfA &phi_a, const DistanceOfB &phi_b, const dealii::Point<dim> &x,
            const dealii::Tensor<1, dim> &n, const double cell_size)
{
  constexpr unsigned int n_steps = 4;
  constexpr double       reach = 2., smallest_slope = 0.2, slope_of_faces = 1.7; // of psi
  const auto             psi = [&](const dealii::Point<dim> &y) { return phi_a(y) - phi_b(y); };
  dealii::Point<dim>     y   = x;
  for (unsigned int step_number = 0; step_number < n_steps; ++step_number)
    {
      const dealii::Tensor<1, dim> slope = differences<dim>(psi, y, 0.5 * cell_size);
      if (slope.norm() < smallest_slope)
        break;
      const dealii::Tensor<1, dim> step = -psi(y) / slope.norm_square() * slope;
      y += cell_size / std::max(cell_size, step.norm()) * step;
      if ((y - x).norm() > reach * cell_size)
        return phi_a(x) + phi_b(x);
    }
  if (n * dealii::Tensor<1, dim>(differences<dim>(psi, y, 0.5 * cell_size)) < slope_of_faces)
    y = x;
  return phi_a(y) + phi_b(y);
}
} // namespace

template <int dim>
double
NodeGaps<dim>::distance(const unsigned int b, const dealii::Point<dim> &x) const
{
  constexpr unsigned int degree = 3;
  return bodies[b].level_set.value(x, degree);
}

template <int dim>
double
NodeGaps<dim>::moved_distance(const unsigned int b, const dealii::Point<dim> &x) const
{
  return distance(b, x - prediction(b, x));
}

template <int dim>
double
NodeGaps<dim>::expected_strain(const unsigned int b, const dealii::Point<dim> &x,
                               const double cell_size) const
{
  const dealii::Tensor<2, dim> transposed
    = differences<dim>([&](const dealii::Point<dim> &y) { return prediction(b, y); }, x, cell_size);
  return symmetrize(transposed + 0.5 * transposed * transpose(transposed)).norm();
}

template <int dim>
double
NodeGaps<dim>::at_start(const ContactPair &pair, const dealii::Point<dim> &x,
                        const dealii::Tensor<1, dim> &n, const double cell_size) const
{
  return gap_at_foot<dim>([&](const dealii::Point<dim> &y) { return distance(pair.a, y); },
                          [&](const dealii::Point<dim> &y) { return distance(pair.b, y); }, x, n,
                          cell_size);
}

template <int dim>
void
NodeGaps<dim>::expect_motion(const ContactPair &pair, ContactPoint<dim> &point) const
{
  // Beyond this angle the node is at the end of a body, whose distance says nothing of its face.
  constexpr double          smallest_cosine = 0.9;
  constexpr double          largest_strain  = 1e-3;
  const dealii::Point<dim> &x               = point.position;
  const double              h               = point.cell_size;
  if (!prediction || expected_strain(pair.a, x, h) > largest_strain
      || expected_strain(pair.b, x, h) > largest_strain)
    return;
  dealii::Tensor<1, dim> n = point.normal;
  for (const auto &[body, sign] : {std::pair(pair.a, 1.), std::pair(pair.b, -1.)})
    {
      const unsigned int           b = body; // lambdas capture no bindings
      const dealii::Tensor<1, dim> before
        = differences<dim>([&](const dealii::Point<dim> &y) { return distance(b, y); }, x, h);
      const dealii::Tensor<1, dim> after
        = differences<dim>([&](const dealii::Point<dim> &y) { return moved_distance(b, y); }, x, h);
      const double cosine = std::min(sign * before * point.normal, sign * after * point.normal);
      if (cosine > smallest_cosine)
        n += 0.5 * sign * (after - before);
    }
  n /= n.norm();
  point.initial_gap
    = gap_at_foot<dim>([&](const dealii::Point<dim> &y) { return moved_distance(pair.a, y); },
                       [&](const dealii::Point<dim> &y) { return moved_distance(pair.b, y); }, x, n,
                       h)
      - n * (prediction(pair.b, x) - prediction(pair.a, x));
  point.normal = n;
}

template class NodeGaps<2>;
template class NodeGaps<3>;
} // namespace scree
