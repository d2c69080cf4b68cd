#include <scree/geometry/touching_scale.h>

#include <cmath>

namespace scree
{
using namespace dealii;

namespace
{
/** Support points of a and b along n and -n, and their difference, one of the Minkowski sum. */
template <int dim>
struct SumSupport
{
  Tensor<1, dim> on_a, on_b, point, normal;
};

double
triple(const Tensor<1, 3> &a, const Tensor<1, 3> &b, const Tensor<1, 3> &c)
{
  return cross_product_3d(a, b) * c;
}

/** Support points whose simplex the ray along `arm` pierces, and the best plane so far. */
template <int dim>
class Portal
{
public:
  Portal(const TurnedShape<dim> &a, const TurnedShape<dim> &b, const Tensor<1, dim> &arm);

  /** Starts from a guess, or anew. */
  void start(const TouchGuess<dim> &guess, const double enough);

  /** Whether the best plane is that of the portal, to the tolerance. */
  bool refine(const double tolerance);

  /** The best plane; the points where the ray leaves the portal. */
  Touch<dim> touch() const;

  /** For the next search. */
  TouchGuess<dim> guess() const;

  Touch<dim> best;

private:
  SumSupport<dim> support(const Tensor<1, dim> &n);

  /** Finds the first simplex from the support point along the ray. */
  void find();

  /** Whether the ray pierces the simplex. */
  bool is_pierced() const;

  /** Puts `next` in place of a corner such that the ray still pierces the simplex. */
  void exchange(const SumSupport<dim> &next);

