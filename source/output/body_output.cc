#include <scree/discretization/cell_cut.h>
#include <scree/output/body_output.h>
#include <scree/output/patch_output.h>
#include <scree/output/vtu_files.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <algorithm>

namespace scree
{
namespace
{
/** Clips a convex simplex {phi < 0} of linear phi; appends simplices. */
template <int dim>
void
clip_simplex(const std::vector<dealii::Point<dim>> &vertices, const std::vector<double> &phi,
             std::vector<std::vector<dealii::Point<dim>>> &result)
{
  std::vector<unsigned int> inside, outside;
  for (unsigned int v = 0; v <= dim; ++v)
    (phi[v] < 0. ? inside : outside).push_back(v);
  if (inside.empty())
    return;
  if (outside.empty())
    {
      result.push_back(vertices);
      return;
    }
  const auto between = [&](const unsigned int i, const unsigned int o) {
    const double t = phi[i] / (phi[i] - phi[o]);
    return dealii::Point<dim>(vertices[i] + t * (vertices[o] - vertices[i]));
  };
  if (inside.size() == 1)
    {
      std::vector<dealii::Point<dim>> simplex = {vertices[inside[0]]};
      for (const unsigned int o : outside)
        simplex.push_back(between(inside[0], o));
      result.push_back(simplex);
    }
  else if (outside.size() == 1)
    {
      // A simplex without its tip: a prism over the inside face, dim simplices.
      std::vector<dealii::Point<dim>> low, high;
      for (const unsigned int i : inside)
        {
          low.push_back(vertices[i]);
          high.push_back(between(i, outside[0]));
        }
      for (unsigned int k = 0; k < dim; ++k)
        {
          std::vector<dealii::Point<dim>> simplex(low.begin() + k, low.end());
          simplex.insert(simplex.end(), high.begin(), high.begin() + k + 1);
          result.push_back(simplex);
        }
    }
  else
    {
      // 3D, two inside: a wedge with the ridge between them.
      const std::vector<dealii::Point<dim>> low
        = {vertices[inside[0]], between(inside[0], outside[0]), between(inside[0], outside[1])};
      const std::vector<dealii::Point<dim>> high
        = {vertices[inside[1]], between(inside[1], outside[0]), between(inside[1], outside[1])};
      for (unsigned int k = 0; k < 3; ++k)
        {
          std::vector<dealii::Point<dim>> simplex(low.begin() + k, low.end());
          simplex.insert(simplex.end(), high.begin(), high.begin() + k + 1);
          result.push_back(simplex);
        }
    }
}

/** Positive orientation, as VTK wants it. */
template <int dim>
void
orient(std::vector<dealii::Point<dim>> &simplex)
{
  dealii::Tensor<2, dim> edges;
  for (unsigned int d = 0; d < dim; ++d)
    edges[d] = simplex[d + 1] - simplex[0];
  if (determinant(edges) < 0.)
    std::swap(simplex[0], simplex[1]);
}

/** The simplices that divide the unit cube (Kuhn). */
template <int dim>
std::vector<std::vector<unsigned int>>
kuhn_simplices()
{
  if (dim == 2)
    return {{0, 1, 3}, {0, 3, 2}};
  return {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}};
}
/** The simplices that make up the part {phi < 0} of a box with the given corners. */
template <int dim>
std::vector<std::vector<dealii::Point<dim>>>
clip_box(const std::vector<dealii::Point<dim>> &corners, const std::vector<double> &phi)
{
  std::vector<std::vector<dealii::Point<dim>>> simplices;
  for (const auto &simplex : kuhn_simplices<dim>())
    {
      std::vector<dealii::Point<dim>> vertices;
      std::vector<double>             values;
      for (const unsigned int v : simplex)
        {
          vertices.push_back(corners[v]);
          values.push_back(phi[v]);
        }
      clip_simplex<dim>(vertices, values, simplices);
    }
  for (auto &vertices : simplices)
    orient<dim>(vertices);
  return simplices;
}

/** A piece with the given vertices and what is known there. */
template <int dim>
dealii::DataOutBase::Patch<dim, dim>
make_patch(const std::vector<dealii::Point<dim>> &vertices,
           const std::vector<VertexSample<dim>> &samples, const BodyFields<dim> &fields)
{
  dealii::DataOutBase::Patch<dim, dim> patch;
  patch.reference_cell = vertices.size() == dim + 1 ? dealii::ReferenceCells::get_simplex<dim>()
                                                    : dealii::ReferenceCells::get_hypercube<dim>();
  patch.n_subdivisions = 1;
  for (unsigned int v = 0; v < vertices.size(); ++v)
    {
      const std::vector<double> values = fields.values(samples[v]);
      if (v == 0)
        patch.data.reinit(values.size(), vertices.size());
      patch.vertices[v] = vertices[v];
      for (unsigned int row = 0; row < values.size(); ++row)
        patch.data(row, v) = values[row];
    }
  return patch;
}
} // namespace

