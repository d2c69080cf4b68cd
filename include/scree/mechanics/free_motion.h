#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <string>

namespace scree
{
/** How a body is held before contact: rigid motions that nothing but contact resists. */
struct FreeMotion
{
  unsigned int body;
  unsigned int n_free; //!< number of free rigid motions
};

/** A motion of a free body as a whole. */
template <int dim>
struct LooseMotion
{
  unsigned int           body;
  double                 size;      //!< largest displacement over the body's box, of 1 for all [-]
  bool                   turns;     //!< a rotation, else a translation
  dealii::Point<dim>     centre;    //!< of the rotation [L]
  dealii::Tensor<1, dim> direction; //!< of the translation; in 3D the axis of the rotation
  double                 sense;     //!< of the rotation in 2D: 1 counter-clockwise, -1 clockwise

  /** "moves along (1, 0)", "turns about (0.5, 0)". */
  std::string in_words() const;
};
} // namespace scree
