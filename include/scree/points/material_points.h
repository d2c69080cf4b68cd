#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/symmetric_tensor.h>

#include <boost/serialization/vector.hpp>
#include <cstdint>
#include <mpi.h>
#include <vector>

namespace scree
{
/**
 * Sums over the material points of a body; what a step without loss leaves unchanged. Mass and
 * initial volume are exact but for the rounding of one sum, and of one per process.
 */
template <int dim>
struct PointTotals
{
  std::uint64_t          count          = 0;
  double                 mass           = 0.; //!< [M], per thickness in 2D
  double                 initial_volume = 0.; //!< sum of V_0 [L^dim]
  double                 volume         = 0.; //!< sum of det F V_0 [L^dim]
  dealii::Tensor<1, dim> momentum;            //!< sum of m v [M L/T]
};

/**
 * The material points of all bodies on this process: the history of the material and where it is
 * (theory.md section 9). One array per quantity, point i at entry i of each. A copy is what a
 * rollback needs, serialize() what a checkpoint needs.
 */
template <int dim>
class MaterialPoints
{
public:
  /** No points; each will carry `n_internal` internal variables. */
  explicit MaterialPoints(const unsigned int n_internal = 0);

  std::vector<dealii::Point<dim>>              position;             //!< x [L]
  std::vector<dealii::Point<dim>>              reference_position;   //!< X [L]
  std::vector<double>                          initial_volume;       //!< V_0 [L^dim]
  std::vector<double>                          initial_spacing;      //!< to its neighbours [L]
  std::vector<double>                          mass;                 //!< [M]
  std::vector<dealii::Tensor<2, dim>>          deformation_gradient; //!< F = dx/dX
  std::vector<dealii::SymmetricTensor<2, dim>> stress;               //!< Cauchy [F/L^2]
  std::vector<double>                          out_of_plane_stress;  //!< sigma_zz, 2D [F/L^2]
  std::vector<dealii::Tensor<1, dim>>          velocity;             //!< [L/T]
  std::vector<dealii::Tensor<1, dim>>          acceleration;         //!< [L/T^2]
  std::vector<dealii::Tensor<1, dim>>          forcing;              //!< force per mass [L/T^2]
  std::vector<double>                          internal; //!< n_internal() per point, in a row
  std::vector<unsigned int>                    body;     //!< number of the body

  std::size_t  size() const;
  unsigned int n_internal() const;

  /** V = det F V_0 of a point [L^dim]. */
  double volume(const std::size_t point) const;

  /** Distance to the neighbours now: the initial one times the largest principal stretch [L]. */
  double spacing(const std::size_t point) const;

  /**
   * Adds an undeformed point of zero stress, velocity, acceleration and internal variables: X = x,
   * F = I. `volume`, `spacing` and `mass` are those of the point.
   */
  void add(const dealii::Point<dim> &x, const unsigned int body_number, const double volume,
           const double spacing, const double mass);

  /** Adds a copy of point `i` of `other`, which has the same number of internal variables. */
  void add_copy(const MaterialPoints &other, const std::size_t i);

  /** Removes the points whose entry is false; the others keep their order. */
  void keep(const std::vector<bool> &kept);

  /**
   * Moves all points by an increment: F <- (I + grad du) F, x <- x + du, at the points.
   * Returns how many have det F <= 0 afterwards: a step to be rejected.
   */
  std::size_t move(const std::vector<dealii::Tensor<1, dim>> &increment,
                   const std::vector<dealii::Tensor<2, dim>> &gradient);

  /** Sums per body 0 ... n_bodies - 1 on this process. */
  std::vector<PointTotals<dim>> totals(const unsigned int n_bodies) const;

  /** The same over all processes; collective. */
  std::vector<PointTotals<dim>> totals(const unsigned int n_bodies, const MPI_Comm comm) const;

  /** Appends all quantities of a point to a message, as n_values() numbers. */
  void pack(const std::size_t point, std::vector<double> &message) const;
  /** Adds the point that pack() wrote at `values`. */
  void         unpack(const double *values);
  unsigned int n_values() const;

  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &n_internal_variables;
    for_each_array(*this, [&](auto &array, const unsigned int) { archive &array; });
  }

  /** Calls f(array, entries per point) for every array of `points`. */
  template <typename Points, typename F>
  static void for_each_array(Points &points, const F &f)
  {
    f(points.position, 1u);
    f(points.reference_position, 1u);
    f(points.initial_volume, 1u);
    f(points.initial_spacing, 1u);
    f(points.mass, 1u);
    f(points.deformation_gradient, 1u);
    f(points.stress, 1u);
    f(points.out_of_plane_stress, 1u);
    f(points.velocity, 1u);
    f(points.acceleration, 1u);
    f(points.forcing, 1u);
    f(points.internal, points.n_internal_variables);
    f(points.body, 1u);
  }

private:
  unsigned int n_internal_variables;
};
} // namespace scree
