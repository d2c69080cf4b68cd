#include <scree/discretization/polytope_rules.h>
#include <scree/mechanics/load_points.h>

#include <algorithm>
#include <cmath>

namespace scree
{
using namespace dealii;

namespace
{
/** The smooth piece that a point of the cut belongs to: the nearest that looks along its normal. */
template <int dim>
std::vector<SmoothPiece<dim>>
piece_at(const Shape<dim> &shape, const Point<dim> &position, const Tensor<1, dim> &normal,
         const double size)
{
  BoundingBox<dim> box({position, position});
  box.extend(0.5 * size);
  std::vector<SmoothPiece<dim>> pieces, nearest;
  shape.append_pieces(box, pieces);
  double smallest = 0.5 * size;
  for (const auto &piece : pieces)
    if (const double distance = std::abs(piece.value(position));
        distance < smallest && piece.normal(position, 1e-4 * size) * normal > 0.7)
      {
        smallest = distance;
        nearest  = {piece};
      }
  return nearest;
}

/** Directions along a surface. */
template <int dim>
std::array<Tensor<1, dim>, dim - 1>
tangents(const Tensor<1, dim> &normal)
{
  if constexpr (dim == 2)
    return {{Tensor<1, 2>({-normal[1], normal[0]})}};
  else
    {
      const unsigned int smallest
        = std::min_element(normal.begin_raw(), normal.end_raw(),
                           [](const double a, const double b) { return std::abs(a) < std::abs(b); })
          - normal.begin_raw();
      Tensor<1, 3> s = Point<3>::unit_vector(smallest);
      s -= normal[smallest] * normal;
      s /= s.norm();
      return {{s, cross_product_3d(normal, s)}};
    }
}

/** The root of f next to 0 within [-limit, limit], by secants; 0 if there is none. */
template <typename F>
double
root_near_zero(const F &f, const double limit)
{
  double a = 0., fa = f(a), b = fa > 0. ? -1e-3 * limit : 1e-3 * limit, fb = f(b);
  for (unsigned int iteration = 0; iteration < 30 && std::abs(fb) > 1e-14 * limit; ++iteration)
    {
      if (fb == fa)
        return 0.;
      const double next = b - fb * (b - a) / (fb - fa);
      if (!(std::abs(next) < limit))
        return 0.;
      a  = b;
      fa = fb;
      b  = next;
      fb = f(b);
    }
  return std::abs(fb) < 1e-6 * limit ? b : 0.;
}

/** Where the values of a basis of one variable change their sign, and the sign of the slope. */
std::vector<std::pair<double, double>>
sign_changes(const std::vector<double> &values)
{
  const unsigned int                     k = values.size() - 1;
  std::vector<std::pair<double, double>> result;
  const auto                             value = [&](const double s) {
    if (k == 1)
      return (1. - s) * values[0] + s * values[1];
    return (1. - s) * (1. - 2. * s) * values[0] + 4. * s * (1. - s) * values[1]
           + s * (2. * s - 1.) * values[2];
  };
  for (unsigned int i = 0; i < k; ++i)
    if ((values[i] < 0.) != (values[i + 1] < 0.))
      {
        double low = double(i) / k, high = double(i + 1) / k;
        for (unsigned int step = 0; step < 50; ++step)
          {
            const double middle                                     = 0.5 * (low + high);
            ((value(middle) < 0.) == (values[i] < 0.) ? low : high) = middle;
          }
        result.emplace_back(0.5 * (low + high), values[i] < 0. ? 1. : -1.);
      }
  return result;
}
} // namespace

template <int dim>
void
move_to_boundary(const Shape<dim> &shape, const GridCell<dim> &cell, BoundaryPoint<dim> &point)
{
  const auto found = piece_at(shape, point.position, point.normal, cell.size);
  if (found.empty() || found[0].is_plane())
    return;
  const double                        step = 1e-4 * cell.size, side = 1e-3 * cell.size;
  const Point<dim>                    foot = found[0].foot(point.position, step);
  std::array<Tensor<1, dim>, dim - 1> slopes;
  const auto                          along = tangents<dim>(point.normal);
  for (unsigned int t = 0; t < dim - 1; ++t)
    slopes[t] = (found[0].foot(point.position + side * along[t], step)
                 - found[0].foot(point.position - side * along[t], step))
                / (2. * side);
  double ratio;
  if constexpr (dim == 2)
    ratio = slopes[0].norm();
  else
    ratio = cross_product_3d(slopes[0], slopes[1]).norm();
  if (foot.distance(point.position) > 0.5 * cell.size || !(ratio > 0.2 && ratio < 5.))
    return; // the cut has no counterpart there
  point.weight *= ratio;
  point.position = point.reference_position = foot;
  point.unit_point                          = Point<dim>((foot - cell.lower) / cell.size);
  point.normal                              = found[0].normal(foot, step);
}

template <int dim>
CellPoints<dim>
strip_on_face(const Shape<dim> &shape, const CutCellRules<dim> &rules, const GridCell<dim> &cell,
              const CellCut<dim> &cut, const unsigned int face)
{
  const LagrangeBasis<dim> &basis = rules.basis;
  CellPoints<dim>           result;
  if (cut.location != CellLocation::cut || !cut.parts.empty())
    return result;
  const unsigned int  direction = face / 2;
  Tensor<1, dim>      outward;
  std::vector<double> values; // on the face
  outward[direction] = face % 2 == 0 ? -1. : 1.;
  for (unsigned int i = 0; i < basis.n_nodes; ++i)
    if (basis.node(i)[direction] == face % 2)
      values.push_back(cut.scaled[i]);
  // A point of the edge of the cut on the face, its length and the direction out of the body.
  const auto add = [&](const Point<dim> &edge, const double length, const Tensor<1, dim> &out) {
    const Point<dim> x     = cell.lower + cell.size * Tensor<1, dim>(edge);
    const double     width = root_near_zero(
      [&](const double t) { return shape.signed_distance(x + t * out); }, 0.5 * cell.size);
    if (width == 0.)
      return;
    result.points.push_back(edge + 0.5 * width / cell.size * out);
    result.weights.push_back(width * length);
    result.normals.push_back(outward);
  };
  const auto on_face = [&](const Point<dim - 1> &y) {
    Point<dim> x;
    x[direction] = face % 2;
    for (unsigned int d = 0, i = 0; d < dim; ++d)
      if (d != direction)
        x[d] = y[i++];
    return x;
  };
  if constexpr (dim == 2)
    for (const auto &[s, sign] : sign_changes(values))
      add(on_face(Point<1>(s)), 1., sign * Point<2>::unit_vector(1 - direction));
  else
    {
      const LagrangeBasis<2> of_face(basis.degree);
      if (location_of(values.data(), of_face.n_nodes) != CellLocation::cut)
        return result;
      CutCellRules<2> rules_of_face(of_face, rules.gauss);
      const auto      edge = rules_of_face.rules(values.data(), cell.size).surface;
      for (unsigned int q = 0; q < edge.points.size(); ++q)
        {
          Tensor<1, dim> out = on_face(Point<2>(edge.normals[q]));
          out[direction]     = 0.;
          add(on_face(edge.points[q]), edge.weights[q], out);
        }
    }
  return result;
}

namespace
{
template <int dim>
constexpr unsigned int most_halvings = dim == 2 ? 10 : 5;

/** Divides a surface in a cell where a region ends on it. */
template <int dim>
class Halving
{
public:
  using Selects = std::function<bool(const Point<dim> &)>;

