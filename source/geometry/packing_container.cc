#include <scree/geometry/packing_container.h>

#include <array>
#include <cmath>

namespace scree
{
using namespace dealii;

template <int dim>
PackingContainer<dim>::PackingContainer(const BoundingBox<dim> &box, const bool is_cylinder)
    : box(box)
    , is_cylinder(is_cylinder)
    , radius(0.5 * box.side_length(0))
{
}

template <int dim>
double
PackingContainer<dim>::volume() const
{
  return is_cylinder ? 0.25 * numbers::PI * box.volume() : box.volume();
}

template <int dim>
Tensor<1, dim>
PackingContainer<dim>::from_axis(const Point<dim> &x) const
{
  Tensor<1, dim> result;
  for (unsigned int d = 0; d < 2; ++d)
    result[d] = x[d] - 0.5 * (box.lower_bound(d) + box.upper_bound(d));
  return result;
}

template <int dim>
bool
PackingContainer<dim>::contains(const Point<dim> &x) const
{
  return !is_cylinder || from_axis(x).norm_square() < radius * radius;
}

template <int dim>
Tensor<1, dim>
PackingContainer<dim>::towards_round_wall(const TurnedShape<dim> &shape, const Point<dim> &centre,
                                          const double scale) const
{
  const Tensor<1, dim> off = from_axis(centre);
  if (off.norm() + scale * shape.shape.outer_radius() < radius)
    return Tensor<1, dim>();
  const auto reached = [&](const Tensor<1, dim> &n) {
    return from_axis(Point<dim>(centre + scale * shape.support(n)));
  };
  // The outline in directions all around, in which the points farther than their neighbours climb:
  // the point farthest along n is at least as far from the axis as that along whose ray n is.
  constexpr unsigned int               n_around = 32;
  std::array<Tensor<1, dim>, n_around> points;
  std::array<double, n_around>         squares;
  Tensor<1, dim>                       n;
  for (unsigned int i = 0; i < n_around; ++i)
    {
      // A square around the axis: no angle needs its cosine.
      const double place = 8. * i / n_around, along = std::fmod(place, 2.) - 1.;
      n                = Tensor<1, dim>();
      n[i / 8 % 2]     = (i < 16 ? 1. : -1.);
      n[1 - i / 8 % 2] = i / 8 % 2 == 0 ? n[0] * along : -n[1] * along;
      points[i]        = reached(n / n.norm());
      squares[i]       = points[i].norm_square();
    }
  double         most = 0.;
  Tensor<1, dim> farthest;
  for (unsigned int i = 0; i < n_around; ++i)
    if (squares[i] >= squares[(i + 1) % n_around]
        && squares[i] >= squares[(i + n_around - 1) % n_around])
      {
        Tensor<1, dim> x      = points[i];
        double         square = squares[i];
        for (unsigned int step = 0; step < 200; ++step)
          {
            const Tensor<1, dim> next       = reached(x / x.norm());
            const bool           is_farther = next.norm_square() > square * (1. + 1e-15);
            if (!is_farther)
              break;
            x      = next;
            square = next.norm_square();
          }
        if (square > most)
          {
            most     = square;
            farthest = x / std::sqrt(square);
          }
      }
  return farthest;
}

template class PackingContainer<2>;
template class PackingContainer<3>;
} // namespace scree
