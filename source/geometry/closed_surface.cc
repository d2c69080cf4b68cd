#include <scree/base/exceptions.h>
#include <scree/base/log.h>
#include <scree/geometry/closed_surface.h>

#include <CGAL/AABB_halfedge_graph_segment_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/compute_normal.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_slicer.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <cmath>
#include <map>

namespace scree
{
using namespace dealii;

namespace
{
namespace PMP = CGAL::Polygon_mesh_processing;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh   = CGAL::Surface_mesh<Kernel::Point_3>;

// Distances need no exact predicates, which fall back to rational numbers where two facets are
// nearest.
using DoubleKernel = CGAL::Simple_cartesian<double>;
using Triangles    = std::vector<DoubleKernel::Triangle_3>;
using Primitive    = CGAL::AABB_triangle_primitive<DoubleKernel, Triangles::const_iterator>;
using DistanceTree = CGAL::AABB_tree<CGAL::AABB_traits<DoubleKernel, Primitive>>;

/** "facet 17 at (0.5, 1, 2)", by the middle of its corners. */
std::string
facet(const TriangleSoup &soup, const std::size_t t)
{
  Point<3> middle;
  for (const std::size_t corner : soup.triangles[t])
    middle += soup.points[corner] / 3.;
  return "facet " + std::to_string(t + 1) + " at " + short_place(middle);
}

/** Throws UserError unless every edge has two facets and every facet an area. */
void
require_two_facets_per_edge(const TriangleSoup &soup, const std::string &name)
{
  const std::string remedy = "close and clean the surface in a mesh editor";
  std::map<std::pair<std::size_t, std::size_t>, std::pair<std::size_t, unsigned int>> facets;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    {
      const auto        &corners = soup.triangles[t];
      const Tensor<1, 3> first   = soup.points[corners[1]] - soup.points[corners[0]],
                         second  = soup.points[corners[2]] - soup.points[corners[0]];
      if (!(cross_product_3d(first, second).norm() > 1e-12 * first.norm() * second.norm()))
        throw UserError(name, facet(soup, t) + " has no area", remedy);
      for (unsigned int c = 0; c < 3; ++c)
        {
          const auto edge = std::minmax(corners[c], corners[(c + 1) % 3]);
          auto      &seen = facets.emplace(edge, std::make_pair(t, 0u)).first->second;
          if (++seen.second > 2)
            throw UserError(name, "more than two facets meet in an edge of " + facet(soup, t),
                            remedy);
        }
    }
  for (const auto &[edge, seen] : facets)
    if (seen.second != 2)
      throw UserError(
        name, "the surface is open: " + facet(soup, seen.first) + " has an edge without neighbour",
        remedy);
}

/** The mesh of a soup, its facets in the same order, turned outwards. */
Mesh
oriented_mesh(const TriangleSoup &soup, const std::string &name)
{
  std::vector<Kernel::Point_3>          points;
  std::vector<std::vector<std::size_t>> triangles;
  for (const Point<3> &x : soup.points)
    points.emplace_back(x[0], x[1], x[2]);
  for (const auto &triangle : soup.triangles)
    triangles.emplace_back(triangle.begin(), triangle.end());
  // Where that fails, points are doubled and edges lose a facet.
  PMP::orient_polygon_soup(points, triangles);
  Mesh mesh;
  require(PMP::is_polygon_soup_a_polygon_mesh(triangles), name,
          "the facets cannot be oriented: the surface has one side only", "repair the surface");
  PMP::polygon_soup_to_polygon_mesh(points, triangles, mesh);
  require(
    CGAL::is_closed(mesh), name,
    "the facets cannot be oriented: the surface has one side only, or touches itself in a point",
    "repair the surface in a mesh editor");
  return mesh;
}

/** Throws UserError where facets cross, or parts are apart. */
void
require_single_sheet(const Mesh &mesh, const TriangleSoup &soup, const std::string &name)
{
  const std::string remedy = "repair the surface in a mesh editor";
  std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> crossings;
  PMP::self_intersections(mesh, std::back_inserter(crossings));
  if (!crossings.empty())
    throw UserError(name,
                    "the surface crosses itself in " + std::to_string(crossings.size())
                      + " pair(s) of facets: " + facet(soup, crossings[0].first) + " and "
                      + facet(soup, crossings[0].second),
                    remedy);
  std::map<Mesh::Face_index, std::size_t> parts;
  const auto n = PMP::connected_components(mesh, boost::make_assoc_property_map(parts));
  for (const auto &[face, part] : parts)
    if (part != 0)
      throw UserError(name,
                      "the surface has " + std::to_string(n)
                        + " parts that are apart; one begins with " + facet(soup, face),
                      "write each part to a file of its own, and remove closed holes");
}
} // namespace

struct ClosedSurface::Tree
{
  explicit Tree(Mesh mesh_of_surface)
      : mesh(std::move(mesh_of_surface))
      , side(mesh)
  {
    for (const Mesh::Face_index face : mesh.faces())
      {
        std::vector<DoubleKernel::Point_3> corners;
        for (const Mesh::Vertex_index vertex :
             CGAL::vertices_around_face(mesh.halfedge(face), mesh))
          {
            const Kernel::Point_3 &x = mesh.point(vertex);
            corners.emplace_back(x[0], x[1], x[2]);
          }
        triangles.emplace_back(corners[0], corners[1], corners[2]);
      }
    distances.insert(triangles.cbegin(), triangles.cend());
    distances.accelerate_distance_queries();
  }

