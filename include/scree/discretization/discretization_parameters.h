#pragma once

#include <scree/discretization/cut_cell_rules.h>
#include <scree/parameters/section.h>

namespace scree
{
/** Of a degree that was not set: it is that of the displacement. */
constexpr int as_displacement = -1;

/** Section Discretization: the basis, how finely geometry is seen, and what small cuts need. */
struct DiscretizationParameters
{
  unsigned int degree           = 1;               //!< of the displacement
  int          level_set_degree = as_displacement; //!< 1, 2 or as_displacement
  GaussPoints  gauss            = {0, 0};          //!< 0: degree + 1
  double       ghost_penalty    = 0.1;             //!< gamma

  void declare(ParameterSection &section);

  /** Of the level sets as finite element functions. */
  unsigned int degree_of_level_sets() const
  {
    return level_set_degree == as_displacement ? degree : level_set_degree;
  }

  /** Of both rules. */
  GaussPoints gauss_points() const
  {
    return {gauss.bulk > 0 ? gauss.bulk : degree + 1,
            gauss.surface > 0 ? gauss.surface : degree + 1};
  }
};
} // namespace scree
