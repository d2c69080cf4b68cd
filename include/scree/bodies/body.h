#pragma once

#include <scree/bodies/body_family.h>
#include <scree/bodies/boundary_condition.h>
#include <scree/bodies/rigid_body.h>
#include <scree/geometry/shape_parameters.h>
#include <scree/level_set/extended_increment.h>
#include <scree/material/increment_law.h>
#include <scree/parameters/section.h>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace scree
{
/** Parameters of one named body. */
template <int dim>
struct BodyParameters
{
  std::string          name;
  std::string          path; //!< section path, for messages
  std::string          material;
  ShapeParameters<dim> shape;
  /** Makes the shape of a body of a family; empty: `shape` tells it. */
  std::function<ShapePointer<dim>()> shape_of_member;
  std::string                        family; //!< that it belongs to, or empty
  /** Makes what section Shape says of a body of a family; empty: none can. */
  std::function<ShapeParameters<dim>()> listed_shape;
  std::string                           body_force = dim == 2 ? "0; 0" : "0; 0; 0";
  double                                density    = 0.;       //!< of the material [mass/L^dim]
  std::string         gravity = dim == 2 ? "0; 0" : "0; 0; 0"; //!< of all bodies [L/time^2]
  std::string         initial_velocity = dim == 2 ? "0; 0" : "0; 0; 0";
  std::vector<double> initial_spin; //!< about its centre of mass [rad/time]; empty: none
  /** Named boundary conditions with their section paths. */
  std::vector<std::pair<std::string, BoundaryConditionParameters<dim>>> conditions;
  MotionParameters<dim>                                                 motion; //!< of a rigid body

  /** Returns the bodies of the family that the section describes, if it is one. */
  std::optional<std::vector<FamilyMember<dim>>> declare(ParameterSection &section);
};

/**
 * Reads section Bodies: `set Names = ...` and one subsection per name, of a body or of a family. A
 * family with problems leaves one body.
 */
template <int dim>
std::vector<BodyParameters<dim>>
declare_bodies(ParameterSection                                &section,
               const std::map<std::string, MaterialParameters> &materials);

/**
 * What a body is, the same throughout a run: its material and what acts on it. A rigid body has no
 * material but a motion.
 */
template <int dim>
struct BodyDefinition
{
  std::string                           name;
  std::string                           path; //!< section path, for messages
  std::shared_ptr<const Material<dim>>  material;
  std::shared_ptr<const RigidBody<dim>> rigid;      //!< null: the body is deformable
  Expression<dim>                       body_force; //!< force per volume
  std::vector<BoundaryCondition<dim>>   conditions;
  double                                density = 0.;     //!< [mass/L^dim]
  Expression<dim>                       gravity;          //!< formulas of t [L/time^2]
  Expression<dim>                       initial_velocity; //!< at t = 0 [L/time]
  dealii::Tensor<1, 3>                  initial_spin;     //!< about its centre [rad/time]
  /** The law of moving geometry; null if the geometry stays or the body is rigid. */
  std::shared_ptr<const IncrementLaw<dim>> law = nullptr;
  /** The level set at the start of a run with moving geometry; null for rigid bodies. */
  std::shared_ptr<const Lattice<dim>> initial_level_set = nullptr;

  bool is_rigid() const
  {
    return rigid != nullptr;
  }

  /** Force per volume by gravity [force/L^dim]. */
  dealii::Tensor<1, dim> weight(const double time) const
  {
    return density * gravity.vector(dealii::Point<dim>(), time);
  }
};

/** Where a body is, a part of State: the geometry is the initial one unless `pose` says otherwise.
 */
template <int dim>
struct BodyGeometry
{
  Lattice<dim>             level_set; //!< negative inside, nodal values [L]
  dealii::BoundingBox<dim> box;       //!< of the body, clipped by the background box [L]
  /** The pose in which level_set and box show a rigid body. */
  RigidPose<dim> pose = {};
  /** At the start of a run; null if the body's motion has left it unknown. */
  std::shared_ptr<const Shape<dim>> shape = nullptr;
  /** u = x - X where the body is now, X where it was at the start; empty if it has not moved. */
  ExtendedIncrement<dim> displacement = {};
};

/** A body: what it is and where it is. */
template <int dim>
struct Body : BodyDefinition<dim>, BodyGeometry<dim>
{
  Body(const BodyDefinition<dim> &definition, const BodyGeometry<dim> &geometry)
      : BodyDefinition<dim>(definition)
      , BodyGeometry<dim>(geometry)
  {
  }
};

/** Where the material that is at `x` was at the start of the run, where the body's shape sees it.
 */
template <int dim>
dealii::Point<dim> initial_position(const Body<dim> &body, const dealii::Point<dim> &x);

/** dX/dx = F^-1 of initial_position(), where the body has deformed by central differences over a
 * spacing of its lattice: continuous. */
template <int dim>
dealii::Tensor<2, dim> initial_gradient(const Body<dim> &body, const dealii::Point<dim> &x);

/** The level set phi(X(x)) of a piece of the body's shape where the body is now, and its gradient.
 */
template <int dim>
std::pair<double, dealii::Tensor<1, dim>> value_and_gradient(const Body<dim>          &body,
                                                             const SmoothPiece<dim>   &piece,
                                                             const dealii::Point<dim> &x);

/**
 * Builds the bodies: shape -> lattice, with `margin` [L] around the shape. Rigid bodies may lie
 * within the margin around the background box, deformable ones are clipped by it. The lattices of
 * deformable bodies are dense if `is_moving`.
 * @throws UserError if a body lies outside the background box, a rigid body has boundary conditions
 * or a body force, or a deformable one a motion
 */
template <int dim>
std::vector<Body<dim>>
make_bodies(const std::vector<BodyParameters<dim>>                            &parameters,
            const std::map<std::string, std::shared_ptr<const Material<dim>>> &materials,
            const LatticeFrame<dim> &frame, const double margin, const bool is_moving = true);
} // namespace scree