  const TurnedShape<dim>          &a, &b;
  Tensor<1, dim>                   arm;
  std::array<SumSupport<dim>, dim> corners;
  bool                             has_corners = false; //!< else the best plane is all there is
};

template <int dim>
Portal<dim>::Portal(const TurnedShape<dim> &a, const TurnedShape<dim> &b, const Tensor<1, dim> &arm)
    : a(a)
    , b(b)
    , arm(arm)
{
  best.scale = -1.;
}

template <int dim>
void
Portal<dim>::start(const TouchGuess<dim> &guess, const double enough)
{
  if (guess.has_corners)
    {
      for (unsigned int i = 0; i < dim; ++i)
        corners[i] = support(guess.corners[i]);
      has_corners = is_pierced();
    }
  else if (guess.normal.norm_square() > 0.)
    support(guess.normal);
  if (has_corners || best.scale >= enough)
    return;
  corners[0] = support(arm / arm.norm());
  if (best.scale < enough)
    find();
}

template <int dim>
SumSupport<dim>
Portal<dim>::support(const Tensor<1, dim> &n)
{
  SumSupport<dim> s{a.support(n), b.support(-n), {}, n};
  s.point            = s.on_a - s.on_b;
  const double reach = n * s.point, scale = n * arm / reach;
  if (scale > best.scale)
    best = {scale, n, reach, s.on_a, s.on_b};
  return s;
}

template <>
void
Portal<2>::find()
{
  const Tensor<1, 2> side({-arm[1], arm[0]});
  const double       off = side * corners[0].point;
  has_corners            = off != 0.;
  if (has_corners)
    corners[1] = support((off > 0. ? -1. : 1.) / side.norm() * side);
}

template <>
bool
Portal<2>::is_pierced() const
{
  const Tensor<1, 2> side({-arm[1], arm[0]});
  return (side * corners[0].point) * (side * corners[1].point) < 0.;
}

template <>
bool
Portal<3>::is_pierced() const
{
  const auto &[u, v, w] = corners;
  return triple(u.point, v.point, arm) > 0. && triple(v.point, w.point, arm) > 0.
         && triple(w.point, u.point, arm) > 0.;
}

template <>
void
Portal<3>::find()
{
  const auto   unit = [](const Tensor<1, 3> &x) { return x / x.norm(); };
  const double size = corners[0].point.norm() * arm.norm();
  Tensor<1, 3> n    = cross_product_3d(corners[0].point, arm);
  if (n.norm() <= 1e-15 * size) // the ray passes through the corner
    return;
  corners[1] = support(unit(n));
  n          = cross_product_3d(corners[0].point, corners[1].point);
  if (n * arm < 0.)
    {
      std::swap(corners[0], corners[1]);
      n *= -1.;
    }
  for (unsigned int i = 0; i < 100; ++i)
    {
      corners[2] = support(unit(n));
      if (triple(corners[2].point, corners[0].point, arm) < 0.)
        corners[1] = corners[2];
      else if (triple(corners[1].point, corners[2].point, arm) < 0.)
        corners[0] = corners[2];
      else
        {
          has_corners = true;
          return;
        }
      n = cross_product_3d(corners[0].point, corners[1].point);
      if (!(n.norm_square() > 0.))
        return;
    }
}

template <>
void
Portal<2>::exchange(const SumSupport<2> &next)
{
  const Tensor<1, 2> side({-arm[1], arm[0]});
  const bool         same = (side * next.point > 0.) == (side * corners[0].point > 0.);
  corners[same ? 0 : 1]   = next;
}

template <>
void
Portal<3>::exchange(const SumSupport<3> &next)
{
  // The corners go round the ray counter-clockwise, as seen from outside.
  const Tensor<1, 3> across = cross_product_3d(next.point, arm);
  if (corners[0].point * across > 0.)
    corners[corners[2].point * across > 0. ? 0 : 1] = next;
  else
    corners[corners[1].point * across > 0. ? 2 : 0] = next;
}

template <int dim>
Tensor<1, dim>
normal_of(const std::array<SumSupport<dim>, dim> &corners)
{
  const Tensor<1, dim> side = corners[1].point - corners[0].point;
  if constexpr (dim == 2)
    return Tensor<1, 2>({-side[1], side[0]});
  else
    return cross_product_3d(side, corners[2].point - corners[0].point);
}

template <int dim>
bool
Portal<dim>::refine(const double tolerance)
{
  if (!has_corners)
    return true;
  Tensor<1, dim> n    = normal_of<dim>(corners);
  const double   size = n.norm();
  if (!(size > 0.))
    return true;
  n *= (n * arm > 0. ? 1. : -1.) / size;
  const SumSupport<dim> next  = support(n);
  const double          reach = n * next.point;
  if (!(reach - n * corners[0].point > tolerance * reach))
    return true;
  exchange(next);
  return false;
}

template <int dim>
Touch<dim>
Portal<dim>::touch() const
{
  Touch<dim> result = best;
  if (!has_corners)
    return result;
  // Weights of the corners where the ray passes.
  std::array<double, dim> weights;
  double                  sum = 0.;
  for (unsigned int i = 0; i < dim; ++i)
    {
      const Tensor<1, dim> &next = corners[(i + 1) % dim].point;
      if constexpr (dim == 2)
        weights[i] = std::abs(next[0] * arm[1] - next[1] * arm[0]);
      else
        weights[i] = std::abs(triple(next, corners[(i + 2) % dim].point, arm));
      sum += weights[i];
    }
  if (!(sum > 0.))
    return result;
  result.on_a = result.on_b = Tensor<1, dim>();
  for (unsigned int i = 0; i < dim; ++i)
    {
      result.on_a += weights[i] / sum * corners[i].on_a;
      result.on_b += weights[i] / sum * corners[i].on_b;
    }
  return result;
}

template <int dim>
TouchGuess<dim>
Portal<dim>::guess() const
{
  TouchGuess<dim> result;
  result.normal      = best.normal;
  result.has_corners = has_corners;
  for (unsigned int i = 0; i < dim; ++i)
    result.corners[i] = corners[i].normal;
  return result;
}
} // namespace

template <int dim>
Touch<dim>
touching_scale(const TurnedShape<dim> &a, const TurnedShape<dim> &b, const Tensor<1, dim> &arm,
               const double tolerance, const double enough, TouchGuess<dim> &guess)
{
  constexpr unsigned int most_steps = 200;
  Portal<dim>            portal(a, b, arm);
  portal.start(guess, enough);
  for (unsigned int i = 0; i < most_steps && portal.best.scale < enough; ++i)
    if (portal.refine(tolerance))
      break;
  guess = portal.guess();
  if (portal.best.scale >= enough)
    guess.has_corners = false;
  return portal.touch();
}

template Touch<2> touching_scale(const TurnedShape<2> &, const TurnedShape<2> &,
                                 const Tensor<1, 2> &, const double, const double, TouchGuess<2> &);
template Touch<3> touching_scale(const TurnedShape<3> &, const TurnedShape<3> &,
                                 const Tensor<1, 3> &, const double, const double, TouchGuess<3> &);
} // namespace scree
