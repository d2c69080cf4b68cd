#pragma once

#include <scree/parameters/section.h>

#include <deal.II/base/array_view.h>
#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <string>
#include <vector>

namespace scree
{
template <int dim>
class BoundaryCondition;
template <int dim>
struct BoundaryConditionParameters;

/** How a condition enters the equations. */
enum class Imposition
{
  /** a traction, given by the SurfaceLaw */
  traction,
  /** displacement components: on the unknowns of a box face, else by Nitsche or penalty */
  displacement,
  /** means of components or of the rotation over the region, by multipliers */
  mean,
  /** displacement components of one vertex of the grid, on its unknowns */
  vertex
};

/** A point of the surface where a traction acts. */
template <int dim>
struct SurfacePoint
{
  dealii::Point<dim>     reference_position; //!< X, where formulas are evaluated
  dealii::Tensor<1, dim> normal;             //!< out of the body, at the start of the step
  double                 area_ratio;         //!< of reference area to area at the start of the step
  dealii::Tensor<1, dim> displacement;       //!< since the beginning [L]
  dealii::Tensor<2, dim> increment;          //!< F_D of the step; I on a fixed geometry
};

/** Traction t on the body, force per area at the start of the step, and its derivatives. */
template <int dim>
struct SurfaceTraction
{
  dealii::Tensor<1, dim> traction;
  dealii::Tensor<2, dim> by_displacement; //!< dt/du [force/area/L]
  dealii::Tensor<3, dim> by_increment;    //!< dt_i/dF_D,kl
  double                 energy = 0.;     //!< stored per area
};

/**
 * The traction of a condition: t(X, time), a dead load, or what depends linearly on the
 * displacement u, as springs do, or on F_D, where the surface moves.
 */
template <int dim>
struct SurfaceLaw
{
  /** Tractions at points of a region. */
  void (*evaluate)(const BoundaryCondition<dim>                    &condition,
                   const dealii::ArrayView<const SurfacePoint<dim>> points, const double time,
                   const dealii::ArrayView<SurfaceTraction<dim>> tractions)
    = nullptr;

  /** Whether t depends on u: the tractions resist motions and store energy, no load does. */
  bool resists_motion = false;

  /** Whether t depends on F_D: on a moving geometry it is no dead load. */
  bool follows_surface = false;

  /**
   * Whether the condition acts on the exact boundary of a fixed geometry, as loads do; null or
   * false: on the cut one, as the bulk does.
   */
  bool (*acts_on_exact_boundary)(const BoundaryConditionParameters<dim> &parameters) = nullptr;
};

/**
 * A kind of boundary condition. A new one is a header, a source with a function that makes this
 * description, and a line in registered_conditions(). (A new Imposition is a BoundaryTerm, too.)
 */
template <int dim>
struct ConditionKind
{
  std::string name; //!< in entry Type
  Imposition  imposition;

  /** Which of the entries On, Where and Components it uses, and its own ones. */
  std::vector<std::string> entries;

  bool            needs_value      = false; //!< else a value that is not given is zero
  bool            takes_a_rotation = false; //!< among the components
  SurfaceLaw<dim> law              = {};    //!< of Imposition::traction

  /** Declares and reads its own entries, and checks them if `is_chosen`; null: it has none. */
  void (*declare)(BoundaryConditionParameters<dim> &parameters, const ParameterSection &section,
                  const bool is_chosen)
    = nullptr;

  bool uses(const std::string &entry) const;
};

/** All kinds, in the order of the documentation. */
template <int dim>
const std::vector<ConditionKind<dim>> &registered_conditions();

/** The kind of that name. */
template <int dim>
const ConditionKind<dim> &condition_kind(const std::string &name);
} // namespace scree
