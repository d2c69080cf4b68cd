#pragma once

#include <scree/state/placed_values.h>
#include <scree/state/state.h>

#include <boost/serialization/array.hpp>
#include <string>
#include <vector>

namespace scree
{
/**
 * A State after an accepted step as a checkpoint holds it: what is distributed is listed by place
 * or by process, so that any number of processes may go on from it. The time is that of
 * StepControl.
 */
template <int dim>
struct GatheredState
{
  /** The BodyGeometry of a deformable body, the pose of a rigid one. */
  struct Geometry
  {
    typename Lattice<dim>::Index      lower = {}, n_nodes = {}; //!< of the lattice
    std::vector<double>               level_set;                //!< nodal values [L]
    typename Lattice<dim>::Index      initial_lower = {}, initial_n_nodes = {}; //!< after a reset
    std::vector<double>               initial_level_set;                        //!< the same
    dealii::BoundingBox<dim>          box;
    typename RigidPose<dim>::Unknowns pose = {};
    ExtendedIncrement<dim>            displacement;
    bool                              has_shape = false;

    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &lower &n_nodes &level_set &initial_lower &initial_n_nodes &initial_level_set &box
        &pose &displacement &has_shape;
    }
  };

  Energies energies;
  double   last_step_size = 0.; //!< Predictor::step_size
  bool     has_inertia    = false;
  bool     is_reset       = false; //!< displacements of a moving geometry are not from the start

  // On a fixed geometry.
  PlacedValues<dim>   nodes;    //!< by body: displacement and Predictor::rates
  PlacedValues<dim>   contact;  //!< by pair: tau, jump, pressure, State::was_closed
  std::vector<double> trailing; //!< the same of unknowns without a node

  // On a moving geometry.
  std::vector<std::vector<double>>               points; //!< of each process: pack()
  std::vector<Geometry>                          bodies;
  StepEnd<dim>                                   step_end;
  StartGaps                                      start_gaps;
  std::vector<ExtendedIncrement<dim>>            increments_of_bodies; //!< of Predictor
  std::vector<typename RigidPose<dim>::Unknowns> increments_of_rigid;
  std::vector<std::array<typename RigidPose<dim>::Unknowns, 3>> rates_of_rigid;

  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &energies &last_step_size &has_inertia &is_reset &nodes &contact &trailing &points
      &bodies &step_end &start_gaps &increments_of_bodies &increments_of_rigid &rates_of_rigid;
  }
};

/** The state on process 0; collective. @param is_reset see GatheredState */
template <int dim>
GatheredState<dim> gather(const State<dim> &state, const DisplacementSpace<dim> &space,
                          const ContactPoints<dim> &contact, const bool is_moving,
                          const bool is_reset = false);

/**
 * Sets the state of a fixed geometry that was set up on these fields and contact points; the time
 * is left (collective).
 *
 * @param directory of the checkpoint, for messages
 * @throws UserError if it was saved on others
 */
template <int dim>
void restore_fixed(const GatheredState<dim> &saved, const DisplacementSpace<dim> &space,
                   const ContactPoints<dim> &contact, const std::string &directory,
                   State<dim> &state);

/**
 * Sets the state of a moving geometry but displacement, history of contact and time, which the
 * start of a step gives, and the level sets of rigid bodies, which follow from
 * `saved.bodies[b].pose`. The points are spread evenly over the processes, in the order of those
 * that had them.
 *
 * @throws UserError if the state contradicts itself or the bodies
 */
template <int dim>
void restore_moving(const GatheredState<dim> &saved, const dealii::BoundingBox<dim> &background,
                    const MPI_Comm communicator, const std::string &directory, State<dim> &state);
} // namespace scree
