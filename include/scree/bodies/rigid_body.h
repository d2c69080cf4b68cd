#pragma once

#include <scree/base/expression.h>
#include <scree/geometry/shape_moments.h>
#include <scree/parameters/section.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace scree
{
/** Components of a rigid motion: dim translations, then the rotation (2D) or rotation vector. */
template <int dim>
constexpr unsigned int n_rigid_components = dim == 2 ? 3 : 6;

/** "x", "y", "rotation" or "x", "y", "z", "rotation x", ... */
template <int dim>
std::vector<std::string> rigid_component_names();

/**
 * Section Motion of a rigid body. Per component either the motion is prescribed (zero if nothing is
 * said), or the force or moment is given and the motion unknown.
 */
template <int dim>
struct MotionParameters
{
  std::string                                      path;
  std::vector<double>                              reference_point; //!< empty: centre of the box
  std::array<std::string, n_rigid_components<dim>> motion;          //!< formulas of t, empty: unset
  std::array<std::string, n_rigid_components<dim>> load;            //!< formulas of t, empty: unset
  bool                                             is_given = false;

  void declare(ParameterSection &section);
};

/** A rigid body: its reference point and what drives each component of its motion. */
template <int dim>
class RigidBody
{
public:
  /**
   * @param box     of the shape; its centre is the default of the reference point
   * @param picture coarse level set of the whole body
   * @param shape   at the initial position
   * @param density mass per volume, not negative
   */
  RigidBody(const MotionParameters<dim> &parameters, const dealii::BoundingBox<dim> &box,
            const Lattice<dim> &picture, const std::shared_ptr<const Shape<dim>> &shape,
            const double density = 0.);

  /** Drives it otherwise from now on. @return whether other components are free */
  bool set_motion(const MotionParameters<dim> &parameters);

  dealii::Point<dim>       reference_point;
  double                   radius;  //!< half the largest edge of its box [L], scales the rotations
  dealii::BoundingBox<dim> box;     //!< of the whole body
  Lattice<dim>             picture; //!< coarse level set of the whole body, for output
  std::shared_ptr<const Shape<dim>> shape;   //!< at the initial position
  double                            density; //!< [mass/L^dim]
  ShapeMoments<dim> moments; //!< at the initial position; not computed without density

  /** Whether the motion of a component is unknown, its force or moment given. */
  bool is_free(const unsigned int component) const
  {
    return free[component];
  }

  /** Whether a component is free. */
  bool is_free() const;

  /**
   * Prescribed displacement [L] or rotation [rad] of a component, or the force or moment that acts
   * on a free one. @throws UserError if the formula gives no finite number
   */
  double value(const unsigned int component, const double time) const;

private:
  std::string                               path;
  std::array<bool, n_rigid_components<dim>> free = {};
  std::vector<Expression<dim>>              values;
};

/**
 * Where a rigid body is: u(X) = (R - I)(X - X_c) + U with R = exp [theta], a finite rotation by the
 * rotation vector theta (2D: about z), and the derivatives of u with respect to the unknowns
 * q = (U, L theta), L the radius of the body. In 3D they degenerate at |theta| = 2 pi.
 *
 * With s = theta.theta and Stumpff's functions c_k(s) = sum_j (-s)^j/(2j+k)!,
 *
 *     R r = c_0 r + c_1 theta x r + c_2 theta (theta.r).
 */
template <int dim>
class RigidPose
{
public:
  using Unknowns = std::array<double, n_rigid_components<dim>>;

  /** Where a body was at the start: q = 0. */
  RigidPose();

  RigidPose(const RigidBody<dim> &body, const Unknowns &q);

  /** The q of the same pose with |theta| <= pi, of free rotations in 3D; else q. */
  static Unknowns unwound(const RigidBody<dim> &body, const Unknowns &q);

  /** q = (U, L theta) [L]. */
  const Unknowns &unknowns() const
  {
    return q;
  }

  /** U [L]. */
  dealii::Tensor<1, dim> translation() const
  {
    return shift;
  }

  /** theta [rad]; 2D: the last component. */
  dealii::Tensor<1, 3> rotation() const
  {
    return theta;
  }

  /** u at the initial position X. */
  dealii::Tensor<1, dim> displacement(const dealii::Point<dim> &X) const;

  /** X of the point that is at x: the inverse of X + u(X). */
  dealii::Point<dim> initial_position(const dealii::Point<dim> &x) const;

  /** dX/dx = R^T of that inverse. */
  dealii::Tensor<2, dim> initial_gradient() const;

  /** du/dq at the initial position X, component by component. */
  std::array<dealii::Tensor<1, dim>, n_rigid_components<dim>>
  derivative(const dealii::Point<dim> &X) const;

  /** Forces f_i at initial positions X_i, as far as a rigid body sees them. */
  struct Load
  {
    dealii::Tensor<1, dim> force;  //!< sum f
    dealii::Tensor<2, dim> couple; //!< sum (X - X_c) f^T

    void add(const dealii::Tensor<1, dim> &arm, const dealii::Tensor<1, dim> &f)
    {
      force += f;
      couple += outer_product(arm, f);
    }
  };

  /** sum f . du/dq. */
  Unknowns generalised_force(const Load &load) const;

  /** sum f . d2u/dtheta2/L^2: the only second derivatives that are not zero. */
  dealii::Tensor<2, 3> curvature(const Load &load) const;

  /** sum R(X - X_c) x f: the moment about the current position of the reference point. */
  dealii::Tensor<1, 3> moment(const Load &load) const;

  /** J^T M/L: what a moment M of fixed direction does on the rotations, J dtheta the spin. */
  dealii::Tensor<1, 3> generalised_moment(const dealii::Tensor<1, 3> &moment) const;

  /** Its derivative d(J^T M/L)/d(L theta). */
  dealii::Tensor<2, 3> generalised_moment_derivative(const dealii::Tensor<1, 3> &moment) const;

private:
  Unknowns                            q;
  dealii::Point<dim>                  centre;
  double                              radius;
  dealii::Tensor<1, dim>              shift;
  dealii::Tensor<1, 3>                theta;
  std::array<double, 4>               c, dc; //!< c_k(s) and their first derivatives
  std::array<double, 3>               ddc;   //!< second derivatives
  dealii::Tensor<2, 3>                R;
  std::array<dealii::Tensor<2, 3>, 3> dR; //!< dR/dtheta_i
};

/** The axis of a rotation component: 2D z, 3D x, y, z. */
template <int dim>
constexpr unsigned int
rotation_axis(const unsigned int component)
{
  return dim == 2 ? 2 : component - dim;
}
} // namespace scree
