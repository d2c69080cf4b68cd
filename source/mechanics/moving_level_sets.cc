#include <scree/base/exceptions.h>
#include <scree/bodies/boundary_foot.h>
#include <scree/discretization/point_evaluator.h>
#include <scree/level_set/extension.h>
#include <scree/level_set/fast_marching.h>
#include <scree/level_set/pieces.h>
#include <scree/level_set/reboxing.h>
#include <scree/level_set/reinitialisation.h>
#include <scree/mechanics/moving_level_sets.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree
{
namespace
{
using Vector = dealii::TrilinosWrappers::MPI::Vector;

constexpr double unset = std::numeric_limits<double>::lowest();

template <int dim>
using Index = typename Lattice<dim>::Index;

/** Calls f(index, offset) for the nodes first <= index < end of a lattice, x fastest. */
template <int dim, typename F>
void
for_each_node(const Lattice<dim> &lattice, const Index<dim> &first, const Index<dim> &end,
              const F &f)
{
  for (unsigned int d = 0; d < dim; ++d)
    if (first[d] >= end[d])
      return;
  Index<dim> index = first;
  while (index[dim - 1] < end[dim - 1])
    {
      const std::size_t row = lattice.offset(index);
      for (index[0] = first[0]; index[0] < end[0]; ++index[0])
        f(index, row + (index[0] - first[0]));
      for (unsigned int d = 0; index[d] == end[d] && d + 1 < dim; ++d)
        {
          index[d] = first[d];
          ++index[d + 1];
        }
    }
}

/** The owned active cells of each body. */
template <int dim>
std::vector<std::vector<unsigned int>>
cells_of_bodies(const DisplacementSpace<dim> &space, const unsigned int n_bodies)
{
  std::vector<std::vector<unsigned int>> cells(n_bodies);
  for (unsigned int a = 0; a < space.n_owned_cells(); ++a)
    cells[space.cells()[a].body].push_back(a);
  return cells;
}

/** The largest |du| at a node of the cells of each body, on all processes. */
template <int dim>
std::vector<double>
largest_increments(const DisplacementSpace<dim> &space, const PointEvaluator<dim> &du,
                   const std::vector<std::vector<unsigned int>> &cells)
{
  std::vector<double> largest(cells.size(), 0.);
  for (unsigned int b = 0; b < cells.size(); ++b)
    for (const unsigned int a : cells[b])
      for (unsigned int i = 0; i < space.basis.n_nodes; ++i)
        {
          double square = 0.;
          for (unsigned int d = 0; d < dim; ++d)
            square += std::pow(du.nodal_values(a)[i * dim + d], 2);
          largest[b] = std::max(largest[b], std::sqrt(square));
        }
  dealii::Utilities::MPI::max(largest, space.grid.communicator(), largest);
  return largest;
}

/** The finite element field of one body at the lattice nodes in its cells. */
template <int dim>
class IncrementInCells
{
public:
  IncrementInCells(const DisplacementSpace<dim> &space, const PointEvaluator<dim> &du,
                   const Lattice<dim> &lattice)
      : space(space)
      , du(du)
      , lattice(lattice)
  {
  }

  /** Values at all nodes, `unset` off the cells of all processes. */
  NodalVectors<dim> at_nodes(const std::vector<unsigned int> &cells);

private:
  /** Raises the values in a cell to those of its field: the result has no order of cells. */
  void add_cell(const unsigned int cell, NodalVectors<dim> &values);

  /** Values of the 1D basis functions at the points i/n, i = 0 ... n. */
  const std::vector<std::array<double, 3>> &table(const unsigned int n);

  const DisplacementSpace<dim>                   &space;
  const PointEvaluator<dim>                      &du;
  const Lattice<dim>                             &lattice;
  std::vector<std::vector<std::array<double, 3>>> tables; // by n
};

template <int dim>
const std::vector<std::array<double, 3>> &
IncrementInCells<dim>::table(const unsigned int n)
{
  if (tables.size() <= n)
    tables.resize(n + 1);
  if (tables[n].empty())
    for (unsigned int i = 0; i <= n; ++i)
      tables[n].push_back(space.basis.values_1d(double(i) / n));
  return tables[n];
}

template <int dim>
void
IncrementInCells<dim>::add_cell(const unsigned int cell, NodalVectors<dim> &values)
{
  const auto        &basis  = space.basis;
  const unsigned int n_1d   = basis.n_1d;
  const auto        &place  = space.grid.cells()[space.cells()[cell].grid_cell];
  const double       h      = lattice.spacing();
  const int          n      = static_cast<int>(std::lround(place.size / h));
  const auto        &weight = table(n);

  std::array<dealii::Tensor<1, dim>, max_nodes_per_cell<dim>> nodal;
  for (unsigned int i = 0; i < basis.n_nodes; ++i)
    for (unsigned int d = 0; d < dim; ++d)
      nodal[i][d] = du.nodal_values(cell)[i * dim + d];

  Index<dim> corner, first, end;
  for (unsigned int d = 0; d < dim; ++d)
    {
      corner[d] = static_cast<int>(std::lround((place.lower[d] - lattice.frame().origin[d]) / h));
      first[d]  = std::max(corner[d], lattice.lower()[d]);
      end[d]    = std::min(corner[d] + n, lattice.lower()[d] + lattice.n_nodes()[d] - 1) + 1;
    }
  std::array<dealii::Tensor<1, dim>, 3> row; // the field as a function of x in a row of nodes
  for_each_node(lattice, first, end, [&](const Index<dim> &index, const std::size_t offset) {
    if (index[0] == first[0])
      for (unsigned int i = 0; i < n_1d; ++i)
        {
          row[i] = 0.;
          for (unsigned int j = i; j < basis.n_nodes; j += n_1d)
            {
              double w = weight[index[1] - corner[1]][j / n_1d % n_1d];
              if constexpr (dim == 3)
                w *= weight[index[2] - corner[2]][j / (n_1d * n_1d)];
              row[i] += w * nodal[j];
            }
        }
    dealii::Tensor<1, dim> value;
    for (unsigned int i = 0; i < n_1d; ++i)
      value += weight[index[0] - corner[0]][i] * row[i];
    for (unsigned int d = 0; d < dim; ++d)
      values[d][offset] = std::max(values[d][offset], value[d]);
  });
}

template <int dim>
NodalVectors<dim>
IncrementInCells<dim>::at_nodes(const std::vector<unsigned int> &cells)
{
  NodalVectors<dim> values;
  for (auto &component : values)
    component.assign(lattice.values().size(), unset);
  for (const unsigned int cell : cells)
    add_cell(cell, values);
  return values;
}

/** The values that any process has set, of all bodies in one reduction. */
template <int dim>
void
join(std::vector<NodalVectors<dim>> &fields, const MPI_Comm communicator)
{
  if (dealii::Utilities::MPI::n_mpi_processes(communicator) == 1)
    return;
  std::vector<double> all;
  for (const auto &field : fields)
    for (const auto &component : field)
      all.insert(all.end(), component.begin(), component.end());
  dealii::Utilities::MPI::max(all, communicator, all);
  auto value = all.begin();
  for (auto &field : fields)
    for (auto &component : field)
      {
        std::copy_n(value, component.size(), component.begin());
        value += component.size();
      }
}

/** The nodes of a lattice in a box whose faces are on nodes. */
template <int dim>
NodeBox<dim>
nodes_inside(const Lattice<dim> &lattice, const dealii::BoundingBox<dim> &box)
{
  NodeBox<dim> result;
  for (unsigned int d = 0; d < dim; ++d)
    {
      const auto node = [&](const double x) {
        return static_cast<int>(std::lround((x - lattice.frame().origin[d]) / lattice.spacing()));
      };
      const int end
        = std::min(node(box.upper_bound(d)) + 1, lattice.lower()[d] + lattice.n_nodes()[d]);
      result.lower[d]   = std::max(node(box.lower_bound(d)), lattice.lower()[d]);
      result.n_nodes[d] = end - result.lower[d];
    }
  return result;
}

/** The largest |v_d| at known nodes of the body on the faces of a box across axis d. */
template <int dim>
double
largest_through_faces(const Lattice<dim> &lattice, const std::vector<char> &known,
                      const dealii::BoundingBox<dim> &box, const NodalVectors<dim> &v)
{
  const NodeBox<dim> inside = nodes_inside(lattice, box);
  double             result = 0.;
  for (unsigned int d = 0; d < dim; ++d)
    for (const int side : {0, 1})
      {
        const double x     = side == 0 ? box.lower_bound(d) : box.upper_bound(d);
        Index<dim>   first = inside.lower, end;
        for (unsigned int e = 0; e < dim; ++e)
          end[e] = first[e] + inside.n_nodes[e];
        if (side == 0)
          end[d] = first[d] + 1;
        else
          first[d] = end[d] - 1;
        if (std::abs(lattice.node(first)[d] - x) > 0.5 * lattice.spacing())
          continue; // the lattice ends before the face
        for_each_node(lattice, first, end, [&](const Index<dim> &, const std::size_t offset) {
          if (known[offset] && lattice.values()[offset] < 0.)
            result = std::max(result, std::abs(v[d][offset]));
        });
      }
  return result;
}

/** v(f - d) = v(f) + (v(f) - v(f + m)) d/m, m = d if there are so many nodes, beyond `inside`. */
template <int dim>
void
continue_through_faces(const Lattice<dim> &lattice, const NodeBox<dim> &inside,
                       NodalVectors<dim> &v)
{
  Index<dim> first = inside.lower, end;
  for (unsigned int d = 0; d < dim; ++d)
    end[d] = first[d] + inside.n_nodes[d];
  for (unsigned int d = 0; d < dim; ++d)
    {
      const int  face_below = first[d], face_above = end[d] - 1, depth = face_above - face_below;
      const auto set = [&](Index<dim> index, const std::size_t offset) {
        const bool below = index[d] < face_below;
        if (!below && index[d] <= face_above)
          return;
        const int beyond          = below ? face_below - index[d] : index[d] - face_above;
        const int within          = std::min(beyond, depth);
        index[d]                  = below ? face_below : face_above;
        const std::size_t on_face = lattice.offset(index);
        index[d] += below ? within : -within;
        const std::size_t opposite = lattice.offset(index);
        for (auto &component : v)
          component[offset]
            = component[on_face] + (component[on_face] - component[opposite]) * beyond / within;
      };
      first[d] = lattice.lower()[d];
      end[d]   = first[d] + lattice.n_nodes()[d];
      for_each_node(lattice, first, end, set);
    }
}

/** Continues v from the nodes in the body's cells to all nodes. */
template <int dim>
void
continue_off_body(const Lattice<dim> &lattice, const std::vector<char> &known,
                  const dealii::BoundingBox<dim> &box, NodalVectors<dim> &v)
{
  ExtensionOptions options;
  options.fit               = 2;
  const NodeBox<dim> inside = nodes_inside(lattice, box);
  if (inside.n_nodes == lattice.n_nodes())
    {
      extend(lattice, known, options, v);
      return;
    }
  // What the level set does beyond the box must not lead the extension inside.
  const Lattice<dim> part = reboxed(lattice, inside);
  NodalVectors<dim>  v_part;
  std::vector<char>  known_part(part.values().size());
  for (auto &component : v_part)
    component.resize(part.values().size());
  Index<dim> end = inside.lower;
  for (unsigned int d = 0; d < dim; ++d)
    end[d] += inside.n_nodes[d];
  std::size_t i = 0;
  for_each_node(lattice, inside.lower, end, [&](const Index<dim> &, const std::size_t offset) {
    for (unsigned int d = 0; d < dim; ++d)
      v_part[d][i] = v[d][offset];
    known_part[i++] = known[offset];
  });
  extend(part, known_part, options, v_part);
  i = 0;
  for_each_node(lattice, inside.lower, end, [&](const Index<dim> &, const std::size_t offset) {
    for (unsigned int d = 0; d < dim; ++d)
      v[d][offset] = v_part[d][i];
    ++i;
  });
  continue_through_faces<dim>(lattice, inside, v);
}

/** The box of the negative nodes and a spacing around it, clipped. */
template <int dim>
dealii::BoundingBox<dim>
box_of_body(const Lattice<dim> &lattice, const dealii::BoundingBox<dim> &clip)
{
  dealii::Point<dim> lower = clip.get_boundary_points().second,
                     upper = clip.get_boundary_points().first;
  for (std::size_t i = 0; i < lattice.values().size(); ++i)
    if (lattice.values()[i] < 0.)
      {
        const dealii::Point<dim> x = lattice.node(lattice.index(i));
        for (unsigned int d = 0; d < dim; ++d)
          {
            lower[d] = std::min(lower[d], x[d] - lattice.spacing());
            upper[d] = std::max(upper[d], x[d] + lattice.spacing());
          }
      }
  for (unsigned int d = 0; d < dim; ++d)
    {
      lower[d] = std::max(lower[d], clip.lower_bound(d));
      upper[d] = std::min(upper[d], clip.upper_bound(d));
    }
  return dealii::BoundingBox<dim>({lower, upper});
}

/** Nodes in the body's cells: those where a field of IncrementInCells is set. */
template <int dim>
std::vector<char>
known_nodes(const NodalVectors<dim> &v)
{
  std::vector<char> known(v[0].size());
  for (std::size_t i = 0; i < known.size(); ++i)
    known[i] = v[0][i] != unset;
  return known;
}

/** Gives the lattice room for the increment. */
template <int dim>
BodyMotion<dim>
make_room(Lattice<dim> &phi, const dealii::BoundingBox<dim> &box, const double margin,
          const double largest_increment)
{
  BodyMotion<dim> result;
  result.largest_increment = largest_increment;
  if (largest_increment > 0.5 * margin)
    {
      phi               = reboxed(phi, node_box_of_body(phi, margin + largest_increment, box));
      result.is_reboxed = true;
    }
  return result;
}

/** @param v increment at the nodes in the body's cells
 *  @param u displacement there, of reference maps only */
template <int dim>
void
move_level_set(Body<dim> &body, NodalVectors<dim> v, NodalVectors<dim> u,
               const dealii::BoundingBox<dim> &box, const LevelSetMotion &options,
               BodyMotion<dim> &result)
{
  Lattice<dim>           &phi   = body.level_set;
  const std::vector<char> known = known_nodes<dim>(v);
  result.face_increment         = largest_through_faces<dim>(phi, known, box, v);
  continue_off_body<dim>(phi, known, box, v);

  if (has_contour(phi))
    {
      // All nodes of cells that the contour cuts are near; the slope may be up to 2.
      const double near
        = 2. * std::max(options.margin, 16. * phi.spacing()) + result.largest_increment;
      const std::vector<double> old = phi.values();
      if (options.motion == IncrementMotion::reference_map)
        {
          NodalVectors<dim> moved_by;
          continue_off_body<dim>(phi, known_nodes<dim>(u), box, u);
          result.n_unconverged
            = image_of_initial<dim>(phi, *body.initial_level_set, v, u, moved_by, near)
                .n_unconverged;
          body.displacement = ExtendedIncrement<dim>(phi, std::move(moved_by));
          // Interpolants of the initial level set would round corners, as would distances made of
          // them: the strip of reinitialise() is within this reach.
          if (body.shape && !body.shape->is_smooth() && body.shape->is_distance())
            set_moved_distances(body, 4. * phi.spacing());
        }
      else
        {
          result.n_unconverged = advect_increment<dim>(phi, v, options.motion).n_unconverged;
          body.shape           = nullptr;
        }
      result.n_islands = remove_islands<dim>(phi, old, known, v);
      ReinitialisationOptions reinitialisation;
      reinitialisation.tolerance = options.reinitialisation_tolerance;
      if (options.motion == IncrementMotion::reference_map)
        reinitialisation.band = near / phi.spacing();
      result.contour_motion = reinitialise(phi, reinitialisation).contour_motion;
    }
  result.increment = ExtendedIncrement<dim>(phi, std::move(v));
  result.is_reboxed |= follow_body(phi, options.margin, box);
  body.box = box_of_body(phi, box);
}
} // namespace

template <int dim>
void
require_movable(const std::vector<Body<dim>> &bodies)
{
  for (const auto &body : bodies)
    require(body.is_rigid() || !body.level_set.is_tiled(), body.path,
            "the level set of the deformable body '" + body.name
              + "' has more than 16 million nodes and is stored in tiles, which do not move",
            "use larger cells or a geometry that stays");
}

template <int dim>
std::vector<BodyMotion<dim>>
move_level_sets(std::vector<Body<dim>> &bodies, const DisplacementSpace<dim> &space,
                const Vector &ghosted_du, const Vector &ghosted_displacement,
                const LevelSetMotion &options)
{
  const PointEvaluator<dim> du(space, ghosted_du), displacement(space, ghosted_displacement);
  require_movable(bodies);
  const auto                   cells   = cells_of_bodies(space, bodies.size());
  const std::vector<double>    largest = largest_increments(space, du, cells);
  const auto                   box     = space.grid.box();
  std::vector<BodyMotion<dim>> motions(bodies.size());
  // Of du, and of the displacement for reference maps.
  std::vector<NodalVectors<dim>> at_nodes(2 * bodies.size());
  for (unsigned int b = 0; b < bodies.size(); ++b)
    if (!bodies[b].is_rigid())
      {
        Lattice<dim> &phi = bodies[b].level_set;
        motions[b]        = make_room(phi, box, options.margin, largest[b]);
        at_nodes[2 * b]   = IncrementInCells<dim>(space, du, phi).at_nodes(cells[b]);
        if (options.motion == IncrementMotion::reference_map)
          at_nodes[2 * b + 1] = IncrementInCells<dim>(space, displacement, phi).at_nodes(cells[b]);
      }
  join<dim>(at_nodes, space.grid.communicator());
  for (unsigned int b = 0; b < bodies.size(); ++b)
    if (!bodies[b].is_rigid())
      move_level_set<dim>(bodies[b], std::move(at_nodes[2 * b]), std::move(at_nodes[2 * b + 1]),
                          box, options, motions[b]);
  return motions;
}

#define SCREE_INSTANTIATE(dim)                                                                \
  template void                         require_movable(const std::vector<Body<dim>> &);      \
  template std::vector<BodyMotion<dim>> move_level_sets(                                      \
    std::vector<Body<dim>> &, const DisplacementSpace<dim> &, const Vector &, const Vector &, \
    const LevelSetMotion &);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
