#pragma once

#include <scree/discretization/point_evaluator.h>

#include <optional>

namespace scree
{
/**
 * The increment u that laws were asked about last. Their answers stand beside it, so that forces,
 * tangent and work of the same u ask once.
 */
template <int dim>
struct AnsweredIncrement
{
  std::optional<PointEvaluator<dim>> u;
  bool                               has_tangents = false;
  /** The first increment after a tangent most often is the next one to have a tangent. */
  bool expects_tangent = false;

  /** Takes another increment, or tangents too; false: the answers are there. */
  bool renew(const PointEvaluator<dim> &asked, const bool with_tangents)
  {
    if (u && *u == asked && (has_tangents || !with_tangents))
      return false;
    u            = asked;
    has_tangents = with_tangents;
    return true;
  }
};
} // namespace scree