  bool contains(const Point<3> &x) const
  {
    return side(Kernel::Point_3(x[0], x[1], x[2])) == CGAL::ON_BOUNDED_SIDE;
  }

  Mesh                                      mesh;
  CGAL::Side_of_triangle_mesh<Mesh, Kernel> side;
  Triangles                                 triangles; //!< of the faces, in their order
  DistanceTree                              distances;
};

ClosedSurface::ClosedSurface(const TriangleSoup &soup, const std::string &name)
    : box(soup.points)
{
  require_two_facets_per_edge(soup, name);
  Mesh mesh = oriented_mesh(soup, name);
  require_single_sheet(mesh, soup, name);
  if (!PMP::is_outward_oriented(mesh))
    PMP::reverse_face_orientations(mesh);
  tree = std::make_unique<const Tree>(std::move(mesh));
}

ClosedSurface::~ClosedSurface() = default;

double
ClosedSurface::signed_distance(const Point<3> &x) const
{
  const double distance
    = std::sqrt(tree->distances.squared_distance(DoubleKernel::Point_3(x[0], x[1], x[2])));
  return tree->contains(x) ? -distance : distance;
}

Tensor<1, 3>
ClosedSurface::gradient(const Point<3> &x, const double near) const
{
  const auto [foot, triangle]
    = tree->distances.closest_point_and_primitive(DoubleKernel::Point_3(x[0], x[1], x[2]));
  Tensor<1, 3> result = x - Point<3>(foot[0], foot[1], foot[2]);
  if (result.norm() < near)
    {
      const Mesh::Face_index face(triangle - tree->triangles.cbegin());
      const Kernel::Vector_3 normal = PMP::compute_face_normal(face, tree->mesh);
      result                        = Tensor<1, 3>({normal[0], normal[1], normal[2]});
    }
  else if (tree->contains(x))
    result *= -1.;
  return result / result.norm();
}

double
ClosedSurface::volume() const
{
  return PMP::volume(tree->mesh);
}

std::vector<std::vector<Point<2>>>
ClosedSurface::section(const unsigned int axis, const double position) const
{
  const Kernel::Plane_3                     plane(axis == 0, axis == 1, axis == 2, -position);
  std::vector<std::vector<Kernel::Point_3>> lines;
  CGAL::Polygon_mesh_slicer<Mesh, Kernel>   slicer(tree->mesh);
  slicer(plane, std::back_inserter(lines));
  const unsigned int                 first = axis == 0 ? 1 : 0, second = axis == 2 ? 1 : 2;
  std::vector<std::vector<Point<2>>> outlines;
  for (const auto &line : lines)
    {
      if (line.size() < 4 || line.front() != line.back())
        continue; // an edge or a point that the plane touches
      outlines.emplace_back();
      for (std::size_t i = 0; i + 1 < line.size(); ++i)
        outlines.back().emplace_back(line[i][first], line[i][second]);
    }
  return outlines;
}
} // namespace scree