template <int dim>
BodyOutput<dim>::BodyOutput(const DisplacementSpace<dim> &space,
                            const LevelSetNodes<dim>     &level_set_nodes,
                            const std::vector<Body<dim>> &bodies, const FieldParameters &parameters)
    : space(space)
    , bodies(bodies)
    , parameters(parameters)
{
  const auto add_whole = [&](const unsigned int a) {
    Piece piece{a, {}};
    for (unsigned int v = 0; v < dealii::GeometryInfo<dim>::vertices_per_cell; ++v)
      piece.vertices.push_back(dealii::GeometryInfo<dim>::unit_cell_vertex(v));
    body_pieces.push_back(piece);
  };
  for (unsigned int a = 0; a < space.n_owned_cells(); ++a)
    {
      const ActiveCell &cell = space.cells()[a];
      if (!cell.is_cut)
        {
          add_whole(a);
          continue;
        }
      const CellCut<dim> cut = level_set_nodes.cut(cell.grid_cell, bodies[cell.body]);
      if (cut.parts.empty())
        cut_cell(a, level_set_nodes.basis(), cut.scaled);
      for (const auto &part : cut.parts)
        if (part.is_unit_cell())
          add_whole(a);
        else
          for (auto &simplex : part.simplices())
            {
              orient<dim>(simplex);
              body_pieces.push_back({a, simplex});
            }
    }
}

template <int dim>
void
BodyOutput<dim>::cut_cell(const unsigned int active_cell, const LagrangeBasis<dim> &basis,
                          const std::array<double, max_nodes_per_cell<dim>> &phi)
{
  // Sub-cells between the nodes, each divided into simplices with linear phi.
  const unsigned int k = basis.degree;
  for (unsigned int sub = 0; sub < (dim == 2 ? k * k : k * k * k); ++sub)
    {
      std::vector<dealii::Point<dim>> corners;
      std::vector<double>             corner_phi;
      for (unsigned int v = 0; v < dealii::GeometryInfo<dim>::vertices_per_cell; ++v)
        {
          unsigned int node = 0, stride = 1, rest = sub;
          for (unsigned int d = 0; d < dim; ++d, rest /= k, stride *= k + 1)
            node += (rest % k + ((v >> d) & 1u)) * stride;
          corners.push_back(basis.node(node));
          corner_phi.push_back(phi[node]);
        }
      for (const auto &vertices : clip_box(corners, corner_phi))
        body_pieces.push_back({active_cell, vertices});
    }
}

template <int dim>
std::vector<typename BodyOutput<dim>::RigidPiece>
BodyOutput<dim>::cut_rigid_bodies() const
{
  std::vector<RigidPiece> pieces;
  if (dealii::Utilities::MPI::this_mpi_process(space.grid.communicator()) == 0)
    for (unsigned int b = 0; b < bodies.size(); ++b)
      if (bodies[b].is_rigid())
        cut_rigid_body(b, pieces);
  return pieces;
}

template <int dim>
void
BodyOutput<dim>::cut_rigid_body(const unsigned int body, std::vector<RigidPiece> &pieces) const
{
  const Lattice<dim> &lattice = bodies[body].rigid->picture;
  for (std::size_t i = 0; i < lattice.values().size(); ++i)
    {
      std::vector<dealii::Point<dim>> corners;
      std::vector<double>             phi;
      for (unsigned int v = 0; v < dealii::GeometryInfo<dim>::vertices_per_cell; ++v)
        {
          auto node = lattice.index(i);
          for (unsigned int d = 0; d < dim; ++d)
            node[d] += (v >> d) & 1u;
          if (!lattice.contains(node))
            break;
          corners.push_back(lattice.node(node));
          phi.push_back(lattice(node));
        }
      if (corners.size() == dealii::GeometryInfo<dim>::vertices_per_cell)
        cut_rigid_cell(body, corners, phi, pieces);
    }
}

