#include <scree/application/simulation.h>

#include <deal.II/base/mpi.h>

#include <array>
#include <cmath>
#include <limits>
#include <numeric>

// What a refinement study asks of a run.
namespace scree
{
template <int dim>
double
Simulation<dim>::n_level_set_values() const
{
  double sum = 0.;
  for (const Body<dim> &body : bodies)
    {
      double product = 1.;
      for (const auto n : body.level_set.n_nodes())
        product *= n;
      sum += product;
    }
  return sum;
}

template <int dim>
ErrorEstimate
Simulation<dim>::estimate_error() const
{
  ErrorEstimate result;
  if (is_moving())
    {
      // The recovery knows linear elasticity on a fixed geometry only.
      result.squares.assign(grid->n_owned_cells(), 0.);
      result.relative = std::numeric_limits<double>::quiet_NaN();
      return result;
    }
  result.squares       = recovery_errors(*fields, *quadrature, bodies, *bulk,
                                         equilibrium->with_ghosts(state.displacement));
  const double squares = dealii::Utilities::MPI::sum(
    std::accumulate(result.squares.begin(), result.squares.end(), 0.), communicator);
  const double energy = equilibrium->energies().strain;
  result.relative     = energy > 0. ? std::sqrt(squares / (2. * energy)) : 0.;
  return result;
}

template <int dim>
std::vector<bool>
Simulation<dim>::contact_cells() const
{
  // The cells around closed points: those that hold the corners of a cell centred at the point.
  std::vector<std::array<double, dim + 1>> closed;
  for (unsigned int i = 0; i < was_closed.size(); ++i)
    if (was_closed[i])
      {
        const ContactPoint<dim> &point = contact->points()[i];
        closed.emplace_back();
        for (unsigned int d = 0; d < dim; ++d)
          closed.back()[d] = point.position[d];
        closed.back()[dim] = point.cell_size;
      }
  std::vector<bool>  result(grid->n_owned_cells(), false);
  const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(communicator);
  for (const auto &of_rank : dealii::Utilities::MPI::all_gather(communicator, closed))
    for (const auto &point : of_rank)
      for (unsigned int corner = 0; corner < (1u << dim); ++corner)
        {
          dealii::Point<dim> position;
          for (unsigned int d = 0; d < dim; ++d)
            position[d] = point[d] + ((corner >> d) & 1u ? 0.5 : -0.5) * point[dim];
          const auto location = grid->locate(position);
          if (location.rank == rank)
            result[location.local_cell] = true;
        }
  return result;
}

#define SCREE_INSTANTIATE(dim)                                            \
  template double            Simulation<dim>::n_level_set_values() const; \
  template ErrorEstimate     Simulation<dim>::estimate_error() const;     \
  template std::vector<bool> Simulation<dim>::contact_cells() const;

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
