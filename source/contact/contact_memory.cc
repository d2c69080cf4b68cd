#include <scree/base/joint_sum.h>
#include <scree/contact/contact_memory.h>
#include <scree/contact/surface_fit.h>
#include <scree/points/point_search.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace scree
{
using namespace dealii;

namespace
{
constexpr double reach_in_cells  = 2.;
constexpr double smallest_cosine = 0.5; // between the normals of neighbours

/** R v for v normal to `from`, R the smallest rotation of the unit vector `from` to `to`. */
template <int dim>
Tensor<1, dim>
turned(const Tensor<1, dim> &v, const Tensor<1, dim> &from, const Tensor<1, dim> &to)
{
  return v - (to * v) / (1. + from * to) * (from + to);
}

/** Finds remembered points. */
template <int dim>
class SurfaceSearch
{
public:
  explicit SurfaceSearch(const ContactMemory<dim> &memory)
      : memory(memory)
      , largest_cell(memory.size() == 0
                       ? 1.
                       : *std::max_element(memory.cell_size.begin(), memory.cell_size.end()))
      , search(memory.position, numbers(), 0.5 * reach_in_cells * largest_cell)
  {
  }

  /**
   * Neighbours of x, weighted by `weight(d^2, d^2/r^2)`. A point at x is the only neighbour of x if
   * `is_interpolating`.
   */
  template <typename Weight>
  void find(const std::pair<unsigned int, unsigned int> &bodies, const ContactPoint<dim> &x,
            const bool is_interpolating, const Weight &weight,
            std::vector<SurfaceNeighbour<dim>> &neighbours) const
  {
    neighbours.clear();
    const auto pair = pair_numbers.find(bodies);
    if (pair == pair_numbers.end())
      return;
    const auto   tangent = surface_tangents<dim>(x.normal);
    const double radius  = reach_in_cells * std::max(x.cell_size, largest_cell);
    search.for_each_within(
      pair->second, x.position, radius, [&](const unsigned int entry, const double square) {
        const double reach = reach_in_cells * std::max(x.cell_size, memory.cell_size[entry]);
        if (square >= reach * reach || x.normal * memory.normal[entry] < smallest_cosine)
          return;
        SurfaceNeighbour<dim> neighbour{entry,
                                        square,
                                        weight(square, square / (reach * reach)),
                                        {}};
        const Tensor<1, dim>  arm = memory.position[entry] - x.position;
        for (unsigned int k = 0; k < dim - 1; ++k)
          neighbour.place[k] = tangent[k] * arm;
        neighbours.push_back(neighbour);
      });
    if (is_interpolating)
      keep_coinciding(1e-9 * x.cell_size, neighbours);
    double sum = 0.;
    for (const auto &neighbour : neighbours)
      sum += neighbour.weight;
    for (auto &neighbour : neighbours)
      neighbour.weight /= sum;
  }

private:
  static void keep_coinciding(const double                        tolerance,
                              std::vector<SurfaceNeighbour<dim>> &neighbours)
  {
    const auto nearest
      = std::min_element(neighbours.begin(), neighbours.end(),
                         [](const auto &p, const auto &q) { return p.square < q.square; });
    if (nearest != neighbours.end() && nearest->square <= tolerance * tolerance)
      neighbours = {*nearest};
  }

  /** Numbers of the pairs of all entries. */
  std::vector<unsigned int> numbers()
  {
    std::vector<unsigned int> result;
    result.reserve(memory.size());
    for (std::size_t i = 0; i < memory.size(); ++i)
      result.push_back(
        pair_numbers
          .emplace(std::make_pair(memory.body_a[i], memory.body_b[i]), pair_numbers.size())
          .first->second);
    return result;
  }

  const ContactMemory<dim>                                     &memory;
  double                                                        largest_cell;
  std::map<std::pair<unsigned int, unsigned int>, unsigned int> pair_numbers;
  PointSearch<dim>                                              search;
};

double
length(const double value)
{
  return std::abs(value);
}

template <int dim>
double
length(const Tensor<1, dim> &value)
{
  return value.norm();
}

/** sum_i factors_i values_i over the neighbours, bounded as recall() says. */
template <int dim, typename T>
T
bounded_fit(const std::vector<SurfaceNeighbour<dim>> &neighbours,
            const std::vector<double> &factors, const bool is_outside, const std::vector<T> &values)
{
  T      mean{}, change{};
  double scatter = 0., largest = 0.;
  for (unsigned int i = 0; i < values.size(); ++i)
    mean += neighbours[i].weight * values[i];
  for (unsigned int i = 0; i < values.size(); ++i)
    {
      change += factors[i] * (values[i] - mean);
      scatter = std::max(scatter, length(values[i] - mean));
      largest = std::max(largest, length(values[i]));
    }
  if (length(change) > scatter)
    change *= scatter / length(change);
  T result = mean + change;
  if (!is_outside)
    return result;
  if (result * mean < 0.)
    return T{};
  if (length(result) > largest)
    result *= largest / length(result);
  return result;
}

/** Derivatives of f(entry), a position, along the tangents. */
template <int dim, typename F>
SurfaceTangents<dim>
slopes(const std::vector<SurfaceNeighbour<dim>> &neighbours, const LinearFit<dim> &fit, const F &f)
{
  SurfaceTangents<dim> result;
  for (unsigned int k = 0; k < dim - 1; ++k)
    {
      Tensor<1, dim - 1> axis;
      axis[k]              = 1.;
      const auto direction = fit.direction(axis);
      for (const auto &neighbour : neighbours)
        result[k]
          += neighbour.weight * (direction * (neighbour.place - fit.mean)) * f(neighbour.entry);
    }
  return result;
}

/** T = E (T^T T)^{1/2}: the orthonormal frame E of two tangents T, its normal, the area ratio. */
template <int dim>
struct SurfaceFrame
{
  explicit SurfaceFrame(const SurfaceTangents<dim> &T)
  {
    SymmetricTensor<2, dim - 1> metric;
    for (unsigned int k = 0; k < dim - 1; ++k)
      for (unsigned int l = 0; l <= k; ++l)
        metric[k][l] = T[k] * T[l];
    area                             = std::sqrt(determinant(metric));
    SymmetricTensor<2, dim - 1> root = metric; // S^{1/2} = (S + J I)/(tr S + 2 J)^{1/2} in 3D
    for (unsigned int k = 0; k < dim - 1; ++k)
      root[k][k] += area;
    root /= dim == 2 ? 1. + area : std::sqrt(trace(metric) + 2. * area);
    const SymmetricTensor<2, dim - 1> inverse = invert(root);
    for (unsigned int k = 0; k < dim - 1; ++k)
      for (unsigned int l = 0; l < dim - 1; ++l)
        E[k] += inverse[k][l] * T[l];
    normal = surface_normal<dim>(E);
  }

  /** R v, R the rotation of this frame to the other one. */
  Tensor<1, dim> turned(const Tensor<1, dim> &v, const SurfaceFrame &to) const
  {
    Tensor<1, dim> result = (normal * v) * to.normal;
    for (unsigned int k = 0; k < dim - 1; ++k)
      result += (E[k] * v) * to.E[k];
    return result;
  }

  double               area;
  SurfaceTangents<dim> E;
  Tensor<1, dim>       normal;
};

/** A row of numbers per point, all processes' rows in the order of bodies and places. */
template <int dim>
std::vector<std::vector<double>>
gathered_rows(const ContactPoints<dim> &contact, const MPI_Comm communicator)
{
  std::vector<std::vector<double>> rows;
  for (unsigned int i = 0; i < contact.points().size(); ++i)
    {
      const ContactPoint<dim> &point    = contact.points()[i];
      const auto              &response = contact.responses()[i];
      if (response.status == ContactStatus::open && contact.gap(i) > point.cell_size)
        continue;
      const ContactPair &pair = contact.pairs()[point.pair];
      if (pair.law.kind->glues && !point.is_glued)
        continue;
      std::vector<double> row = {double(pair.a), double(pair.b)};
      const auto          add = [&row](const Tensor<1, dim> &vector) {
        row.insert(row.end(), vector.begin_raw(), vector.end_raw());
      };
      add(point.position);
      row.insert(row.end(), {point.weight, point.cell_size, response.pressure});
      add(point.start_normal);
      add(turned(response.tau, point.normal, point.start_normal));
      add(contact.mean_displacements()[i]);
      rows.push_back(row);
    }
  std::vector<std::vector<double>> result;
  for (auto &of_process : Utilities::MPI::all_gather(communicator, rows))
    result.insert(result.end(), of_process.begin(), of_process.end());
  std::sort(result.begin(), result.end());
  return result;
}
} // namespace

template <int dim>
ContactMemory<dim>
remember(const ContactPoints<dim> &contact, const MPI_Comm communicator)
{
  ContactMemory<dim>          memory;
  std::vector<Tensor<1, dim>> displacement;
  for (const auto &row : gathered_rows(contact, communicator))
    {
      const double *next   = row.data();
      const auto    vector = [&next] {
        Tensor<1, dim> result;
        std::copy_n(next, dim, result.begin_raw());
        next += dim;
        return result;
      };
      memory.body_a.push_back(static_cast<unsigned int>(*next++));
      memory.body_b.push_back(static_cast<unsigned int>(*next++));
      memory.position.push_back(Point<dim>(vector()));
      memory.weight.push_back(*next++);
      memory.cell_size.push_back(*next++);
      memory.pressure.push_back(*next++);
      memory.normal.push_back(vector());
      memory.tau.push_back(vector());
      displacement.push_back(vector());
    }
  return moved(memory, displacement);
}

template <int dim>
ContactMemory<dim>
moved(const ContactMemory<dim> &memory, const std::vector<Tensor<1, dim>> &displacement)
{
  AssertDimension(displacement.size(), memory.size());
  const SurfaceSearch<dim>           search(memory);
  std::vector<SurfaceNeighbour<dim>> neighbours;
  ContactMemory<dim>                 result = memory;
  for (std::size_t i = 0; i < memory.size(); ++i)
    {
      result.position[i] += displacement[i];
      search.find(
        {memory.body_a[i], memory.body_b[i]},
        {0, memory.position[i], memory.normal[i], 0., 0., memory.cell_size[i]}, false,
        [](const double, const double ratio) { return (1. - ratio) * (1. - ratio); }, neighbours);
      const LinearFit<dim> fit(neighbours, memory.cell_size[i]);
      if (!fit.is_linear)
        continue;
      const SurfaceFrame<dim> before(slopes(neighbours, fit, [&](const unsigned int entry) {
        return memory.position[entry] - memory.position[i];
      }));
      const SurfaceFrame<dim> after(slopes(neighbours, fit, [&](const unsigned int entry) {
        return memory.position[entry] - memory.position[i] + displacement[entry] - displacement[i];
      }));
      const double            stretch = after.area / before.area;
      if (!(stretch > 0.1))
        continue; // the step folds the surface
      result.normal[i] = before.turned(memory.normal[i], after);
      result.tau[i]    = before.turned(memory.tau[i], after) / stretch;
      result.weight[i] *= stretch;
      result.pressure[i] /= stretch;
    }
  return result;
}

template <int dim>
ContactHistory<dim>
recall(const std::vector<ContactPoint<dim>> &points, const std::vector<ContactPair> &pairs,
       const ContactMemory<dim> &memory)
{
  const std::vector<Tensor<1, dim>>  zeros(points.size());
  ContactHistory<dim>                history{zeros, zeros, std::vector<double>(points.size())};
  const SurfaceSearch<dim>           search(memory);
  std::vector<SurfaceNeighbour<dim>> neighbours;
  std::vector<Tensor<1, dim>>        tau;
  std::vector<double>                factors, pressure;
  for (std::size_t i = 0; i < points.size(); ++i)
    {
      const ContactPoint<dim> &point   = points[i];
      const ContactPair       &pair    = pairs[point.pair];
      const double             minimum = 1e-12 * point.cell_size * point.cell_size;
      if (pair.law.kind->glues && !point.is_glued)
        continue;
      search.find(
        {pair.a, pair.b}, point, true,
        [minimum](const double square, const double ratio) {
          return (1. - ratio) * (1. - ratio) / (square + minimum);
        },
        neighbours);
      if (neighbours.empty())
        continue;
      const InterpolatingFit<dim> fit(neighbours, point.cell_size);
      factors.clear();
      tau.clear();
      pressure.clear();
      for (const auto &neighbour : neighbours)
        {
          factors.push_back(fit.factor(neighbour));
          tau.push_back(
            turned(memory.tau[neighbour.entry], memory.normal[neighbour.entry], point.normal));
          pressure.push_back(memory.pressure[neighbour.entry]);
        }
      history.tau[i]      = bounded_fit(neighbours, factors, fit.is_outside, tau);
      history.pressure[i] = bounded_fit(neighbours, factors, fit.is_outside, pressure);
    }
  return history;
}

template <int dim>
ContactHistory<dim>
recall(const ContactPoints<dim> &contact, const ContactMemory<dim> &memory)
{
  return recall(contact.points(), contact.pairs(), memory);
}

template <int dim>
std::vector<TransferredForce<dim>>
transferred_forces(const ContactPoints<dim> &contact, const ContactMemory<dim> &memory,
                   const ContactHistory<dim> &history, const MPI_Comm communicator)
{
  std::vector<TransferredForce<dim>>                            result(contact.pairs().size());
  std::map<std::pair<unsigned int, unsigned int>, unsigned int> number;
  for (unsigned int p = 0; p < contact.pairs().size(); ++p)
    number[{contact.pairs()[p].a, contact.pairs()[p].b}] = p;
  for (std::size_t i = 0; i < memory.size(); ++i)
    {
      const auto pair = number.find({memory.body_a[i], memory.body_b[i]});
      if (pair == number.end())
        continue;
      TransferredForce<dim> &force = result[pair->second];
      force.tangential_before += memory.weight[i] * memory.tau[i];
      force.total_before
        += memory.weight[i] * (memory.pressure[i] * memory.normal[i] + memory.tau[i]);
    }
  for (std::size_t i = 0; i < contact.points().size(); ++i)
    {
      const ContactPoint<dim> &point = contact.points()[i];
      TransferredForce<dim>   &force = result[point.pair];
      const Tensor<1, dim>     tau   = turned(history.tau[i], point.normal, point.start_normal);
      force.tangential_after += point.weight * tau;
      force.total_after += point.weight * (history.pressure[i] * point.start_normal + tau);
    }
  JointSum sum;
  for (auto &force : result)
    {
      sum.add(force.tangential_after);
      sum.add(force.total_after);
    }
  sum.reduce(communicator);
  return result;
}

template <int dim>
void
keep_resultants(const ContactPoints<dim> &contact, const ContactMemory<dim> &memory,
                ContactHistory<dim> &history, const MPI_Comm communicator)
{
  constexpr double    largest_change = 0.1;
  const auto          forces         = transferred_forces(contact, memory, history, communicator);
  std::vector<double> sizes(forces.size());
  for (std::size_t i = 0; i < contact.points().size(); ++i)
    sizes[contact.points()[i].pair] += contact.points()[i].weight * history.tau[i].norm();
  Utilities::MPI::sum(sizes, communicator, sizes);
  for (std::size_t i = 0; i < contact.points().size(); ++i)
    {
      const ContactPoint<dim>     &point   = contact.points()[i];
      const TransferredForce<dim> &force   = forces[point.pair];
      const double                 size    = sizes[point.pair];
      const Tensor<1, dim>         missing = force.tangential_before - force.tangential_after;
      if (!(missing.norm() < largest_change * size))
        continue;
      const Tensor<1, dim> &n = point.start_normal;
      history.tau[i]
        += turned(history.tau[i].norm() / size * (missing - (missing * n) * n), n, point.normal);
    }
}

#define SCREE_INSTANTIATE(dim)                                                                 \
  template ContactMemory<dim>  remember(const ContactPoints<dim> &, const MPI_Comm);           \
  template ContactMemory<dim>  moved(const ContactMemory<dim> &,                               \
                                     const std::vector<Tensor<1, dim>> &);                     \
  template ContactHistory<dim> recall(const std::vector<ContactPoint<dim>> &,                  \
                                      const std::vector<ContactPair> &,                        \
                                      const ContactMemory<dim> &);                             \
  template ContactHistory<dim> recall(const ContactPoints<dim> &, const ContactMemory<dim> &); \
  template void keep_resultants(const ContactPoints<dim> &, const ContactMemory<dim> &,        \
                                ContactHistory<dim> &, const MPI_Comm);                        \
  template std::vector<TransferredForce<dim>> transferred_forces(                              \
    const ContactPoints<dim> &, const ContactMemory<dim> &, const ContactHistory<dim> &,       \
    const MPI_Comm);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
