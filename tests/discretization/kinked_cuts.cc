// Volumes and surfaces of shapes with kinks: exact for planes, on grid lines and off them, second
// order for curves.
#include <gtest/gtest.h>

#include <scree/discretization/cut_quadrature.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <iostream>

#include "cut_bodies.h"

namespace scree
{
namespace
{
using namespace dealii;

template <int dim>
struct Measure
{
  double         volume = 0., surface = 0., flux = 0.; // flux: int x.n, dim times the volume
  Tensor<1, dim> normals;                              // int n: zero
  double         strip = 0.;                           // between planes and their cuts: zero
};

template <int dim>
Measure<dim>
measure(const CutBodies<dim> &model)
{
  const CutQuadrature<dim> quadrature(*model.space, *model.level_set_nodes, model.bodies);
  Measure<dim>             result;
  for (unsigned int a = 0; a < model.space->n_owned_cells(); ++a)
    {
      const auto &cell     = model.space->cells()[a];
      const auto &geometry = model.grid.cells()[cell.grid_cell];
      double      volume   = cell.is_cut ? 0. : std::pow(geometry.size, dim);
      for (unsigned int q = quadrature.bulk.begin[a]; q < quadrature.bulk.begin[a + 1]; ++q)
        {
          EXPECT_GT(quadrature.bulk.weights[q], 0.);
          volume += quadrature.bulk.weights[q];
          for (unsigned int d = 0; d < dim; ++d)
            EXPECT_TRUE(quadrature.bulk.points[q][d] >= -1e-12
                        && quadrature.bulk.points[q][d] <= 1. + 1e-12);
        }
      EXPECT_GT(volume, 0.); // a cell that the body only touches carries nothing
      result.volume += volume;
      for (unsigned int q = quadrature.surface.begin[a]; q < quadrature.surface.begin[a + 1]; ++q)
        {
          const Tensor<1, dim> &normal = quadrature.surface.normals[q];
          const double          weight = quadrature.surface.weights[q];
          EXPECT_NEAR(normal.norm(), 1., 1e-12);
          result.surface += weight;
          result.normals += weight * normal;
          result.strip += weight * std::abs(quadrature.strip_widths[q]);
          result.flux
            += weight
               * ((geometry.lower + geometry.size * Tensor<1, dim>(quadrature.surface.points[q]))
                  * normal);
        }
    }
  result.volume  = Utilities::MPI::sum(result.volume, MPI_COMM_WORLD);
  result.surface = Utilities::MPI::sum(result.surface, MPI_COMM_WORLD);
  result.flux    = Utilities::MPI::sum(result.flux, MPI_COMM_WORLD);
  result.normals = Utilities::MPI::sum(result.normals, MPI_COMM_WORLD);
  result.strip   = Utilities::MPI::sum(result.strip, MPI_COMM_WORLD);
  return result;
}

/** A shape of 2 units about the origin, its volume and its surface. */
struct Case
{
  std::string name, shape;
  double      volume, surface;
};

std::string
shape(const std::string &lines)
{
  return "subsection Shape\n" + lines + "\nend\n";
}

std::string
part(const std::string &name, const std::string &lines)
{
  return "subsection " + name + "\n" + lines + "\nend\n";
}

std::string
combined(const std::string &type, const std::vector<std::string> &parts)
{
  std::string names, text;
  for (unsigned int i = 0; i < parts.size(); ++i)
    {
      const std::string name = "p" + std::to_string(i);
      names += (i > 0 ? ", " : "") + name;
      text += part(name, parts[i]);
    }
  return shape("set Type = " + type + "\nset Parts = " + names + "\n" + text);
}

std::string
box(const std::string &lower, const std::string &upper)
{
  return "set Type = box\nset Lower corner = " + lower + "\nset Upper corner = " + upper;
}

std::string
half(const std::string &point, const std::string &normal)
{
  return "set Type = half space\nset Point = " + point + "\nset Normal = " + normal;
}

std::vector<Case>
cases_2d()
{
  const std::string turn = "\nset Rotation angle = 31\nset Rotation centre = 0.1, 0.2";
  const std::string l    = "set Type = polygon\nset Vertices = "
                           "-0.5, -0.5; 1, -0.5; 1, 0; 0, 0; 0, 1; -0.5, 1";
  return {
    {"box", shape(box("-0.5, -0.75", "0.5, 0.25")), 1., 4.},
    {"turned box", shape(box("-0.5, -0.75", "0.5, 0.25") + turn), 1., 4.},
    {"L", shape(l), 1.25, 6.},
    {"turned L", shape(l + turn), 1.25, 6.},
    {"star",
     shape("set Type = polygon\nset Vertices = 1, 0; 0.25, 0.25; 0, 1; -0.25, 0.25; -1, 0; "
           "-0.25, -0.25; 0, -1; 0.25, -0.25"),
     1., 8. * std::hypot(0.75, 0.25)},
    {"triangle",
     combined("intersection",
              {half("0, -0.5", "0, -1"), half("0, 0.5", "1, 1"), half("0, 0.5", "-1, 1")}),
     1., 2. + 2. * std::sqrt(2.)},
    {"U", combined("difference", {box("-0.5, -0.5", "0.5, 0.5"), box("-0.25, 0", "0.25, 2")}), 0.75,
     5.},
    {"formula",
     shape("set Type = expression\nset Expression = max(1e-9*(x - 0.5), -x - 0.5, "
           "min(y + 0.25, y - 0.5), -y - 0.75)"),
     1.25, 4.5},
    {"tower", combined("union", {box("-0.5, -0.5", "0.5, 0"), box("-0.25, 0", "0.25, 0.5")}), 0.75,
     4.},
  };
}

std::vector<Case>
cases_3d()
{
  const std::string turn
    = "\nset Rotation angle = 31\nset Rotation axis = 1, 2, 3\nset Rotation centre = 0.1, 0.2, 0";
  return {
    {"cube", shape(box("-0.5, -0.5, -0.5", "0.5, 0.5, 0.5")), 1., 6.},
    {"turned cube", shape(box("-0.5, -0.5, -0.5", "0.5, 0.5, 0.5") + turn), 1., 6.},
    {"notched cube",
     combined("difference", {box("-0.5, -0.5, -0.5", "0.5, 0.5, 0.5"), box("0, 0, 0", "1, 1, 1")}),
     0.875, 6.},
    {"tower",
     combined("union", {box("-0.5, -0.5, -0.5", "0.5, 0.5, 0"), box("-0.5, -0.5, 0", "0, 0, 0.5")}),
     0.625, 5.},
    {"tetrahedron",
     combined("intersection",
              {half("-0.75, 0, 0", "-1, 0, 0"), half("0, -0.75, 0", "0, -1, 0"),
               half("0, 0, -0.75", "0, 0, -1"), half("0.85, -0.75, -0.75", "1, 1, 1")}),
     std::pow(1.6, 3) / 6., 2.56 * (1.5 + 0.5 * std::sqrt(3.))},
  };
}

/** The worst relative error of a shape on the grid moved by `offset`, with graded cells or not. */
template <int dim>
double
error_of(const Case &shape, const unsigned int degree, const unsigned int level,
         const double offset, const bool graded)
{
  const auto all = [](const double x) {
    std::ostringstream text;
    text.precision(16);
    for (unsigned int d = 0; d < dim; ++d)
      text << (d > 0 ? ", " : "") << x;
    return text.str();
  };
  const std::string more
    = graded ? graded_text(level - 1, " set Cell size limit = if(x > 0.1, 0.01, 10)") : "";
  const CutBodies<dim> model(
    grid_text(all(-1.5 + offset), all(1.5 + offset), dim == 2 ? "6, 6" : "6, 6, 6", level, more)
    + degree_text(degree) + bodies_text({{"body", shape.shape}}));
  const Measure<dim> found = measure(model);
  return std::max({std::abs(found.volume / shape.volume - 1.),
                   std::abs(found.surface / shape.surface - 1.),
                   std::abs(found.flux / (dim * shape.volume) - 1.), found.normals.norm(),
                   found.strip / shape.volume});
}

/** Where cells end; the finer shades are tried on one process, without the assertions of deal.II.
 */
std::vector<double>
offsets()
{
#ifdef DEBUG
  const bool all = false;
#else
  const bool all = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1;
#endif
  return all ? std::vector<double>{0., 1e-11, -3e-9, 1e-4, 0.0371}
             : std::vector<double>{0., 0.0371};
}

TEST(KinkedCutsMPI, PlanesInTwoDimensionsAreExact)
{
  for (const Case &shape : cases_2d())
    for (const unsigned int degree : {1, 2})
      for (const unsigned int level : {0, 2})
        for (const double offset : offsets())
          EXPECT_LT(error_of<2>(shape, degree, level, offset, false), 2e-10)
            << shape.name << ", degree " << degree << ", level " << level << ", offset " << offset;
}

TEST(KinkedCutsMPI, PlanesInThreeDimensionsAreExact)
{
  for (const Case &shape : cases_3d())
    for (const unsigned int degree : {1, 2})
      for (const double offset : offsets())
        EXPECT_LT(error_of<3>(shape, degree, 0, offset, false), 2e-10)
          << shape.name << ", degree " << degree << ", offset " << offset;
}

TEST(KinkedCutsMPI, PlanesAreExactAtHangingNodes)
{
  for (const unsigned int degree : {1, 2})
    for (const double offset : {0., 0.0371})
      {
        for (const Case &shape : cases_2d())
          EXPECT_LT(error_of<2>(shape, degree, 2, offset, true), 2e-10)
            << shape.name << ", degree " << degree << ", offset " << offset;
        for (const Case &shape : cases_3d())
          EXPECT_LT(error_of<3>(shape, degree, 1, offset, true), 2e-10)
            << shape.name << ", degree " << degree << ", offset " << offset;
      }
}

TEST(KinkedCuts, SheetsOfOneCellAreExact)
{
  const double h = 0.25;
  for (const double angle : {0., 30.})
    for (const double thickness : {1., 1.2, 1.7})
      for (const double place : {0., 0.3, 0.9})
        {
          std::ostringstream lines;
          lines.precision(16);
          lines << "set Type = box\nset Lower corner = -0.9, " << place * h
                << "\nset Upper corner = 0.9, " << (place + thickness) * h
                << "\nset Rotation angle = " << angle;
          const Case sheet{"sheet", shape(lines.str()), 1.8 * thickness * h,
                           3.6 + 2. * thickness * h};
          for (const unsigned int degree : {1, 2})
            EXPECT_LT(error_of<2>(sheet, degree, 1, 0., false), 2e-10)
              << degree << ", " << angle << ", " << thickness << ", " << place;
        }
}

TEST(KinkedCuts, CurvedPiecesAreSecondOrder)
{
  // A box with a round notch, and what the notch took: a disc in a box.
  const double      r = 0.4, piece = 0.5 * M_PI * r * r;
  const std::string disc   = "set Type = disc\nset Centre = 0.5, 0\nset Radius = 0.4";
  const std::string square = box("-0.5, -0.5", "0.5, 0.5");
  for (const Case &shape :
       {Case{"notch", combined("difference", {square, disc}), 1. - piece, 4. - 2. * r + M_PI * r},
        Case{"half disc", combined("intersection", {square, disc}), piece, 2. * r + M_PI * r},
        Case{"thin ring",
             "subsection Shape\nset Type = ring\nset Centre = 0.01, 0.02\nset Radius = 0.8\n"
             "set Inner radius = 0.65\nend\n",
             M_PI * (0.64 - 0.4225), 2. * M_PI * 1.45}})
    for (const unsigned int degree : {1, 2})
      {
        std::vector<double> errors;
        for (const unsigned int level : {2, 4})
          {
            errors.push_back(error_of<2>(shape, degree, level, 0.0371, false));
            const double h = 0.5 / (1u << level);
            EXPECT_LT(errors.back(), 10. * h * h) << shape.name;
          }
        std::cout << "  " << shape.name << ", degree " << degree << ": " << errors[0] << ", "
                  << errors[1] << "\n";
        EXPECT_GT(std::log2(errors[0] / errors[1]) / 2., 1.5) << shape.name;
      }
}

TEST(KinkedCuts, FacesOnTheBackgroundBoxBelongToIt)
{
  // The body fills the box but for a half: its faces there are whole.
  const CutBodies<2> model(grid_text("0, 0", "1, 1", "4, 4", 0) + degree_text(1)
                           + bodies_text({{"body", shape(box("0, 0", "1, 0.5"))}}));
  CutCellRules<2>    rules = model.level_set_nodes->rules();
  for (unsigned int face = 0; face < 4; ++face)
    {
      double length = 0.;
      for (unsigned int a = 0; a < model.space->n_owned_cells(); ++a)
        {
          const auto cell = model.space->cells()[a].grid_cell;
          if (!model.grid.cells()[cell].iterator->at_boundary(face))
            continue;
          const auto cut = model.level_set_nodes->cut(cell, model.bodies[0]);
          for (const double weight :
               rules.face_rule(cut, model.grid.cells()[cell].size, face).weights)
            length += weight;
        }
      EXPECT_NEAR(length, face < 2 ? 0.5 : face == 2 ? 1. : 0., 1e-12);
    }
  EXPECT_EQ(model.space->n_owned_cells(), 8u);
}
} // namespace
} // namespace scree