template <int dim>
void
BodyOutput<dim>::cut_rigid_cell(const unsigned int                     body,
                                const std::vector<dealii::Point<dim>> &corners,
                                const std::vector<double>             &phi,
                                std::vector<RigidPiece>               &pieces) const
{
  const auto  &shape   = bodies[body].rigid->shape;
  const double size    = corners[1][0] - corners[0][0];
  const bool   is_near = std::any_of(phi.begin(), phi.end(), [&](const double value) {
    return std::abs(value) < 2. * std::sqrt(double(dim)) * size;
  });
  CellCut<dim> cut;
  if (shape && !shape->is_smooth() && is_near)
    cut = cut_by_pieces(*shape, LagrangeBasis<dim>(1), corners, size);
  else
    {
      nudge(phi.data(), phi.size(), size, cut.scaled.data());
      cut.location = location_of(cut.scaled.data(), phi.size());
    }
  for (const auto &part : cut.parts)
    for (auto &simplex : part.simplices())
      {
        for (auto &vertex : simplex)
          vertex = corners[0] + size * dealii::Tensor<1, dim>(vertex);
        orient<dim>(simplex);
        pieces.push_back({body, simplex});
      }
  if (!cut.parts.empty() || cut.location == CellLocation::outside)
    return;
  if (cut.location == CellLocation::inside)
    pieces.push_back({body, corners});
  else
    for (const auto &vertices :
         clip_box(corners, {cut.scaled.begin(), cut.scaled.begin() + corners.size()}))
      pieces.push_back({body, vertices});
}

template <int dim>
std::string
BodyOutput<dim>::write(const Kinematics<dim>                       &kinematics,
                       const dealii::TrilinosWrappers::MPI::Vector &u,
                       const VelocityField<dim> *velocities, const std::string &directory,
                       const unsigned int number, const double time) const
{
  const PointEvaluator<dim> field(space, u), start = kinematics.start_displacement_field();
  const bool                is_moved = kinematics.moves_bodies();
  const BodyFields<dim>     fields(parameters, {velocities != nullptr, may_flow(bodies), is_moved});
  PatchOutput<dim, dim>     output;
  std::vector<VertexSample<dim>> samples;
  output.names = fields.names();
  for (const auto &[first, name] : fields.vectors())
    output.add_vector(first, name);
  const auto add = [&](const std::vector<dealii::Point<dim>> &vertices) {
    output.patches.push_back(make_patch<dim>(vertices, samples, fields));
    output.patches.back().patch_index = output.patches.size() - 1;
    samples.clear();
  };

  for (const Piece &piece : body_pieces)
    {
      std::vector<dealii::Point<dim>> vertices;
      for (const auto &vertex : piece.vertices)
        {
          const PointInCell<dim> point = {piece.active_cell, vertex};
          samples.push_back({kinematics.bulk().sample(piece.active_cell, vertex, field),
                             velocities ? velocities->value(point) : dealii::Tensor<1, dim>(),
                             space.cells()[piece.active_cell].body});
          vertices.push_back(space.position(piece.active_cell, vertex));
          if (is_moved)
            vertices.back() += samples.back().bulk.displacement - start.value(point);
        }
      add(vertices);
    }
  for (const RigidPiece &piece : cut_rigid_bodies())
    {
      const RigidPose<dim> pose(*bodies[piece.body].rigid, rigid_unknowns(space, piece.body, u));
      std::vector<dealii::Point<dim>> vertices;
      for (const auto &vertex : piece.vertices)
        {
          samples.emplace_back();
          samples.back().body              = piece.body;
          samples.back().bulk.displacement = pose.displacement(vertex);
          const dealii::Point<dim> moved   = vertex + samples.back().bulk.displacement;
          if (velocities)
            samples.back().velocity = velocities->value(piece.body, moved);
          vertices.push_back(is_moved ? moved : vertex);
        }
      add(vertices);
    }
  dealii::DataOutBase::VtkFlags flags;
  flags.compression_level = dealii::DataOutBase::VtkFlags::best_speed;
  flags.physical_units    = unit_labels(parameters, fields.quantities(), dim);
  output.set_flags(flags);
  return write_vtu_files(output, directory, "bodies_" + dealii::Utilities::int_to_string(number, 4),
                         space.grid.communicator(),
                         field_datum("TimeValue", time)
                           + field_datum("points_are_moved", is_moved ? 1. : 0.)
                           + field_data_of_names("body", bodies));
}

template class BodyOutput<2>;
template class BodyOutput<3>;
} // namespace scree