  Halving(CutCellRules<dim> &rules, const GridCell<dim> &cell, const Shape<dim> *shape,
          const Selects &selects)
      : rules(rules)
      , basis(rules.basis)
      , cell(cell)
      , shape(shape)
      , selects(selects)
  {
  }

  /** The contour of nodal values in a sub-cell. */
  void add_contour(const double *scaled, const Point<dim> &corner, const double edge,
                   const unsigned int depth)
  {
    double       values[max_nodes_per_cell<dim>], shape[max_nodes_per_cell<dim>];
    unsigned int n_negative = 0;
    for (unsigned int i = 0; i < basis.n_nodes; ++i)
      {
        basis.evaluate_values(corner + edge * Tensor<1, dim>(basis.node(i)), shape);
        values[i] = 0.;
        for (unsigned int j = 0; j < basis.n_nodes; ++j)
          values[i] += shape[j] * scaled[j] / edge;
        n_negative += values[i] < 0.;
      }
    if (n_negative == 0 || n_negative == basis.n_nodes)
      return;
    CellPoints<dim> part = rules.rules(values, edge * cell.size).surface;
    for (auto &x : part.points)
      x = corner + edge * Tensor<1, dim>(x);
    if (depth == most_halvings<dim> || is_uniform(part))
      {
        result.append(part);
        return;
      }
    for (unsigned int v = 0; v < (1u << dim); ++v)
      add_contour(scaled,
                  corner
                    + 0.5 * edge * Tensor<1, dim>(dealii::GeometryInfo<dim>::unit_cell_vertex(v)),
                  0.5 * edge, depth + 1);
  }

  /** A flat facet. */
  void add_facet(const Facet<dim> &facet, const Tensor<1, dim> &normal)
  {
    CellPoints<dim> whole;
    append_rule(facet, normal, rules.gauss.surface, cell.size, whole);
    if (is_uniform(whole))
      result.append(whole);
    else
      for (const auto &simplex : simplices_of(facet))
        add_flat(simplex, normal, 0);
  }

