#include <scree/contact/contact_normal.h>
#include <scree/contact/kinked_surface.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <cmath>

namespace scree
{
namespace
{
/** Values f at the 3^dim nodes of a box are its multilinear interpolant, to `tolerance`. */
template <int dim>
bool
is_multilinear(const LagrangeBasis<dim> &linear, const LagrangeBasis<dim> &quadratic,
               const std::array<double, max_nodes_per_cell<dim>> &f, const double tolerance)
{
  std::array<double, max_nodes_per_cell<dim>> shape;
  for (unsigned int i = 0; i < quadratic.n_nodes; ++i)
    {
      linear.evaluate_values(quadratic.node(i), shape.data());
      double value = 0.;
      for (unsigned int v = 0; v < linear.n_nodes; ++v)
        {
          // Vertex v of the box among the nodes of degree 2.
          unsigned int node = 0, stride = 2;
          for (unsigned int d = 0; d < dim; ++d, stride *= 3)
            node += stride * (v >> d & 1);
          value += shape[v] * f[node];
        }
      if (std::abs(value - f[i]) > tolerance)
        return false;
    }
  return true;
}

} // namespace

template <int dim>
KinkedSurface<dim>::KinkedSurface(const ExactDistances<dim>    &distances,
                                  const std::vector<Body<dim>> &bodies,
                                  const LevelSetNodes<dim>     &level_set_nodes)
    : distances(distances)
    , bodies(bodies)
    , rules(level_set_nodes.rules())
{
}

template <int dim>
bool
KinkedSurface<dim>::concerns(const ContactPair &pair, const GridCell<dim> &cell) const
{
  dealii::Point<dim> upper = cell.lower;
  for (unsigned int d = 0; d < dim; ++d)
    upper[d] += cell.size;
  const dealii::Point<dim> centre = cell.lower + 0.5 * (upper - cell.lower);
  bool                     result = false;
  for (const unsigned int body : {pair.a, pair.b})
    {
      if (!distances.is_known(body, centre))
        return false;
      const double distance = std::abs(distances.value(body, centre));
      if (distance > 2. * cell.size)
        return false; // nothing touches here
      // Feet of the cell's points lie in this box.
      dealii::BoundingBox<dim> box({cell.lower, upper});
      box.extend(distance + 0.5 * upper.distance(cell.lower));
      result |= distances.is_kinked(body, box);
    }
  return result;
}

template <int dim>
dealii::Point<dim>
KinkedSurface<dim>::on_surface(const ContactPair &pair, const dealii::Point<dim> &x,
                               const dealii::Tensor<1, dim> &direction, const double size) const
{
  constexpr unsigned int max_steps  = 8;
  const auto             difference = [&](const double t) {
    return distances.value(pair.a, x + t * direction) - distances.value(pair.b, x + t * direction);
  };
  const double tolerance = 1e-9 * size;
  double       t = 0., value = difference(t);
  double       next = -0.5 * value; // psi grows by 2 where the bodies face each other
  for (unsigned int step = 0; step < max_steps && std::abs(value) > tolerance; ++step)
    {
      const double at_next = difference(next);
      const double slope   = (at_next - value) / (next - t);
      t                    = next;
      value                = at_next;
      next                 = t - value / slope;
      if (!(std::abs(next) <= size))
        return x;
    }
  return std::abs(value) <= tolerance ? x + t * direction : x;
}

template <int dim>
void
KinkedSurface<dim>::divide(const ContactPair &pair, const GridCell<dim> &cell,
                           const dealii::Point<dim> &lower, const unsigned int depth)
{
  constexpr unsigned int          least = dim == 2 ? 2 : 1, most = dim == 2 ? 8 : 4;
  constexpr unsigned int          smallest = dim == 2 ? 7 : 4;
  static const LagrangeBasis<dim> linear(1), quadratic(2);
  const double                    size = std::ldexp(cell.size, -int(depth));
  const auto                      place
    = [&](const dealii::Point<dim> &unit) { return lower + size * dealii::Tensor<1, dim>(unit); };
  const auto difference = [&](const dealii::Point<dim> &x) {
    return distances.value(pair.a, x) - distances.value(pair.b, x);
  };
  std::array<double, max_nodes_per_cell<dim>> phi_a, phi_b;
  for (unsigned int i = 0; i < quadratic.n_nodes; ++i)
    {
      phi_a[i] = distances.value(pair.a, place(quadratic.node(i)));
      phi_b[i] = distances.value(pair.b, place(quadratic.node(i)));
    }
  const unsigned int middle = quadratic.n_nodes / 2;
  if (std::abs(phi_a[middle] - phi_b[middle]) > 1.5 * std::sqrt(double(dim)) * size)
    return; // the surface does not pass
  const double tolerance = 0.02 * size;
  // A kink on a face belongs to both parts, whatever the rounding.
  dealii::BoundingBox<dim> part({lower, place(linear.node(linear.n_nodes - 1))});
  part.extend(1e-6 * size);
  if (depth < least
      || (depth < most
          && (distances.is_kinked(pair.a, part) || distances.is_kinked(pair.b, part)
              || !is_multilinear(linear, quadratic, phi_a, tolerance)
              || !is_multilinear(linear, quadratic, phi_b, tolerance))))
    {
      for (unsigned int v = 0; v < 1u << dim; ++v)
        divide(pair, cell, place(0.5 * linear.node(v)), depth + 1);
      return;
    }
  std::array<double, max_nodes_per_cell<dim>> scaled;
  unsigned int                                n_negative = 0;
  for (unsigned int i = 0; i < rules.basis.n_nodes; ++i)
    {
      scaled[i] = difference(place(rules.basis.node(i))) / size;
      if (std::abs(scaled[i]) < 1e-9)
        scaled[i] = 1e-9;
      n_negative += scaled[i] < 0.;
    }
  if (n_negative == 0 || n_negative == rules.basis.n_nodes)
    return;
  const CellPoints<dim> surface = rules.rules(scaled.data(), size).surface;
  for (unsigned int q = 0; q < surface.points.size(); ++q)
    {
      Piece piece{on_surface(pair, place(surface.points[q]), surface.normals[q], size),
                  surface.weights[q],
                  {},
                  {},
                  0,
                  {}};
      // The smallest points lie next to the kinks: a corner may carry a force alone.
      piece.group = depth < most / 2 ? 0 : depth < smallest ? 1 : 2;
      piece.n_a   = distances.normal(pair.a, piece.x);
      piece.n_b   = distances.normal(pair.b, piece.x);
      for (unsigned int d = 0; d < dim; ++d)
        piece.group = 2 * piece.group + (piece.x[d] > cell.lower[d] + 0.5 * cell.size);
      pieces.push_back(piece);
    }
}

template <int dim>
std::vector<typename KinkedSurface<dim>::Piece>
KinkedSurface<dim>::joined_pieces() const
{
  constexpr double   same = 0.97; // cosine
  std::vector<Piece> joined;
  for (const Piece &piece : pieces)
    {
      auto it = std::find_if(joined.begin(), joined.end(), [&](const Piece &other) {
        return piece.group == other.group
               && piece.n_a * other.n_a > same * piece.n_a.norm() * other.n_a.norm()
               && piece.n_b * other.n_b > same * piece.n_b.norm() * other.n_b.norm();
      });
      if (it == joined.end())
        it = joined.insert(joined.end(), {dealii::Point<dim>(), 0., {}, {}, piece.group, {}});
      it->x += piece.weight * dealii::Tensor<1, dim>(piece.x);
      it->weight += piece.weight;
      it->n_a += piece.weight * piece.n_a;
      it->n_b += piece.weight * piece.n_b;
      it->square += piece.weight * dealii::symmetrize(dealii::outer_product(piece.x, piece.x));
    }
  for (Piece &piece : joined)
    {
      piece.x /= piece.weight;
      piece.square /= piece.weight;
      piece.square -= dealii::symmetrize(dealii::outer_product(piece.x, piece.x));
    }
  return joined;
}

template <int dim>
std::vector<dealii::Point<dim>>
KinkedSurface<dim>::places(const Piece &piece) const
{
  if (rules.gauss.surface < 3)
    return {piece.x};
  std::vector<dealii::Point<dim>> result;
  const auto                      principal = dealii::eigenvectors(piece.square);
  for (unsigned int k = 0; k < dim - 1; ++k)
    for (const double sign : {-1., 1.})
      result.push_back(piece.x
                       + sign * std::sqrt((dim - 1) * std::max(0., principal[k].first))
                           * principal[k].second);
  return result;
}

template <int dim>
std::vector<ContactPoint<dim>>
KinkedSurface<dim>::points(const unsigned int number, const ContactPair &pair,
                           const GridCell<dim> &cell)
{
  constexpr double facing = 0.9; // cosine
  pieces.clear();
  divide(pair, cell, cell.lower, 0);
  const double                   negligible = 1e-8 * std::pow(cell.size, dim - 1);
  std::vector<ContactPoint<dim>> result;
  for (const Piece &piece : joined_pieces())
    {
      if (piece.weight < negligible)
        continue;
      const bool is_beyond
        = -(piece.n_a * piece.n_b) < facing * piece.n_a.norm() * piece.n_b.norm();
      const auto x_of_points = places(piece);
      for (const dealii::Point<dim> &x : x_of_points)
        {
          const double             gap = distances.value(pair.a, x) + distances.value(pair.b, x);
          const ContactNormal<dim> n   = contact_normal(distances, bodies, pair.a, pair.b, x,
                                                        cell.size, piece.n_a - piece.n_b);
          result.push_back({number, x, n.normal, piece.weight / x_of_points.size(), gap, cell.size,
                            n.normal, gap, false, true, is_beyond, n.of});
        }
    }
  return result;
}

template class KinkedSurface<2>;
template class KinkedSurface<3>;
} // namespace scree
