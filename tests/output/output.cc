// Tables and pieces of the output.
#include <gtest/gtest.h>

#include <scree/base/exceptions.h>
#include <scree/base/log.h>
#include <scree/output/body_output.h>
#include <scree/output/contact_output.h>
#include <scree/output/csv_table.h>
#include <scree/output/probes.h>
#include <scree/output/result_files.h>
#include <scree/output/vtu_files.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <sys/resource.h>
#include <sys/stat.h>

#include "../mechanics/equilibrium_model.h"
#include "files.h"

namespace scree
{
namespace
{
using namespace dealii;

TEST(ResultFiles, OfARunAreFoundAndThoseOfACheckAreNone)
{
  const Directory directory;
  const auto      put
    = [&](const std::string &name) { std::ofstream(directory.path + "/" + name) << "x"; };
  for (const std::string name :
       {"log.txt", "parameters.prm", "lock", "bodies_0000.vtu", "contact_0000.csv", "bodies.pvd",
        "regions.csv", "grid.pvtu", "setup.png", "my_bodies_0001.vtu", "checkpoint.new"})
    put(name);
  EXPECT_EQ(result_file_in(directory.path), "");
  for (const std::string name :
       {"history.csv", "grains.csv", "study.csv", "cycle-0", "checkpoint.old", "bodies_0001.vtu",
        "bodies_0010.0.vtu", "contact_0001.csv", "points_12345.pvtu", "chains_0002.vtp",
        "line_a_b_0003.csv"})
    {
      put(name);
      EXPECT_EQ(result_file_in(directory.path), name);
      std::filesystem::remove(directory.path + "/" + name);
    }
  EXPECT_EQ(result_file_in(directory.path + "/nowhere"), "");
}

TEST(CsvTable, RowsAreWrittenAtOnce)
{
  const Directory directory;
  CsvTable        table(directory.path + "/table.csv", {"a", "b"});
  table.add_row({1., -0.125});
  EXPECT_EQ(content(directory.path + "/table.csv"), "a,b\n1,-0.125\n");
  table.add_row({1. / 3., 2e-30});
  EXPECT_EQ(content(directory.path + "/table.csv"), "a,b\n1,-0.125\n0.333333333333,2e-30\n");
  EXPECT_THROW(CsvTable("/nowhere/table.csv", {"a"}), UserError);
}

TEST(CsvTable, GoesOnAfterSomeRowsAndCutsTheRest)
{
  const Directory   directory;
  const std::string name = directory.path + "/table.csv";
  {
    CsvTable table(name, {"a", "b"});
    for (unsigned int i = 0; i < 3; ++i)
      table.add_row({double(i), 0.5});
    EXPECT_EQ(table.n_rows(), 3u);
  }
  std::ofstream(name, std::ios::app) << "3,0"; // killed while it wrote
  {
    CsvTable table(name, {"a", "b"}, 2);
    EXPECT_EQ(content(name), "a,b\n0,0.5\n1,0.5\n");
    table.add_row({7., 8.});
    EXPECT_EQ(table.n_rows(), 3u);
  }
  EXPECT_EQ(content(name), "a,b\n0,0.5\n1,0.5\n7,8\n");
  std::ofstream(name, std::ios::app) << "3,0";
  EXPECT_THROW(CsvTable(name, {"a", "b"}, 4), UserError); // half a row is none
  EXPECT_THROW(CsvTable(name, {"a", "c"}, 1), UserError);
  EXPECT_THROW(CsvTable(directory.path + "/none.csv", {"a"}, 0), UserError);
}

TEST(CsvTable, APipeInItsPlaceIsNotWaitedFor)
{
  const Directory   directory;
  const std::string name = directory.path + "/table.csv";
  ASSERT_EQ(mkfifo(name.c_str(), 0600), 0);
  EXPECT_THROW(CsvTable(name, {"a"}), UserError);
  EXPECT_THROW(CsvTable(name, {"a"}, 0), UserError);
  EXPECT_THROW(Log(MPI_COMM_SELF, name), UserError);
  EXPECT_THROW(Log(MPI_COMM_SELF, name, true), UserError);
}

namespace
{
/** No file of this process may become longer, until it goes away. */
class FullDisk
{
public:
  explicit FullDisk(const rlim_t n_bytes)
      : handler(std::signal(SIGXFSZ, SIG_IGN))
  {
    getrlimit(RLIMIT_FSIZE, &old);
    struct rlimit small = old;
    small.rlim_cur      = n_bytes;
    setrlimit(RLIMIT_FSIZE, &small);
  }
  ~FullDisk()
  {
    setrlimit(RLIMIT_FSIZE, &old);
    std::signal(SIGXFSZ, handler);
  }

private:
  struct rlimit old;
  void (*const handler)(int);
};
} // namespace

TEST(CsvTable, RowsThatAFullDiskRefusesComeLater)
{
  const Directory         directory;
  const std::string       name = directory.path + "/table.csv";
  std::optional<FullDisk> disk(std::in_place, 10);
  CsvTable                table(name, {"a", "b"});
  table.add_row({1., 2.}); // 8 bytes so far
  EXPECT_TRUE(table.flush());
  table.add_row({3., 4.});
  table.add_row({5., 6.});
  EXPECT_FALSE(table.flush());
  EXPECT_EQ(content(name), "a,b\n1,2\n");
  disk.reset();
  table.add_row({7., 8.});
  EXPECT_TRUE(table.flush());
  EXPECT_EQ(content(name), "a,b\n1,2\n3,4\n5,6\n7,8\n");
}

TEST(VtuFiles, AFullDiskLeavesWhatWasWhole)
{
  const Directory   directory;
  const std::string name  = directory.path + "/records.pvd";
  const auto        write = [&](const std::string &text) {
    return write_file(name, [&](std::ostream &file) { file << text; });
  };
  EXPECT_TRUE(write("old"));
  std::optional<FullDisk> disk(std::in_place, 10);
  EXPECT_FALSE(write(std::string(100, 'x')));
  disk.reset();
  EXPECT_EQ(content(name), "old");
  EXPECT_FALSE(std::filesystem::exists(name + ".part"));
  EXPECT_TRUE(write("new"));
  EXPECT_EQ(content(name), "new");
}

TEST(CsvTable, AFileThatIsNoLongerThereIsAnError)
{
  const std::string name    = testing::TempDir() + "scree_removed.csv";
  const auto        message = [](CsvTable &table) -> std::string {
    try
      {
        table.add_row({1., 2.});
      }
    catch (const UserError &error)
      {
        return error.what();
      }
    return "";
  };
  for (const bool is_replaced : {false, true})
    {
      CsvTable table(name, {"a", "b"});
      EXPECT_EQ(message(table), "");
      std::remove(name.c_str());
      if (is_replaced)
        std::ofstream(name) << "another\n";
      EXPECT_NE(message(table).find("was removed or replaced"), std::string::npos);
    }
  std::remove(name.c_str());
}

TEST(VonMises, PlaneStrainAndThreeDimensions)
{
  SymmetricTensor<2, 2> plane;
  plane[0][0] = 3.;
  plane[0][1] = 1.;
  plane[1][1] = -1.;
  // sqrt(((s_x - s_y)^2 + (s_y - s_z)^2 + (s_z - s_x)^2)/2 + 3 tau^2)
  EXPECT_NEAR(von_mises(plane, 2.), std::sqrt(0.5 * (16. + 9. + 1.) + 3.), 1e-14);
  SymmetricTensor<2, 3> full;
  full[0][0] = full[1][1] = full[2][2] = 5.;
  EXPECT_NEAR(von_mises(full, 0.), 0., 1e-14);
  full[1][2] = 2.;
  EXPECT_NEAR(von_mises(full, 0.), std::sqrt(12.), 1e-14);
}

// deal.II's eigenvalues of such a tensor may be the root of a negative number.
TEST(BodyFields, PrincipalValuesOfIsotropicTensors)
{
  for (const double p : {0.1, 1. / 3., -7.123456789})
    for (const double q : {p, std::nextafter(p, 10.)})
      {
        SymmetricTensor<2, 2> tensor;
        tensor[0][0]      = p;
        tensor[1][1]      = q;
        tensor[0][1]      = 1e-17;
        const auto values = principal_values(tensor);
        EXPECT_NEAR(values[0], p, 1e-14);
        EXPECT_NEAR(values[1], p, 1e-14);
      }
  SymmetricTensor<2, 2> shear;
  shear[0][1] = 3.;
  EXPECT_EQ(principal_values(shear), (std::array<double, 2>{{3., -3.}}));
}

TEST(PlasticZone, RoundOffIsNoFlow)
{
  EXPECT_EQ(plastic_zone(0.), 0.);
  EXPECT_EQ(plastic_zone(1e-16), 0.);
  EXPECT_EQ(plastic_zone(1e-9), 1.);
}

/** Two blocks squeezed by d with a plane contact at y = 0: uniform pressure. */
std::string
squeezed_blocks()
{
  return grid_text("-1, -1", "1, 1", "4, 4", 1) + degree_text(1)
         + bodies_text(
           {{"lower",
             half_space_text("0, 0", "0, 1")
               + conditions_text({{"base", "set On = y-\nset Components = y\nset Value = 0"},
                                  {"left", "set On = x-\nset Components = x\nset Value = 0"}})},
            {"upper",
             half_space_text("0, 0", "0, -1")
               + conditions_text({{"top", "set On = y+\nset Components = y\n"
                                          "set Value = -0.01*t"},
                                  {"left", "set On = x-\nset Components = x\nset Value = 0"}})}})
         + contact_text("set Law = frictionless") + solver_text(1e-12);
}

TEST(ContactOutput, SummaryOfUniformPressure)
{
  EquilibriumModel<2> model(squeezed_blocks());
  ASSERT_TRUE(model.step(1.).converged());
  const auto summary = summarise_contact(model.contact, MPI_COMM_WORLD)[0];
  // Series of two blocks of height 1, E' = E/(1 - nu^2), and the penalty.
  const double h = model.cut.grid.finest_size(), eps_n = 10. * 1000. / h;
  const double pressure = 0.01 / (2. * (1. - 0.09) / 1000. + 1. / eps_n);
  EXPECT_NEAR(summary.force[1], 2. * pressure, 1e-8 * pressure);
  EXPECT_NEAR(summary.force[0], 0., 1e-8 * pressure);
  EXPECT_NEAR(summary.moment[2], 0., 1e-8 * pressure);
  EXPECT_NEAR(summary.minimum_gap, -pressure / eps_n, 1e-10);
  EXPECT_NEAR(summary.max_penetration, pressure / eps_n, 1e-10);
  EXPECT_NEAR(summary.slip, 2., 1e-12);
  EXPECT_EQ(summary.open, 0.);
  EXPECT_EQ(summary.stick, 0.);
}

TEST(ContactOutput, TableHasARowPerPoint)
{
  const Directory     directory;
  EquilibriumModel<2> model(squeezed_blocks());
  ASSERT_TRUE(model.step(1.).converged());
  write_contact_csv(model.contact, MPI_COMM_WORLD, directory.path, 3);
  std::ifstream file(directory.path + "/contact_0003.csv");
  std::string   line;
  ASSERT_TRUE(std::getline(file, line));
  EXPECT_NE(line.find("pressure"), std::string::npos);
  const auto   n_columns = std::count(line.begin(), line.end(), ',');
  unsigned int n_rows    = 0;
  while (std::getline(file, line))
    {
      ++n_rows;
      EXPECT_EQ(std::count(line.begin(), line.end(), ','), n_columns) << line;
    }
  EXPECT_EQ(n_rows, model.contact.points().size());
}

TEST(Probes, UniaxialStrain)
{
  EquilibriumModel<2> model(squeezed_blocks());
  ASSERT_TRUE(model.step(1.).converged());
  ProbeParameters<2> probe;
  probe.name      = "line";
  probe.body      = "upper";
  probe.start     = Point<2>(-0.5, 0.25);
  probe.end       = Point<2>(0.5, 0.75);
  probe.n_points  = 5;
  const auto u    = model.equilibrium.with_ghosts(model.state.displacement);
  const auto rows = sample(probe, 1, *model.cut.space, model.bulk, u, true);
  ASSERT_EQ(rows.size(), 5u);
  const auto names  = sample_columns(probe);
  const auto column = [&](const std::string &name) {
    return std::find(names.begin(), names.end(), name) - names.begin();
  };
  const double pressure
    = 0.01 / (2. * (1. - 0.09) / 1000. + model.cut.grid.finest_size() / 10. / 1000.);
  for (unsigned int i = 0; i < 5; ++i)
    {
      EXPECT_NEAR(rows[i][column("x")], -0.5 + 0.25 * i, 1e-14);
      EXPECT_NEAR(rows[i][column("y")], 0.25 + 0.125 * i, 1e-14);
      EXPECT_NEAR(rows[i][column("stress_yy")], -pressure, 1e-8 * pressure);
      EXPECT_NEAR(rows[i][column("stress_xx")], 0., 1e-8 * pressure);
      EXPECT_NEAR(rows[i][column("stress_zz")], -0.3 * pressure, 1e-8 * pressure);
      const double eps_yy = -pressure * (1. - 0.09) / 1000.;
      EXPECT_NEAR(rows[i][column("u_y")], -0.01 + eps_yy * (rows[i][1] - 1.), 1e-10);
    }
  probe.start = probe.end = Point<2>(0.5, -0.9);
  EXPECT_THROW(sample(probe, 1, *model.cut.space, model.bulk, u, true), UserError);
}

TEST(BodyOutput, OnlyThePhysicalPartIsWritten)
{
  const Directory     directory;
  EquilibriumModel<2> model(
    grid_text("-1, -1", "1, 1", "4, 4", 3) + degree_text(1)
    + bodies_text(
      {{"disc", ball_text("0, 0", 0.7)
                  + conditions_text({{"held", "set On = surface\nset Value = 0; 0"}})}}));
  const BodyOutput<2> output(*model.cut.space, *model.cut.level_set_nodes, model.cut.bodies);
  const std::string   name
    = output.write(model.kinematics, model.equilibrium.with_ghosts(model.state.displacement),
                   nullptr, directory.path, 0, 0.5);
  EXPECT_EQ(name, "bodies_0000.vtu");
  const std::string text = content(directory.path + "/" + name);
  EXPECT_NE(text.find("displacement"), std::string::npos);
  EXPECT_NE(text.find("von_mises"), std::string::npos);
  // On a fixed geometry points are where they were at the start.
  EXPECT_NE(text.find("Name=\"points_are_moved\" NumberOfTuples=\"1\" format=\"ascii\">0<"),
            std::string::npos);
  EXPECT_NE(text.find("Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">0.5<"),
            std::string::npos);
}

/** The volume of a ball of radius 0.7 in the output, all of whose simplices are right-handed. */
double
volume_of_pieces(const unsigned int level, const unsigned int degree)
{
  EquilibriumModel<3> model(grid_text("-1, -1, -1", "1, 1, 1", "4, 4, 4", level)
                            + degree_text(degree)
                            + bodies_text({{"ball", ball_text("0.01, 0.02, 0.03", 0.7)}}));
  const BodyOutput<3> output(*model.cut.space, *model.cut.level_set_nodes, model.cut.bodies);
  double              volume = 0.;
  for (const auto &piece : output.pieces())
    {
      double part = 1.;
      if (piece.vertices.size() == 4)
        {
          Tensor<2, 3> edges;
          for (unsigned int d = 0; d < 3; ++d)
            edges[d] = piece.vertices[d + 1] - piece.vertices[0];
          part = determinant(edges) / 6.;
          EXPECT_GE(part, 0.);
        }
      volume += part * std::pow(model.cut.grid.finest_size(), 3);
    }
  return volume;
}

TEST(BodyOutput, SimplicesFillABall)
{
  // The straight pieces of a curved surface: second order, 6.4% of the volume for h = 0.25.
  const double exact = 4. / 3. * numbers::PI * 0.343;
  for (const unsigned int degree : {1, 2})
    {
      const double coarse = std::abs(volume_of_pieces(1, degree) - exact),
                   fine   = std::abs(volume_of_pieces(2, degree) - exact);
      EXPECT_LT(coarse, 0.065 * exact);
      EXPECT_LT(fine, 0.35 * coarse);
    }
}
} // namespace
} // namespace scree
