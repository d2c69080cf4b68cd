#pragma once

#include <scree/mechanics/moving_level_sets.h>
#include <scree/output/results.h>
#include <scree/solver/step_control.h>
#include <scree/state/placed_values.h>

#include <boost/serialization/map.hpp>
#include <boost/serialization/set.hpp>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace scree
{
/** The last increment on a moving geometry, to begin the next iteration with. */
template <int dim>
struct Predictor
{
  std::vector<ExtendedIncrement<dim>>            of_bodies; //!< deformable ones, else empty
  std::vector<typename RigidPose<dim>::Unknowns> of_rigid;
  double                                         step_size = 0.; //!< 0: there is none

  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &of_bodies &of_rigid &step_size;
  }
};

/** Where a body is: the level set and box of a deformable one, the pose of a rigid one. */
template <int dim>
struct BodyPlace
{
  typename Lattice<dim>::Index      lower = {}, n_nodes = {}; //!< of the lattice
  std::vector<double>               level_set;                //!< nodal values [L]
  dealii::BoundingBox<dim>          box;
  typename RigidPose<dim>::Unknowns pose = {};
  ExtendedIncrement<dim>            displacement; //!< x - X

  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &lower &n_nodes &level_set &box &pose &displacement;
  }
};

/** What a run on a fixed geometry needs besides. */
template <int dim>
struct FixedState
{
  Energies            energies;
  PlacedValues<dim>   nodes;   //!< by body: displacement, then increment per time of the last step
  PlacedValues<dim>   contact; //!< by pair: tau, jump, pressure, whether it was closed at some time
  std::vector<double> trailing; //!< unknowns without a node, the same for them

  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &energies &nodes &contact &trailing;
  }
};

/** What a run on a moving geometry needs besides. */
template <int dim>
struct MovingState
{
  std::vector<std::vector<double>> points; //!< of each process, see MaterialPoints::pack()
  std::vector<BodyPlace<dim>>      bodies;
  StepEnd<dim>                     step_end;
  Predictor<dim>                   predictor;

  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &points &bodies &step_end &predictor;
  }
};

/**
 * All that a run needs to go on after an accepted step, on any number of processes: what its input
 * and its files do not tell.
 */
template <int dim>
struct Checkpoint
{
  std::string                                     program;    //!< version that wrote it
  std::map<std::string, std::string>              parameters; //!< of the run, value by path
  StepControlRecord                               steps;
  ResultsRecord                                   results;
  std::set<std::pair<unsigned int, unsigned int>> warned_pairs;
  bool                                            is_second_attempt = false;
  FixedState<dim>                                 fixed;
  MovingState<dim>                                moving;

  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &program &parameters &steps &results &warned_pairs &is_second_attempt &fixed &moving;
  }

  /** Writes it into a directory (write_checkpoint_file()); by one process. Returns its bytes. */
  std::size_t write(const std::string &directory) const;

  /** What the newest undamaged one of a directory holds, on all processes; collective. */
  static Checkpoint read(const std::string &directory, const MPI_Comm communicator);

  /** Why it is not the newest one; empty: it is. Not stored. */
  std::string warning;
};

/**
 * @throws UserError unless parameters differ only where a run may be changed on its way: in
 * sections Time, Solver and Output (but its probes) and the title
 */
void require_resumable(const std::map<std::string, std::string> &before,
                       const std::map<std::string, std::string> &now);
} // namespace scree
