#pragma once

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "equilibrium_model.h"

namespace scree
{
/**
 * A displacement that is no polynomial, with the body force b = -div sigma(u) for E = 1000, nu =
 * 0.3 (the material of bodies_text()), as formulas of the coordinates. 2D, plane strain: u =
 * (sin(1.3 x + 0.4) cos(0.9 y - 0.2), cos(0.8 x + 0.3) sin(1.1 y + 0.5)); 3D: u = (sin(1.3 x + 0.4)
 * cos(0.9 y - 0.2), sin(1.1 y + 0.5) cos(0.8 z + 0.3), sin(0.7 z - 0.6) cos(1.2 x + 0.1)).
 */
template <int dim>
struct Manufactured
{
  static std::string displacement()
  {
    return dim == 2 ? "sin(1.3*x+0.4)*cos(0.9*y-0.2); cos(0.8*x+0.3)*sin(1.1*y+0.5)"
                    : "sin(1.3*x+0.4)*cos(0.9*y-0.2); sin(1.1*y+0.5)*cos(0.8*z+0.3); "
                      "sin(0.7*z-0.6)*cos(1.2*x+0.1)";
  }

  /** -mu laplace(u) - (lambda + mu) grad div u. */
  static std::string body_force()
  {
    const double       young = 1000., poisson = 0.3;
    const double       lambda = young * poisson / (1. + poisson) / (1. - 2. * poisson);
    const double       mu     = 0.5 * young / (1. + poisson);
    std::ostringstream text;
    text.precision(17);
    if (dim == 2)
      text << (lambda + 2. * mu) * 1.69 + mu * 0.81 << "*sin(1.3*x+0.4)*cos(0.9*y-0.2) + "
           << (lambda + mu) * 0.88 << "*sin(0.8*x+0.3)*cos(1.1*y+0.5); "
           << (lambda + 2. * mu) * 1.21 + mu * 0.64 << "*cos(0.8*x+0.3)*sin(1.1*y+0.5) + "
           << (lambda + mu) * 1.17 << "*cos(1.3*x+0.4)*sin(0.9*y-0.2)";
    else
      text << (lambda + 2. * mu) * 1.69 + mu * 0.81 << "*sin(1.3*x+0.4)*cos(0.9*y-0.2) + "
           << (lambda + mu) * 0.84 << "*cos(0.7*z-0.6)*sin(1.2*x+0.1); "
           << (lambda + 2. * mu) * 1.21 + mu * 0.64 << "*sin(1.1*y+0.5)*cos(0.8*z+0.3) + "
           << (lambda + mu) * 1.17 << "*cos(1.3*x+0.4)*sin(0.9*y-0.2); "
           << (lambda + 2. * mu) * 0.49 + mu * 1.44 << "*sin(0.7*z-0.6)*cos(1.2*x+0.1) + "
           << (lambda + mu) * 0.88 << "*cos(1.1*y+0.5)*sin(0.8*z+0.3)";
    return text.str();
  }

  /** A body with that force, held by Nitsche on its surface and strongly on the named faces. */
  static std::string body(const std::string &shape, const std::vector<std::string> &faces)
  {
    std::vector<std::pair<std::string, std::string>> conditions
      = {{"surface", "set On = surface\nset Value = " + displacement()}};
    for (const auto &face : faces)
      conditions.emplace_back(face, "set On = " + face + "\nset Value = " + displacement());
    return "set Body force = " + body_force() + "\n" + shape + conditions_text(conditions);
  }

  /** |u - exact| / |exact| in L2 after one load step of the model. */
  static double solve(EquilibriumModel<dim> &model)
  {
    const auto result = model.step(1.);
    if (!result.converged())
      return std::numeric_limits<double>::quiet_NaN();
    const auto [error, norm] = model.l2_error(Expression<dim>(displacement(), dim, "exact"));
    return error / norm;
  }
};
} // namespace scree
