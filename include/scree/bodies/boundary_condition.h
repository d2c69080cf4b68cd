#pragma once

#include <scree/base/enum_names.h>
#include <scree/base/expression.h>
#include <scree/parameters/section.h>

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace scree
{
/** What a boundary condition prescribes. */
enum class ConditionType
{
  /** displacement components, u_i = value_i(x, t) */
  displacement,
  /** traction vector t(x, t), force per area of the undeformed surface */
  traction,
  /** pressure p(x, t) along the inward normal, t = -p n */
  pressure,
  /** springs to the ground, t_i = -k_i u_i */
  springs,
  /** displacement components of the grid vertex at a point of a body clipped by the box */
  point_support,
  /** mean of displacement components or of the rotation over a region, by multipliers */
  mean_support
};

/** How a displacement is imposed. */
enum class DisplacementMethod
{
  /** strong on box faces, Nitsche on the cut surface */
  automatic,
  /** symmetric Nitsche, theory.md section 7 */
  nitsche,
  /** Nitsche with the adjoint term of opposite sign */
  nonsymmetric_nitsche,
  /** penalty beta only */
  penalty
};

extern const EnumNames<ConditionType>      condition_type_names;
extern const EnumNames<DisplacementMethod> displacement_method_names;

/** Parameters of one named boundary condition of a body. */
template <int dim>
struct BoundaryConditionParameters
{
  ConditionType            type  = ConditionType::displacement;
  std::string              on    = "surface";   //!< "x-" ... "z+" or "surface"
  std::string              where = "1";         //!< expression that selects
  std::vector<std::string> components;          //!< of x, y, z (and rotation for mean supports)
  std::string              value          = ""; //!< one expression per component
  DisplacementMethod       method         = DisplacementMethod::automatic;
  double                   penalty_factor = 20.; //!< beta = factor k^2 (2 mu + lambda)/h
  dealii::Point<dim>       point;                //!< of a point support

  void declare(ParameterSection &section);
};

/**
 * One boundary condition, ready to be evaluated: the region (a face of the background box or the
 * cut surface, restricted by an expression), the components it concerns and its value.
 */
template <int dim>
class BoundaryCondition
{
public:
  /** Index of the rotation among the components of a mean support. */
  static constexpr unsigned int rotation = dim;
  /** Value of box_face() for conditions on the cut surface. */
  static constexpr unsigned int no_face = 2 * dim;

  BoundaryCondition(const std::string &name, const std::string &path,
                    const BoundaryConditionParameters<dim> &parameters);

  std::string                      name;
  std::string                      path; //!< section path, for messages
  BoundaryConditionParameters<dim> parameters;
  /** Component numbers 0..dim-1 (dim: rotation) in the order of the values. */
  std::vector<unsigned int> components;
  /** 0..2 dim-1: the face x-, x+, y-, ... of the box; no_face: the cut surface. */
  unsigned int box_face = no_face;

  /** Whether the condition acts at the point. */
  bool selects(const dealii::Point<dim> &point) const
  {
    return region.selects(point);
  }

  /** Prescribed vector at a point and time; components not concerned are zero. */
  dealii::Tensor<1, dim> vector(const dealii::Point<dim> &point, const double time) const;

  /**
   * Value of entry `index` of `components`; of a pressure the only one.
   * @throws UserError if the formula gives no finite number there
   */
  double value(const unsigned int index, const dealii::Point<dim> &point, const double time) const;

  /** Whether the displacement is imposed on the unknowns of a box face. */
  bool is_strong() const
  {
    return parameters.type == ConditionType::displacement && box_face != no_face
           && parameters.method == DisplacementMethod::automatic;
  }

private:
  Expression<dim> region;
  Expression<dim> values;
};
} // namespace scree