  /** A simplex of a flat facet. */
  void add_flat(const std::vector<Point<dim>> &simplex, const Tensor<1, dim> &normal,
                const unsigned int depth)
  {
    CellPoints<dim> part;
    Facet<dim>      facet;
    facet.vertices = simplex;
    append_rule(facet, normal, rules.gauss.surface, cell.size, part);
    if (depth == most_halvings<dim> || is_uniform(part))
      {
        result.append(part);
        return;
      }
    const auto between = [&](const unsigned int i, const unsigned int j) {
      return Point<dim>(0.5 * (Tensor<1, dim>(simplex[i]) + Tensor<1, dim>(simplex[j])));
    };
    if constexpr (dim == 2)
      for (const unsigned int i : {0, 1})
        add_flat({simplex[i], between(0, 1)}, normal, depth + 1);
    else
      {
        const Point<dim> a = between(0, 1), b = between(1, 2), c = between(2, 0);
        for (const auto &child :
             {std::vector<Point<dim>>{simplex[0], a, c}, std::vector<Point<dim>>{simplex[1], a, b},
              std::vector<Point<dim>>{simplex[2], b, c}, std::vector<Point<dim>>{a, b, c}})
          add_flat(child, normal, depth + 1);
      }
  }

  CellPoints<dim> result;

private:
  /** Whether the region holds all or nothing of a part, as its points show and their surroundings.
   */
  bool is_uniform(const CellPoints<dim> &part) const
  {
    if (part.points.empty() || !selects)
      return true;
    const auto at = [&](const unsigned int q, const Tensor<1, dim> &offset) {
      const Point<dim> x = cell.lower + cell.size * Tensor<1, dim>(part.points[q]) + offset;
      if (!shape)
        return selects(x);
      const auto piece = piece_at(*shape, x, part.normals[q], cell.size);
      return selects(piece.empty() ? x : piece[0].foot(x, 1e-4 * cell.size));
    };
    const bool first = at(0, {});
    for (unsigned int q = 0; q < part.points.size(); ++q)
      {
        const double reach = dim == 2 ? 0.5 * part.weights[q] : std::sqrt(part.weights[q]);
        for (const auto &t : tangents<dim>(part.normals[q]))
          for (const double side : {-1., 0., 1.})
            if (at(q, side * reach * t) != first)
              return false;
      }
    return true;
  }

  CutCellRules<dim>        &rules;
  const LagrangeBasis<dim> &basis;
  const GridCell<dim>      &cell;
  const Shape<dim>         *shape; // null: the points stay
  const Selects            &selects;
};
} // namespace

template <int dim>
CellPoints<dim>
load_rule(CutCellRules<dim> &rules, const GridCell<dim> &cell, const Shape<dim> *shape,
          const CellCut<dim> &cut, const unsigned int face,
          const std::function<bool(const Point<dim> &)> &selects)
{
  const bool   on_face = face != BoundaryCondition<dim>::no_face;
  Halving<dim> halving(rules, cell, on_face ? nullptr : shape, selects);
  const auto   add_facets = [&](const Polytope<dim> &part) {
    for (const auto &facet : part.facets)
      if (on_face ? facet.face == int(face) : facet.is_surface())
        for (const auto &simplex : simplices_of(facet))
          halving.add_flat(simplex,
                           on_face ? (face % 2 == 0 ? -1. : 1.) * Point<dim>::unit_vector(face / 2)
                                     : facet.normal,
                             0);
  };
  if (cut.location == CellLocation::inside && on_face)
    add_facets(Polytope<dim>::unit_cell());
  for (const auto &part : cut.parts)
    add_facets(part);
  if (cut.location == CellLocation::cut && cut.parts.empty())
    {
      if (on_face)
        return rules.face_rule(cut, cell.size, face);
      halving.add_contour(cut.scaled.data(), Point<dim>(), 1., 0);
    }
  return halving.result;
}

#define SCREE_INSTANTIATE(dim)                                                                     \
  template void move_to_boundary(const Shape<dim> &, const GridCell<dim> &, BoundaryPoint<dim> &); \
  template CellPoints<dim> load_rule(CutCellRules<dim> &, const GridCell<dim> &,                   \
                                     const Shape<dim> *, const CellCut<dim> &, const unsigned int, \
                                     const std::function<bool(const Point<dim> &)> &);             \
  template CellPoints<dim> strip_on_face(const Shape<dim> &, const CutCellRules<dim> &,            \
                                         const GridCell<dim> &, const CellCut<dim> &,              \
                                         const unsigned int);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
