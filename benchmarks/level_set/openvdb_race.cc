// Advection of a ball by OpenVDB's narrow-band level sets: HJ-WENO5, TVD-RK3, one thread, 3D.
// Prints million active voxels times Runge-Kutta stages per second, for the advection alone and
// with the tracking that its advect() includes.

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetAdvect.h>
#include <openvdb/tools/LevelSetSphere.h>
#include <openvdb/tools/LevelSetTracker.h>
#include <tbb/global_control.h>

namespace
{
using Grid = openvdb::DoubleGrid;

// The turning field of rates.cc.
struct Turning
{
  using VectorType = openvdb::Vec3d;

  openvdb::Vec3d operator()(const openvdb::Vec3d &x, double) const
  {
    return {-x[1], x[0], 0.3 * x[0]};
  }

  openvdb::Vec3d operator()(const openvdb::Coord &ijk, double) const
  {
    return (*this)(spacing * ijk.asVec3d(), 0.);
  }

  const openvdb::math::Transform &transform() const
  {
    return *map;
  }

  double                        spacing;
  openvdb::math::Transform::Ptr map;
};

// The lowest CPU time of one call of f in seconds, of five.
template <typename F>
double
fastest(const F &f)
{
  double best = 1e300;
  for (int i = 0; i < 5; ++i)
    {
      const std::clock_t start = std::clock();
      f();
      best = std::min(best, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
  return best;
}

void
race(const int n)
{
  const double    h = 1. / (n - 1);
  const Grid::Ptr grid
    = openvdb::tools::createLevelSetSphere<Grid>(0.3f, openvdb::Vec3f(0.f), h, 3.f);
  const Turning field{h, openvdb::math::Transform::createLinearTransform(h)};
  const double  voxels = grid->activeVoxelCount();

  openvdb::tools::LevelSetAdvection<Grid, Turning> advection(*grid, field);
  advection.setSpatialScheme(openvdb::math::HJWENO5_BIAS);
  advection.setTemporalScheme(openvdb::math::TVD_RK3);
  advection.setTrackerSpatialScheme(openvdb::math::HJWENO5_BIAS);
  advection.setTrackerTemporalScheme(openvdb::math::TVD_RK3);
  advection.setGrainSize(0);
  openvdb::tools::LevelSetTracker<Grid> tracker(*grid);
  tracker.setGrainSize(0);

  std::size_t  n_steps       = 1;
  const double dt            = 0.25 * h,
               with_tracking = fastest([&]() { n_steps = advection.advect(0., dt); });
  advection.setNormCount(0);
  tracker.setNormCount(0);
  const double without_norm = fastest([&]() { advection.advect(0., dt); }),
               topology     = fastest([&]() { tracker.track(); });
  std::printf("| %d^3 | %.0f | %.1f | %.1f |\n", n, voxels,
              3e-6 * n_steps * voxels / (without_norm - n_steps * topology),
              3e-6 * n_steps * voxels / with_tracking);
}
} // namespace

int
main()
{
  openvdb::initialize();
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  std::puts(
    "| lattice | voxels of the band | advection alone | with tracking |\n|---|---|---|---|");
  for (const int n : {64, 128, 256})
    race(n);
}
