#include <scree/geometry/packing_container.h>
#include <scree/geometry/random_packing.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace scree
{
using namespace dealii;

namespace
{
template <int dim>
using Turn = Tensor<1, dim == 2 ? 1 : 3>; // a small rotation vector

template <int dim>
Turn<dim>
moment(const Tensor<1, dim> &arm, const Tensor<1, dim> &n)
{
  if constexpr (dim == 2)
    return Tensor<1, 1>({arm[0] * n[1] - arm[1] * n[0]});
  else
    return cross_product_3d(arm, n);
}

/** The rotation (1 - W/2)^-1 (1 + W/2), W the cross product by w: orthogonal for any w (Cayley). */
template <int dim>
Tensor<2, dim>
small_rotation(const Turn<dim> &w)
{
  Tensor<2, dim> half;
  if constexpr (dim == 2)
    {
      half[0][1] = -0.5 * w[0];
      half[1][0] = 0.5 * w[0];
    }
  else
    for (unsigned int i = 0; i < 3; ++i)
      {
        half[(i + 2) % 3][(i + 1) % 3] = 0.5 * w[i];
        half[(i + 1) % 3][(i + 2) % 3] = -0.5 * w[i];
      }
  const Tensor<2, dim> one = unit_symmetric_tensor<dim>();
  return one + 2. / (1. + 0.25 * w.norm_square()) * (half + half * half);
}

/** Convex shapes that grow in a container. */
template <int dim>
class GrowingShapes
{
public:
  explicit GrowingShapes(const PackingParameters<dim> &parameters);

  struct Member
  {
    Point<dim>                              centre;
    Tensor<2, dim>                          rotation;
    std::shared_ptr<const ConvexShape<dim>> shape;
    double                                  radius;   //!< of the ball about the shape
    double                                  gyration; //!< squared, of its mass
    bool                                    is_round;

    /** What was found about each neighbour before. */
    std::vector<std::pair<unsigned int, TouchGuess<dim>>> guesses = {};

    TurnedShape<dim> turned() const
    {
      return {*shape, rotation};
    }

    TouchGuess<dim> &guess(const unsigned int neighbour)
    {
      constexpr std::size_t most = 100; // of old neighbours, too
      for (auto &[known, guess] : guesses)
        if (known == neighbour)
          return guess;
      if (guesses.size() == most)
        guesses.clear();
      return guesses.emplace_back(neighbour, TouchGuess<dim>()).second;
    }

    /** The support point along n from the centre. */
    Tensor<1, dim> support(const Tensor<1, dim> &n) const
    {
      return is_round ? radius * n : turned().support(n);
    }
  };

  /** The scale at which the shapes have the volume of the container. */
  double filling_scale() const;

  /** Pushes shapes grown by `scale` apart; false if overlaps of `tolerance` stay, over the scale.
   */
  bool relax(const double scale, const double tolerance);

  /** The largest scale without overlap. */
  double largest_scale();

  std::vector<Member> members;

private:
  /** Sorts the members into cells somewhat wider than the widest pair. */
  void sort(const double scale);

  /** Calls `function(a, b)` for the pairs of members of neighbouring cells, in a fixed order. */
  template <typename Function>
  void for_each_pair(const Function &function);

  /** Moves a member into the container; its overlap, infinite if there is no room. */
  double push_inside(Member &member, const double scale) const;

  /** Moves two members apart; their overlap. */
  double push_apart(Member &a, Member &b, const double scale, const double tolerance) const;

  /** Turns a member that is pushed along n at a point by `push`, which shares it with others. */
  static void turn(Member &member, const Tensor<1, dim> &at, const Tensor<1, dim> &push);

  /**
   * What turns slides along its neighbours for long: pushed twice as far as overlaps ask, it is as
   * dense after a third of the sweeps.
   */
  unsigned int most_sweeps() const
  {
    return all_round ? 1000 : 300;
  }
  static constexpr double over_relaxation = 2.;

  bool                                      all_round = true;
  PackingContainer<dim>                     container;
  std::array<std::size_t, dim>              n_cells;
  std::vector<std::array<std::size_t, dim>> cell_of_member;
  std::vector<std::vector<unsigned int>>    cells;
};

template <int dim>
GrowingShapes<dim>::GrowingShapes(const PackingParameters<dim> &parameters)
    : container(parameters.box, parameters.in_cylinder)
{
  const auto     &box = container.box;
  std::mt19937_64 random(parameters.seed);
  for (unsigned int i = 0; i < parameters.n; ++i)
    {
      Member member;
      do
        for (unsigned int d = 0; d < dim; ++d)
          member.centre[d] = box.lower_bound(d) + uniform(random) * box.side_length(d);
      while (!container.contains(member.centre));
      member.shape    = parameters.shapes.draw(random);
      member.rotation = parameters.shapes.draw_rotation(random);
      member.is_round = member.shape->is_round();
      member.radius   = member.shape->outer_radius();
      member.gyration = 0.25 * member.radius * member.radius;
      all_round       = all_round && member.is_round;
      members.push_back(member);
    }
}

template <int dim>
double
GrowingShapes<dim>::filling_scale() const
{
  double sum = 0.;
  for (const auto &member : members)
    sum += member.shape->volume();
  return root<dim>(container.volume() / sum);
}

template <int dim>
void
GrowingShapes<dim>::sort(const double scale)
{
  const auto &box     = container.box;
  double      largest = 0.;
  for (const auto &member : members)
    largest = std::max(largest, member.radius);
  const double most = 2. * root<dim>(members.size()) + 1.;
  std::size_t  n    = 1;
  for (unsigned int d = 0; d < dim; ++d)
    {
      n_cells[d] = static_cast<std::size_t>(
        std::clamp(box.side_length(d) / (2.2 * scale * largest), 1., most));
      n *= n_cells[d];
    }
  cells.assign(n, {});
  cell_of_member.resize(members.size());
  for (unsigned int i = 0; i < members.size(); ++i)
    {
      std::size_t place = 0;
      for (int d = dim - 1; d >= 0; --d)
        {
          const double part
            = (members[i].centre[d] - box.lower_bound(d)) / box.side_length(d) * n_cells[d];
          cell_of_member[i][d] = static_cast<std::size_t>(std::clamp(part, 0., n_cells[d] - 1.));
          place                = place * n_cells[d] + cell_of_member[i][d];
        }
      cells[place].push_back(i);
    }
}

template <int dim>
template <typename Function>
void
GrowingShapes<dim>::for_each_pair(const Function &function)
{
  for (unsigned int i = 0; i < members.size(); ++i)
    for (int k = 0; k < (dim == 2 ? 9 : 27); ++k)
      {
        std::size_t place = 0;
        bool        is_in = true;
        for (int d = dim - 1; d >= 0; --d)
          {
            const std::size_t next = cell_of_member[i][d]
                                     + (d == 0   ? k
                                        : d == 1 ? k / 3
                                                 : k / 9)
                                         % 3;
            is_in = is_in && next > 0 && next <= n_cells[d];
            place = place * n_cells[d] + next - 1;
          }
        if (is_in)
          for (const unsigned int j : cells[place])
            if (j > i)
              function(members[i], members[j]);
      }
}

template <int dim>
void
GrowingShapes<dim>::turn(Member &member, const Tensor<1, dim> &at, const Tensor<1, dim> &push)
{
  if (!member.is_round)
    member.rotation
      = small_rotation<dim>(1. / member.gyration * moment<dim>(at, push)) * member.rotation;
}

template <int dim>
double
GrowingShapes<dim>::push_inside(Member &member, const double scale) const
{
  const auto &box     = container.box;
  double      largest = 0.;
  // What a wall with normal n asks of the member, of which it takes a part by turning.
  const auto yield = [&](const Tensor<1, dim> &n, const double overlap) {
    const Tensor<1, dim> at    = member.support(n);
    const double         lever = moment<dim>(at, n).norm_square() / member.gyration;
    turn(member, at, -overlap / scale / (1. + lever) * n);
  };
  for (unsigned int d = container.first_flat(); d < dim; ++d)
    {
      const Tensor<1, dim> n = Point<dim>::unit_vector(d);
      const auto           reach
        = [&](const double sign) { return scale * (sign * member.support(sign * n)[d]); };
      const double before = member.centre[d];
      const auto   clamp  = [&]() {
        const double below = reach(-1.), above = reach(1.);
        return below + above > box.side_length(d)
                    ? std::numeric_limits<double>::infinity()
                    : std::clamp(before, box.lower_bound(d) + below, box.upper_bound(d) - above);
      };
      double after = clamp();
      if (!member.is_round && std::isfinite(after) && after != before)
        {
          yield(after > before ? -1. * n : n, std::abs(after - before));
          largest = std::max(largest, std::abs(after - before));
          after   = clamp();
        }
      largest = std::max(largest, std::abs(after - before));
      if (!std::isfinite(after))
        return after;
      member.centre[d] = after;
    }
  if (container.is_cylinder)
    {
      const auto overlap = [&](const Tensor<1, dim> &n) {
        return n * container.from_axis(member.centre) + scale * (n * member.support(n))
               - container.radius;
      };
      Tensor<1, dim> n = container.towards_round_wall(member.turned(), member.centre, scale);
      if (n.norm_square() > 0. && overlap(n) > 0.)
        {
          largest = std::max(largest, overlap(n));
          if (!member.is_round)
            {
              yield(n, overlap(n));
              n = container.towards_round_wall(member.turned(), member.centre, scale);
            }
          if (n.norm_square() > 0. && overlap(n) > 0.)
            member.centre -= overlap(n) * n;
        }
    }
  return largest;
}

template <int dim>
double
GrowingShapes<dim>::push_apart(Member &a, Member &b, const double scale,
                               const double tolerance) const
{
  const Tensor<1, dim> arm   = b.centre - a.centre;
  const double         reach = scale * (a.radius + b.radius), square = arm * arm;
  if (!(square < reach * reach))
    return 0.;
  const double   distance = std::sqrt(square);
  Tensor<1, dim> normal;
  normal[0] = 1.;
  if (distance > 0.)
    normal = arm / distance;
  if (a.is_round && b.is_round)
    {
      const double half = 0.5 * (reach - distance);
      a.centre -= half * normal;
      b.centre += half * normal;
      return 2. * half;
    }
  const Touch<dim> touch
    = touching_scale(a.turned(), b.turned(), distance > 0. ? arm : 1e-10 * reach * normal,
                     0.1 * tolerance, scale, a.guess(&b - members.data()));
  if (!(touch.scale < scale))
    return 0.;
  const double          overlap = (scale - touch.scale) * touch.reach;
  const Tensor<1, dim> &n       = touch.normal;
  const double          share   = 2. + moment<dim>(touch.on_a, n).norm_square() / a.gyration
                       + moment<dim>(touch.on_b, n).norm_square() / b.gyration;
  const Tensor<1, dim> push = over_relaxation * overlap / share * n;
  a.centre -= push;
  b.centre += push;
  turn(a, touch.on_a, -1. / scale * push);
  turn(b, touch.on_b, 1. / scale * push);
  return overlap;
}

template <int dim>
bool
GrowingShapes<dim>::relax(const double scale, const double tolerance)
{
  for (unsigned int sweep = 0; sweep < most_sweeps(); ++sweep)
    {
      double largest = 0.;
      for (auto &member : members)
        largest = std::max(largest, push_inside(member, scale));
      if (!std::isfinite(largest))
        return false;
      sort(scale);
      for_each_pair([&](Member &a, Member &b) {
        largest = std::max(largest, push_apart(a, b, scale, tolerance));
      });
      if (largest < tolerance * scale)
        return true;
    }
  return false;
}

template <int dim>
double
GrowingShapes<dim>::largest_scale()
{
  constexpr double tolerance = 1e-13;
  const auto      &box       = container.box;
  double           scale     = std::numeric_limits<double>::max();
  for (const auto &member : members)
    for (unsigned int d = container.first_flat(); d < dim; ++d)
      {
        const Tensor<1, dim> n = Point<dim>::unit_vector(d);
        scale
          = std::min({scale, (member.centre[d] - box.lower_bound(d)) / -member.support(-1. * n)[d],
                      (box.upper_bound(d) - member.centre[d]) / member.support(n)[d]});
      }
  for_each_pair([&](const Member &a, const Member &b) {
    const Tensor<1, dim> arm   = b.centre - a.centre;
    const double         apart = std::sqrt(arm * arm) / (a.radius + b.radius);
    if (a.is_round && b.is_round)
      scale = std::min(scale, apart);
    else if (apart < scale)
      {
        TouchGuess<dim> none;
        scale = std::min(scale,
                         touching_scale(a.turned(), b.turned(), arm, tolerance, scale, none).scale);
      }
  });
  // A smaller scale moves the point that is farthest from the axis: until it does not.
  if (container.is_cylinder)
    for (const auto &member : members)
      for (bool is_less = true; is_less;)
        {
          const Tensor<1, dim> n
            = container.towards_round_wall(member.turned(), member.centre, scale);
          const double fits
            = (container.radius - n * container.from_axis(member.centre)) / (n * member.support(n));
          is_less = n.norm_square() > 0. && fits < scale * (1. - tolerance);
          scale   = n.norm_square() > 0. ? std::min(scale, fits) : scale;
        }
  return scale;
}
} // namespace

template <int dim>
RandomPacking<dim>
pack_at_random(const PackingParameters<dim> &parameters)
{
  GrowingShapes<dim> growing(parameters);
  constexpr double   first_part = 0.4, first_growth = 0.02, last_growth = 1e-3;
  constexpr double   while_growing = 5e-3, at_last = 1e-4; // overlaps
  const double       filling = growing.filling_scale();
  const double wanted = parameters.solid_fraction ? filling * root<dim>(*parameters.solid_fraction)
                                                  : std::numeric_limits<double>::max();
  const double last   = (1. + 2. * at_last) * wanted; // overlaps that stay then do not matter
  double       scale  = std::min(first_part * filling, last);
  while (!growing.relax(scale, while_growing))
    scale *= 0.8;
  for (double growth = first_growth; growth > last_growth && scale < last;)
    {
      const auto   before = growing.members;
      const double next   = std::min((1. + growth) * scale, last);
      if (growing.relax(next, while_growing))
        scale = next;
      else
        {
          growing.members = before;
          growth *= 0.5;
        }
    }
  // What overlaps a little gives way.
  while (!growing.relax(scale, at_last))
    scale *= 1. - 0.5 * while_growing;
  scale = std::min(growing.largest_scale(), wanted);
  RandomPacking<dim> result;
  result.solid_fraction = dim == 2 ? 1. : scale / filling;
  result.solid_fraction *= scale / filling * (scale / filling);
  for (const auto &member : growing.members)
    result.members.push_back({member.centre, member.rotation, member.shape->scaled(scale)});
  return result;
}

template RandomPacking<2> pack_at_random(const PackingParameters<2> &);
template RandomPacking<3> pack_at_random(const PackingParameters<3> &);
} // namespace scree
