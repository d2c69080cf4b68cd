#pragma once

#include <scree/contact/contact_memory.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

namespace scree
{
/** Contact points on a surface with the tangents along its parameters. */
template <int dim>
struct Surface
{
  std::vector<ContactPoint<dim>>                           points;
  std::vector<std::array<double, dim - 1>>                 place; //!< arc lengths
  std::vector<std::array<dealii::Tensor<1, dim>, dim - 1>> tangent;
};

inline const std::vector<ContactPair> one_pair = {{0, 1, "a-b", {}}};

/** Places in a cell [0, 1], that sum their weights to 1. */
using CellRule            = std::vector<std::pair<double, double>>;
const CellRule two_points = {{0.5 - std::sqrt(1. / 12.), 0.5}, {0.5 + std::sqrt(1. / 12.), 0.5}};
inline const CellRule three_points
  = {{0.5 - std::sqrt(0.15), 5. / 18.}, {0.5, 8. / 18.}, {0.5 + std::sqrt(0.15), 5. / 18.}};

/** Circle about the origin from arc length 0 to L; 3D: times a cylinder's axis, from 0 to L too. */
template <int dim>
Surface<dim>
cylinder(const double radius, const double L, const double h, const CellRule &rule,
         const double shift)
{
  std::vector<std::pair<double, double>> line; // arc length, weight
  for (int cell = -1; (cell + shift) * h < L; ++cell)
    {
      const double lower = std::max(0., (cell + shift) * h),
                   upper = std::min(L, (cell + shift + 1.) * h);
      for (const auto &[place, weight] : rule)
        if (upper - lower > 1e-6 * h)
          line.emplace_back(lower + (upper - lower) * place, (upper - lower) * weight);
    }
  Surface<dim> result;
  for (const auto &[s, weight_s] : line)
    for (const auto &[z, weight_z] : dim == 3 ? line : decltype(line){{0., 1.}})
      {
        const double                                angle = s / radius;
        ContactPoint<dim>                           point{0, {}, {}, weight_s * weight_z, 0., h};
        std::array<double, dim - 1>                 place;
        std::array<dealii::Tensor<1, dim>, dim - 1> tangent;
        point.normal[0] = std::cos(angle);
        point.normal[1] = std::sin(angle);
        point.position  = dealii::Point<dim>(radius * point.normal);
        place[0]        = s;
        tangent[0][0]   = -std::sin(angle);
        tangent[0][1]   = std::cos(angle);
        if (dim == 3)
          {
            point.position[dim - 1]   = z;
            place[dim - 2]            = z;
            tangent[dim - 2][dim - 1] = 1.;
          }
        result.points.push_back(point);
        result.place.push_back(place);
        result.tangent.push_back(tangent);
      }
  return result;
}

template <int dim>
using Traction = std::function<dealii::Tensor<1, dim - 1>(const std::array<double, dim - 1> &)>;

/** The tangential tractions of components tau(place), p = 2 + the first one. */
template <int dim>
std::vector<dealii::Tensor<1, dim>>
tractions(const Surface<dim> &surface, const Traction<dim> &tau)
{
  std::vector<dealii::Tensor<1, dim>> result(surface.points.size());
  for (unsigned int i = 0; i < surface.points.size(); ++i)
    for (unsigned int k = 0; k < dim - 1; ++k)
      result[i] += tau(surface.place[i])[k] * surface.tangent[i][k];
  return result;
}

template <int dim>
ContactMemory<dim>
memory_of(const Surface<dim> &surface, const Traction<dim> &tau)
{
  ContactMemory<dim> memory;
  memory.tau = tractions(surface, tau);
  for (unsigned int i = 0; i < surface.points.size(); ++i)
    {
      const ContactPoint<dim> &point = surface.points[i];
      memory.body_a.push_back(0);
      memory.body_b.push_back(1);
      memory.position.push_back(point.position);
      memory.normal.push_back(point.normal);
      memory.weight.push_back(point.weight);
      memory.cell_size.push_back(point.cell_size);
      memory.pressure.push_back(2. + tau(surface.place[i])[0]);
    }
  return memory;
}

/** Components sin(k s), in 3D sin(k (s + z)) and cos(k s), of a wave length. */
template <int dim>
Traction<dim>
wave(const double length)
{
  const double k = 2. * dealii::numbers::PI / length;
  return [k](const std::array<double, dim - 1> &place) {
    dealii::Tensor<1, dim - 1> tau;
    tau[0] = std::sin(k * (place[0] + (dim == 3 ? place[dim - 2] : 0.)));
    if (dim == 3)
      tau[dim - 2] = std::cos(k * place[0]);
    return tau;
  };
}
} // namespace scree
