#pragma once

#include <scree/base/enum_names.h>
#include <scree/base/expression.h>
#include <scree/bodies/condition_kind.h>

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace scree
{
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

extern const EnumNames<DisplacementMethod> displacement_method_names;

/** Parameters of one named boundary condition of a body. */
template <int dim>
struct BoundaryConditionParameters
{
  std::string              type  = "displacement"; //!< a ConditionKind
  std::string              on    = "surface";      //!< "x-" ... "z+" or "surface"
  std::string              where = "1";            //!< expression that selects
  std::vector<std::string> components;             //!< of x, y, z (and rotation for mean supports)
  std::string              value          = "";    //!< one expression per component
  DisplacementMethod       method         = DisplacementMethod::automatic;
  double                   penalty_factor = 20.; //!< beta = factor k^2 (2 mu + lambda)/h
  dealii::Point<dim>       point;                //!< of a point support

  /** Returns the faces, or the surface, where it acts if there are several: one condition each. */
  std::vector<std::string> declare(ParameterSection &section);

  /** On the surface and not restricted by Where. */
  bool is_all_around() const
  {
    return on == "surface" && where == "1";
  }
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

  const ConditionKind<dim> &kind() const
  {
    return *of_kind;
  }

  /** Whether it prescribes displacement components on a part of the surface. */
  bool prescribes_displacement() const
  {
    return of_kind->imposition == Imposition::displacement;
  }

  /** Whether the displacement is imposed on the unknowns of a box face. */
  bool is_strong() const
  {
    return prescribes_displacement() && box_face != no_face
           && parameters.method == DisplacementMethod::automatic;
  }

  /** Whether the displacement of a vertex is prescribed, on its unknowns. */
  bool is_at_vertex() const
  {
    return of_kind->imposition == Imposition::vertex;
  }

  /** How many multipliers hold means over the region. */
  unsigned int n_multipliers() const
  {
    return of_kind->imposition == Imposition::mean ? components.size() : 0;
  }

  /** Whether the body needs forces to move against it; if not it is a load. */
  bool resists_motion() const
  {
    return of_kind->imposition != Imposition::traction || of_kind->law.resists_motion;
  }

private:
  const ConditionKind<dim> *of_kind;
  Expression<dim>           region;
  Expression<dim>           values;
};
} // namespace scree
