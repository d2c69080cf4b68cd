#pragma once

#include <scree/discretization/displacement_space.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <array>
#include <vector>

namespace scree
{
/** How a rigid body moves: of its reference point, and about it. */
template <int dim>
struct RigidRates
{
  dealii::Tensor<1, dim> velocity;             //!< [L/time]
  dealii::Tensor<1, 3>   spin;                 //!< [rad/time]; 2D: only the last component
  dealii::Tensor<1, dim> acceleration;         //!< [L/time^2]
  dealii::Tensor<1, 3>   angular_acceleration; //!< [rad/time^2]
};

/** w x r; in 2D of w about z. */
template <int dim>
dealii::Tensor<1, dim> turned(const dealii::Tensor<1, 3> &w, const dealii::Tensor<1, dim> &r);

/** The spin w with sum m r x (w x r) = L of masses with the second moments sum m r r^T. */
template <int dim>
dealii::Tensor<1, 3> spin_of(const dealii::Tensor<2, dim> &second, const dealii::Tensor<1, 3> &L);

/** Linear and angular momentum. */
template <int dim>
struct Momentum
{
  dealii::Tensor<1, dim> linear;  //!< [M L/time]
  dealii::Tensor<1, 3>   angular; //!< about the origin [M L^2/time]; 2D: only the last component
};

/**
 * The rigid bodies that have mass, each as 2 dim equal point masses on the principal axes of its
 * second moments S = int rho (X - c)(X - c)^T, at c +- sqrt(dim s_k/m) e_k: any motion has the
 * momentum, kinetic energy and inertial forces of the body. What integrates the motion of points in
 * time does so for rigid bodies, too.
 */
template <int dim>
class RigidMasses
{
public:
  static constexpr unsigned int n_points = 2 * dim;
  using Vectors                          = std::array<dealii::Tensor<1, dim>, n_points>;
  using Vector                           = dealii::TrilinosWrappers::MPI::Vector;

  struct OfBody
  {
    unsigned int                             body;
    const RigidBody<dim>                    *rigid;
    double                                   mass; //!< of the body [M]
    std::array<dealii::Point<dim>, n_points> initial_positions;

    /** x [L]. */
    Vectors positions(const RigidPose<dim> &pose) const;
    /** v and a of the points of a body that moves rigidly. */
    Vectors velocities(const RigidPose<dim> &pose, const RigidRates<dim> &rates) const;
    Vectors accelerations(const RigidPose<dim> &pose, const RigidRates<dim> &rates) const;
    /** The rigid rates with the momenta of the points, and their derivatives. */
    RigidRates<dim> rates(const RigidPose<dim> &pose, const Vectors &velocities,
                          const Vectors &accelerations) const;

    /** With the accelerations that generalised forces cause on free components. */
    RigidRates<dim> accelerated(const RigidPose<dim> &pose, const RigidRates<dim> &rates,
                                const typename RigidPose<dim>::Unknowns &forces) const;

    Momentum<dim> momentum(const RigidPose<dim> &pose, const RigidRates<dim> &rates) const;
    double        kinetic_energy(const RigidPose<dim> &pose, const RigidRates<dim> &rates) const;
    /** The generalised forces of forces per mass at the points. */
    typename RigidPose<dim>::Load load(const Vectors &forces) const;
  };

  RigidMasses(const DisplacementSpace<dim> &space, const std::vector<Body<dim>> &bodies);

  const std::vector<OfBody> &bodies() const
  {
    return of_bodies;
  }

  /** Adds generalised forces of a body to the owned rows. */
  void add(const OfBody &body, const typename RigidPose<dim>::Unknowns &forces, Vector &r) const;

  /**
   * Adds the derivative of sum m (factor x + ...) . dx/dq to the owned rows.
   *
   * @param accelerations of the points at the pose
   */
  void add_tangent(const OfBody &body, const RigidPose<dim> &pose, const double factor,
                   const Vectors &accelerations, dealii::TrilinosWrappers::SparseMatrix &K) const;

  /** The rates of a body of the rows of ghosted vectors, spins times the radius; and back. */
  RigidRates<dim> read(const OfBody &body, const Vector &velocity,
                       const Vector &acceleration) const;
  void            write(const OfBody &body, const RigidRates<dim> &rates, Vector &velocity,
                        Vector &acceleration) const;

private:
  const DisplacementSpace<dim> &space;
  std::vector<OfBody>           of_bodies;
};
} // namespace scree
