#include <scree/level_set/map_velocity.h>

#include <algorithm>
#include <cmath>

#if defined(__GNUC__) && !defined(__clang__)
#  pragma GCC optimize("O3")
#endif

// One version per instruction set, chosen when the program starts.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#  define SCREE_CLONES __attribute__((target_clones("arch=haswell", "default")))
#  define SCREE_INLINE inline __attribute__((always_inline))
#else
#  define SCREE_CLONES
#  define SCREE_INLINE inline
#endif

namespace scree
{
/** The nodes of a run, and the fields that are interpolated at their departure points. */
struct DepartureRun
{
  int            n;
  int            n_nodes[3]; // of the grid
  std::ptrdiff_t stride[3];  // of the grid, without halo
  int            node[3];    // the first one
  std::ptrdiff_t position;   // of the first node in the fields
  const double  *field[3];
  double        *displacement[3]; // of the run: sought
  const double  *known[3];        // of the run: given displacements
  double        *result;          // of the run: the field at the departure points
  double         tau_over_h;
  double         tolerance; // length
};

namespace
{
// A point in the cells between the nodes: the first of its 4 nodes per direction and their weights.
template <int dim>
struct CubicStencil
{
  std::ptrdiff_t first;
  double         weights[dim][4];
};

// Lagrange weights for the nodes 0, ..., 3, linear extrapolation beyond them.
SCREE_INLINE void
set_weights(const double t, double (&w)[4])
{
  const double b = t - 1, c = t - 2, d = t - 3;
  w[0] = -b * c * d * (1. / 6);
  w[1] = t * c * d * 0.5;
  w[2] = -t * b * d * 0.5;
  w[3] = t * b * c * (1. / 6);
  if (t < 0)
    {
      w[0] = 1 - t;
      w[1] = t;
      w[2] = w[3] = 0;
    }
  if (t > 3)
    {
      w[0] = w[1] = 0;
      w[2]        = 3 - t;
      w[3]        = t - 2;
    }
}

template <int dim>
SCREE_INLINE CubicStencil<dim>
             stencil_at(const DepartureRun &run, const double (&x)[dim])
{
  CubicStencil<dim> result;
  result.first = 0;
  for (int d = 0; d < dim; ++d)
    {
      // the position of a clamped number is not negative: truncation is the floor
      const int base = static_cast<int>(std::min(std::max(x[d] - 1, 0.), run.n_nodes[d] - 4.));
      set_weights(x[d] - base, result.weights[d]);
      result.first += base * run.stride[d];
    }
  return result;
}

template <int dim>
SCREE_INLINE double
interpolate(const DepartureRun &run, const CubicStencil<dim> &at, const double *const field)
{
  double columns[4] = {0, 0, 0, 0}; // sums over the rows of the stencil
  for (int k = 0; k < (dim == 3 ? 4 : 1); ++k)
    for (int j = 0; j < 4; ++j)
      {
        const double  w = dim == 3 ? at.weights[dim - 1][k] * at.weights[1][j] : at.weights[1][j];
        const double *row
          = field + at.first + j * run.stride[1] + (dim == 3 ? k * run.stride[2] : 0);
        for (int i = 0; i < 4; ++i)
          columns[i] += w * row[i];
      }
  return (columns[0] * at.weights[0][0] + columns[1] * at.weights[0][1])
         + (columns[2] * at.weights[0][2] + columns[3] * at.weights[0][3]);
}

// (I + tau grad du)^{-1} at a node, by central differences, one-sided at the ends.
template <int dim>
SCREE_INLINE void
inverse_jacobian(const DepartureRun &run, const int x, double (&inverse)[dim][dim])
{
  double               J[dim][dim];
  const std::ptrdiff_t at = run.position + x;
  for (int d = 0; d < dim; ++d)
    {
      const int            node  = run.node[d] + (d == 0 ? x : 0);
      const std::ptrdiff_t below = node > 0 ? run.stride[d] : 0,
                           above = node + 1 < run.n_nodes[d] ? run.stride[d] : 0;
      const double scale         = run.tau_over_h * (below != 0 && above != 0 ? 0.5 : 1);
      for (int c = 0; c < dim; ++c)
        J[c][d]
          = (c == d ? 1. : 0.) + scale * (run.field[c][at + above] - run.field[c][at - below]);
    }
  if constexpr (dim == 2)
    {
      inverse[0][0] = J[1][1];
      inverse[0][1] = -J[0][1];
      inverse[1][0] = -J[1][0];
      inverse[1][1] = J[0][0];
    }
  else
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        {
          const int a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
          inverse[i][j] = J[a][c] * J[b][d] - J[a][d] * J[b][c];
        }
  double determinant = 0;
  for (int d = 0; d < dim; ++d)
    determinant += J[0][d] * inverse[d][0];
  const double factor = 1 / determinant;
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
      inverse[i][j] *= factor;
}

// Solves w = du(x - tau w) at a node of the run; true if converged, else w stays as it was.
template <int dim>
SCREE_INLINE bool
solve_at(const DepartureRun &run, const int i)
{
  double inverse[dim][dim], w[dim];
  inverse_jacobian<dim>(run, i, inverse);
  for (int d = 0; d < dim; ++d)
    w[d] = run.displacement[d][i];
  for (int iteration = 0; iteration < 30; ++iteration)
    {
      double X[dim], residual[dim], norm = 0;
      for (int d = 0; d < dim; ++d)
        X[d] = run.node[d] + (d == 0 ? i : 0) - run.tau_over_h * w[d];
      const CubicStencil<dim> at = stencil_at<dim>(run, X);
      for (int d = 0; d < dim; ++d)
        {
          residual[d] = w[d] - interpolate<dim>(run, at, run.field[d]);
          norm        = std::max(norm, std::abs(residual[d]));
        }
      double sum = 0;
      for (int c = 0; c < dim; ++c)
        {
          for (int d = 0; d < dim; ++d)
            w[c] -= inverse[c][d] * residual[d];
          sum += w[c];
        }
      if (!std::isfinite(sum))
        return false;
      if (norm < run.tolerance)
        {
          for (int d = 0; d < dim; ++d)
            run.displacement[d][i] = w[d];
          return true;
        }
    }
  return false;
}

template <int dim>
SCREE_INLINE int
solve_run(const DepartureRun &run)
{
  int n_unconverged = 0;
  for (int i = 0; i < run.n; ++i)
    n_unconverged += !solve_at<dim>(run, i);
  return n_unconverged;
}

template <int dim>
SCREE_INLINE void
evaluate_run(const DepartureRun &run)
{
  for (int i = 0; i < run.n; ++i)
    {
      double X[dim], outside = 0;
      for (int d = 0; d < dim; ++d)
        {
          const double x = run.node[d] + (d == 0 ? i : 0) - run.tau_over_h * run.known[d][i];
          X[d]           = std::min(std::max(x, 0.), run.n_nodes[d] - 1.);
          outside += (x - X[d]) * (x - X[d]);
        }
      run.result[i] = interpolate<dim>(run, stencil_at<dim>(run, X), run.field[0]);
      if (outside > 0)
        run.result[i] += std::sqrt(outside) / run.tau_over_h;
    }
}
} // namespace

SCREE_CLONES int
solve_departures_2d(const DepartureRun &run)
{
  return solve_run<2>(run);
}

SCREE_CLONES int
solve_departures_3d(const DepartureRun &run)
{
  return solve_run<3>(run);
}

SCREE_CLONES void
evaluate_departures_2d(const DepartureRun &run)
{
  evaluate_run<2>(run);
}

SCREE_CLONES void
evaluate_departures_3d(const DepartureRun &run)
{
  evaluate_run<3>(run);
}

namespace
{
template <int dim>
DepartureRun
departure_run(const NodeSet<dim> &nodes, const double tau)
{
  DepartureRun result{};
  for (int d = 0; d < dim; ++d)
    {
      result.n_nodes[d] = nodes.grid.n_nodes[d];
      result.stride[d]  = d == 0 ? 1 : result.stride[d - 1] * result.n_nodes[d - 1];
    }
  result.tau_over_h = tau / nodes.grid.spacing;
  result.tolerance  = 1e-8 * nodes.grid.spacing;
  return result;
}

template <int dim>
void
move_to(DepartureRun &departure, const NodeRun &run)
{
  departure.n        = run.n;
  departure.position = run.node;
  std::size_t rest   = run.node;
  for (int d = 0; d < dim; ++d)
    {
      departure.node[d] = static_cast<int>(rest % departure.n_nodes[d]);
      rest /= departure.n_nodes[d];
    }
}
} // namespace

template <int dim>
std::size_t
map_velocity(const NodeSet<dim> &nodes, const std::array<std::vector<double>, dim> &du,
             const double tau, std::array<std::vector<double>, dim> &velocity)
{
  DepartureRun departure     = departure_run(nodes, tau);
  std::size_t  n_unconverged = 0;
  for (int d = 0; d < dim; ++d)
    departure.field[d] = du[d].data();
  for (const NodeRun &run : nodes.runs)
    {
      move_to<dim>(departure, run);
      for (int d = 0; d < dim; ++d)
        departure.displacement[d] = velocity[d].data() + run.packed;
      n_unconverged += dim == 3 ? solve_departures_3d(departure) : solve_departures_2d(departure);
    }
  return n_unconverged;
}

template <int dim>
void
values_at_departure(const NodeSet<dim> &nodes, const std::vector<double> &phi,
                    const std::array<std::vector<double>, dim> &displacement,
                    std::vector<double>                        &result)
{
  DepartureRun departure = departure_run(nodes, 1.);
  departure.field[0]     = phi.data();
  result.resize(nodes.n_nodes);
  for (const NodeRun &run : nodes.runs)
    {
      move_to<dim>(departure, run);
      for (int d = 0; d < dim; ++d)
        departure.known[d] = displacement[d].data() + run.packed;
      departure.result = result.data() + run.packed;
      if (dim == 3)
        evaluate_departures_3d(departure);
      else
        evaluate_departures_2d(departure);
    }
}

#define SCREE_INSTANTIATE(dim)                                                                     \
  template std::size_t map_velocity<dim>(const NodeSet<dim> &,                                     \
                                         const std::array<std::vector<double>, dim> &, double,     \
                                         std::array<std::vector<double>, dim> &);                  \
  template void        values_at_departure<dim>(const NodeSet<dim> &, const std::vector<double> &, \
                                         const std::array<std::vector<double>, dim> &,      \
                                         std::vector<double> &);
SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
#undef SCREE_INSTANTIATE
} // namespace scree
