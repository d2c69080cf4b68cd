#include <scree/geometry/ball_packing.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

namespace scree
{
using namespace dealii;

namespace
{
/** Uniform in [0, 1) by 53 bits: distributions of the standard library differ between libraries. */
double
uniform(std::mt19937_64 &random)
{
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

/** The square or cubic root of a positive number, by Newton steps from above. */
template <int dim>
double
root(const double x)
{
  double result = std::max(x, 1.);
  for (unsigned int i = 0; i < 2000; ++i)
    {
      const double next
        = dim == 2 ? 0.5 * (result + x / result) : (2. * result + x / (result * result)) / 3.;
      if (!(next < result))
        break;
      result = next;
    }
  return result;
}

/** Balls that grow in a box. */
template <int dim>
class GrowingBalls
{
public:
  explicit GrowingBalls(const PackingParameters<dim> &parameters);

  /** The scale of the radii at which the balls have the volume of the box. */
  double filling_scale() const;

  /** Pushes balls of `scale` times their radii apart; false if overlaps of `tolerance` radii stay.
   */
  bool relax(const double scale, const double tolerance);

  /** The largest scale without overlap. */
  double largest_scale();

  std::vector<PackedBall<dim>> balls;

private:
  static constexpr unsigned int most_sweeps = 1000;

  /** Sorts the balls into cells somewhat wider than the widest pair. */
  void sort(const double scale);

  /** Calls `function(a, b)` for the pairs of balls of neighbouring cells, in a fixed order. */
  template <typename Function>
  void for_each_pair(const Function &function);

  BoundingBox<dim>                          box;
  std::array<std::size_t, dim>              n_cells;
  std::vector<std::array<std::size_t, dim>> cell_of_ball;
  std::vector<std::vector<unsigned int>>    cells;
};

template <int dim>
GrowingBalls<dim>::GrowingBalls(const PackingParameters<dim> &parameters)
    : box(parameters.box)
{
  std::mt19937_64 random(parameters.seed);
  for (unsigned int i = 0; i < parameters.n; ++i)
    {
      PackedBall<dim> ball;
      for (unsigned int d = 0; d < dim; ++d)
        ball.centre[d] = box.lower_bound(d) + uniform(random) * box.side_length(d);
      ball.radius = 1. + uniform(random) * (parameters.size_ratio - 1.);
      balls.push_back(ball);
    }
}

template <int dim>
double
GrowingBalls<dim>::filling_scale() const
{
  double sum = 0.;
  for (const auto &ball : balls)
    sum += (dim == 2 ? 1. : 4. / 3. * ball.radius) * ball.radius * ball.radius * numbers::PI;
  return root<dim>(box.volume() / sum);
}

template <int dim>
void
GrowingBalls<dim>::sort(const double scale)
{
  double largest = 0.;
  for (const auto &ball : balls)
    largest = std::max(largest, ball.radius);
  const double most = 2. * root<dim>(balls.size()) + 1.;
  std::size_t  n    = 1;
  for (unsigned int d = 0; d < dim; ++d)
    {
      n_cells[d] = static_cast<std::size_t>(
        std::clamp(box.side_length(d) / (2.2 * scale * largest), 1., most));
      n *= n_cells[d];
    }
  cells.assign(n, {});
  cell_of_ball.resize(balls.size());
  for (unsigned int i = 0; i < balls.size(); ++i)
    {
      std::size_t place = 0;
      for (int d = dim - 1; d >= 0; --d)
        {
          const double part
            = (balls[i].centre[d] - box.lower_bound(d)) / box.side_length(d) * n_cells[d];
          cell_of_ball[i][d] = static_cast<std::size_t>(std::clamp(part, 0., n_cells[d] - 1.));
          place              = place * n_cells[d] + cell_of_ball[i][d];
        }
      cells[place].push_back(i);
    }
}

template <int dim>
template <typename Function>
void
GrowingBalls<dim>::for_each_pair(const Function &function)
{
  for (unsigned int i = 0; i < balls.size(); ++i)
    for (int k = 0; k < (dim == 2 ? 9 : 27); ++k)
      {
        std::size_t place = 0;
        bool        is_in = true;
        for (int d = dim - 1; d >= 0; --d)
          {
            const std::size_t next = cell_of_ball[i][d] + (d == 0 ? k : d == 1 ? k / 3 : k / 9) % 3;
            is_in                  = is_in && next > 0 && next <= n_cells[d];
            place                  = place * n_cells[d] + next - 1;
          }
        if (is_in)
          for (const unsigned int j : cells[place])
            if (j > i)
              function(balls[i], balls[j]);
      }
}

template <int dim>
bool
GrowingBalls<dim>::relax(const double scale, const double tolerance)
{
  for (unsigned int sweep = 0; sweep < most_sweeps; ++sweep)
    {
      double largest = 0.;
      for (auto &ball : balls)
        for (unsigned int d = 0; d < dim; ++d)
          {
            const double r = scale * ball.radius, before = ball.centre[d];
            if (2. * r > box.side_length(d))
              return false;
            ball.centre[d] = std::clamp(before, box.lower_bound(d) + r, box.upper_bound(d) - r);
            largest        = std::max(largest, std::abs(ball.centre[d] - before));
          }
      sort(scale);
      for_each_pair([&](PackedBall<dim> &a, PackedBall<dim> &b) {
        const Tensor<1, dim> arm   = b.centre - a.centre;
        const double         reach = scale * (a.radius + b.radius), square = arm * arm;
        if (!(square < reach * reach))
          return;
        const double   distance = std::sqrt(square);
        Tensor<1, dim> normal;
        normal[0] = 1.;
        if (distance > 0.)
          normal = arm / distance;
        const double half = 0.5 * (reach - distance);
        a.centre -= half * normal;
        b.centre += half * normal;
        largest = std::max(largest, 2. * half);
      });
      if (largest < tolerance * scale)
        return true;
    }
  return false;
}

template <int dim>
double
GrowingBalls<dim>::largest_scale()
{
  double scale = std::numeric_limits<double>::max();
  for (const auto &ball : balls)
    for (unsigned int d = 0; d < dim; ++d)
      scale = std::min({scale, (ball.centre[d] - box.lower_bound(d)) / ball.radius,
                        (box.upper_bound(d) - ball.centre[d]) / ball.radius});
  for_each_pair([&](const PackedBall<dim> &a, const PackedBall<dim> &b) {
    const Tensor<1, dim> arm = b.centre - a.centre;
    scale                    = std::min(scale, std::sqrt(arm * arm) / (a.radius + b.radius));
  });
  return scale;
}
} // namespace

template <int dim>
std::vector<PackedBall<dim>>
pack_balls(const PackingParameters<dim> &parameters)
{
  GrowingBalls<dim> growing(parameters);
  constexpr double  first_part = 0.4, first_growth = 0.02, last_growth = 1e-3;
  constexpr double  while_growing = 5e-3, at_last = 1e-4; // overlaps
  double            scale = first_part * growing.filling_scale();
  while (!growing.relax(scale, while_growing))
    scale *= 0.8;
  for (double growth = first_growth; growth > last_growth;)
    {
      const auto before = growing.balls;
      if (growing.relax((1. + growth) * scale, while_growing))
        scale *= 1. + growth;
      else
        {
          growing.balls = before;
          growth *= 0.5;
        }
    }
  // What overlaps a little gives way.
  while (!growing.relax(scale, at_last))
    scale *= 1. - 0.5 * while_growing;
  scale = growing.largest_scale();
  for (auto &ball : growing.balls)
    ball.radius *= scale;
  return growing.balls;
}

template std::vector<PackedBall<2>> pack_balls(const PackingParameters<2> &);
template std::vector<PackedBall<3>> pack_balls(const PackingParameters<3> &);
} // namespace scree
