// Advection of a ball by OpenVDB's narrow-band level sets and by the library: HJ-WENO5, TVD-RK3,
// one thread, 3D. Prints million active voxels times Runge-Kutta stages per second of OpenVDB, for
// the advection alone and with the tracking that its advect() includes; beside it million nodes
// times stages per second of hj_stage() in a band and of advect(), and the ratio to OpenVDB.

#include <cmath>
#include <cstdio>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetAdvect.h>
#include <openvdb/tools/LevelSetSphere.h>
#include <openvdb/tools/LevelSetTracker.h>
#include <tbb/global_control.h>

#include "stage_rate.h"

namespace
{
using Grid = openvdb::DoubleGrid;

// The field of turning().
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

struct Rates
{
  double stages, whole; // million nodes times stages per second
};

// A step of advect(), CFL 0.25 in every direction, in a band.
Rates
own_rates(const int n)
{
  const Lattice<3>      lattice = ball<3>(n);
  const HaloGrid<3>     grid{lattice.n_nodes(), lattice.spacing()};
  const NodalVectors<3> v = turning(lattice, 1.);
  Rates                 result;
  result.stages
    = stage_rate(lattice, nodes_near_contour(grid, lattice.values(), half_width * grid.spacing),
                 Upwinding::weno5);
  AdvectionScheme scheme;
  scheme.band          = half_width;
  Lattice<3>     moved = lattice;
  AdvectionCount count{};
  const double   time
    = fastest([&]() { moved.values() = lattice.values(); },
              [&]() { count = advect<3>(moved, v, 0.25 * lattice.spacing(), scheme); });
  result.whole = 3e-6 * count.n_steps * count.n_nodes / time;
  return result;
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
  const double alone        = 3e-6 * n_steps * voxels / (without_norm - n_steps * topology),
               whole        = 3e-6 * n_steps * voxels / with_tracking;
  const Rates own           = own_rates(n);
  std::printf("| %d^3 | %.0f | %.1f | %.1f | %.0f | %.0f | %.1f |\n", n, 1e-3 * voxels, alone,
              whole, own.stages, own.whole, own.stages / alone);
}
} // namespace

int
main()
{
  openvdb::initialize();
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  std::puts(
    "| lattice | thousand voxels of its band | OpenVDB, advection alone | with tracking | "
    "hj_stage() | advect() | hj_stage() / advection alone |\n|---|---|---|---|---|---|---|");
  for (const int n : {64, 128, 192})
    race(n);
}
