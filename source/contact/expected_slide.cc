#include <scree/contact/expected_slide.h>
#include <scree/contact/surface_fit.h>

namespace scree
{
template <int dim>
ExpectedSlide<dim>
expected_slide(const ContactPoint<dim> &point, const ContactPair &pair,
               const ExactDistances<dim> &distances, const IncrementPrediction<dim> &prediction)
{
  // Beyond this turn in a step the differences are noise at the end of a body.
  constexpr double              smallest_cosine = 0.9;
  const dealii::Tensor<1, dim> &n               = point.normal;
  ExpectedSlide<dim>            result;
  result.slide = prediction(pair.b, point.position) - prediction(pair.a, point.position);
  result.slide -= (result.slide * n) * n;
  const double length = result.slide.norm();
  if (length > point.cell_size)
    result.slide *= point.cell_size / length;

  const dealii::Point<dim> x_a = point.position + 0.5 * result.slide;
  const dealii::Point<dim> x_b = point.position - 0.5 * result.slide;
  result.jump                  = prediction(pair.b, x_b) - prediction(pair.a, x_a);

  // The normal at the start where the bodies' points are that meet, and who turns it.
  const bool             a_turns = point.normal_of != NormalOf::body_b;
  const bool             b_turns = point.normal_of != NormalOf::body_a;
  dealii::Tensor<1, dim> start   = n;
  if (point.normal_of == NormalOf::body_a)
    start = distances.normal(pair.a, x_a);
  else if (point.normal_of == NormalOf::body_b)
    start = -distances.normal(pair.b, x_b);
  SurfaceTangents<dim> tangents = surface_tangents<dim>(start);
  for (auto &tangent : tangents)
    {
      const dealii::Tensor<1, dim> arm = 0.5 * point.cell_size * tangent;
      dealii::Tensor<1, dim>       stretch;
      for (const double sign : {-1., 1.})
        {
          if (a_turns)
            stretch += sign * prediction(pair.a, x_a + sign * arm);
          if (b_turns)
            stretch += sign * prediction(pair.b, x_b + sign * arm);
        }
      tangent += stretch / (point.cell_size * (a_turns && b_turns ? 2. : 1.));
    }
  result.normal = surface_normal<dim>(tangents);
  result.normal /= result.normal.norm();
  if (!(result.normal * n > smallest_cosine))
    result.normal = n;
  return result;
}

#define SCREE_INSTANTIATE(dim)                                                               \
  template ExpectedSlide<dim> expected_slide(const ContactPoint<dim> &, const ContactPair &, \
                                             const ExactDistances<dim> &,                    \
                                             const IncrementPrediction<dim> &);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
