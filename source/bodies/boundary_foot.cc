#include <scree/bodies/boundary_foot.h>

#include <array>
#include <cmath>

namespace scree
{
namespace
{
/** Pieces of a shape that meet, at most dim of them. */
template <int dim>
struct PieceSet
{
  std::array<const SmoothPiece<dim> *, dim> pieces;
  unsigned int                              n = 0;
};

/**
 * The place next to x where all pieces of a set vanish, and their mean normal there; nothing if
 * they do not meet or only farther than `largest` [L]. dX/dx is that at x.
 */
template <int dim>
std::optional<std::pair<dealii::Point<dim>, dealii::Tensor<1, dim>>>
common_foot(const Body<dim> &body, const PieceSet<dim> &set, const dealii::Point<dim> &x,
            const dealii::Tensor<2, dim> &initial_gradient, const double largest)
{
  const double                            spacing = body.level_set.spacing();
  std::array<dealii::Tensor<1, dim>, dim> directions;
  dealii::Point<dim>                      y = x;
  dealii::Tensor<1, dim>                  normal;
  for (unsigned int iteration = 0; iteration < 8; ++iteration)
    {
      // The smallest z = y - x with phi_i + grad phi_i.(x + z - y) = 0, by orthogonal directions.
      const dealii::Point<dim> Y = initial_position(body, y);
      dealii::Tensor<1, dim>   z;
      normal = 0.;
      for (unsigned int i = 0; i < set.n; ++i)
        {
          const double                 value = set.pieces[i]->value(Y);
          const dealii::Tensor<1, dim> gradient
            = set.pieces[i]->gradient(Y, 1e-4 * spacing) * initial_gradient;
          dealii::Tensor<1, dim> &direction = directions[i];
          direction                         = gradient;
          for (unsigned int j = 0; j < i; ++j)
            direction -= (gradient * directions[j]) * directions[j];
          const double length = direction.norm();
          if (!(length > 1e-2 * gradient.norm()))
            return {};
          direction /= length;
          z -= (value + gradient * (x + z - y)) / length * direction;
          normal += gradient / gradient.norm();
        }
      if (z.norm() > 1.1 * largest)
        return {};
      const bool is_converged = y.distance(x + z) < 1e-6 * spacing;
      y                       = x + z;
      if (is_converged)
        break;
    }
  return std::make_pair(y, normal);
}

/** Calls f for all sets of pieces that hold `set` and others from `first` on. */
template <int dim, typename F>
void
for_each_set(const std::vector<SmoothPiece<dim>> &pieces, const PieceSet<dim> &set,
             const unsigned int first, const unsigned int size, const F &f)
{
  if (set.n == size)
    return f(set);
  for (unsigned int i = first; i < pieces.size(); ++i)
    {
      PieceSet<dim> larger      = set;
      larger.pieces[larger.n++] = &pieces[i];
      for_each_set(pieces, larger, i + 1, size, f);
    }
}

/** foot_on_boundary() with X and G = dX/dx at x, phi = phi_0(X). */
template <int dim>
std::optional<BoundaryFoot<dim>>
foot_from(const Body<dim> &body, const dealii::Point<dim> &x, const dealii::Point<dim> &X,
          const dealii::Tensor<2, dim> &G, const double phi)
{
  const double spacing = body.level_set.spacing();
  // The nearest initial place is at most |F| |G| |phi| from X.
  dealii::BoundingBox<dim> box({X, X});
  box.extend(std::abs(phi) * invert(G).norm() * G.norm() + 1e-6 * spacing);
  std::vector<SmoothPiece<dim>> pieces;
  body.shape->append_pieces(box, pieces);

  std::optional<BoundaryFoot<dim>> best;
  double                           smallest = 1e100;
  for (unsigned int size = 1; size <= dim; ++size)
    for_each_set<dim>(pieces, {}, 0, size, [&](const PieceSet<dim> &set) {
      const auto foot = common_foot(body, set, x, G, smallest);
      if (!foot || foot->first.distance(x) >= smallest
          || std::abs(body.shape->signed_distance(initial_position(body, foot->first)))
               > 1e-3 * spacing)
        return;
      smallest                          = foot->first.distance(x);
      const dealii::Tensor<1, dim> arm  = x - foot->first;
      const double                 sign = phi < 0. ? -1. : 1.;
      best = {foot->first, foot->second / foot->second.norm(), sign * smallest};
      if (size > 1 && smallest > 1e-6 * spacing)
        best->normal = sign / smallest * arm;
    });
  return best;
}
} // namespace

template <int dim>
std::optional<BoundaryFoot<dim>>
foot_on_boundary(const Body<dim> &body, const dealii::Point<dim> &x)
{
  const dealii::Point<dim> X = initial_position(body, x);
  return foot_from(body, x, X, initial_gradient(body, x), body.shape->signed_distance(X));
}

template <int dim>
void
set_moved_distances(Body<dim> &body, const double reach)
{
  Lattice<dim> &phi = body.level_set;
  for (std::size_t i = 0; i < phi.values().size(); ++i)
    {
      const dealii::Point<dim>     x = phi.node(phi.index(i)), X = initial_position(body, x);
      const dealii::Tensor<2, dim> G        = initial_gradient(body, x);
      double                       distance = body.shape->signed_distance(X);
      // |phi_0(X)| is at most |G| times the distance.
      if (std::abs(distance) <= reach * G.norm())
        if (const auto foot = foot_from(body, x, X, G, distance))
          distance = foot->distance;
      phi.values()[i] = distance;
    }
}

#define SCREE_INSTANTIATE(dim)                                                            \
  template std::optional<BoundaryFoot<dim>> foot_on_boundary(const Body<dim> &,           \
                                                             const dealii::Point<dim> &); \
  template void                             set_moved_distances(Body<dim> &, const double);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
