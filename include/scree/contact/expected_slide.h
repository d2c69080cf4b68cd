#pragma once

#include <scree/contact/contact_surface.h>

#include <functional>

namespace scree
{
/** The increment that is expected of a body at a point in the coming step [L]. */
template <int dim>
using IncrementPrediction
  = std::function<dealii::Tensor<1, dim>(unsigned int, const dealii::Point<dim> &)>;

/** What is expected of a contact point in the coming step. */
template <int dim>
struct ExpectedSlide
{
  dealii::Tensor<1, dim> slide;  //!< tangential jump, at most a cell [L]
  dealii::Tensor<1, dim> jump;   //!< [[u]] of the material points that slide over each other [L]
  dealii::Tensor<1, dim> normal; //!< where they are at the end
};

/**
 * With the expected increments U_a, U_b of two bodies and P = I - n n^T: slide s = P (U_b -
 * U_a)(x); x_a = x + s/2 and x_b = x - s/2 meet in the middle of the step; jump U_b(x_b) -
 * U_a(x_a). The normal is that of the surface moved by (U_a(x_a) + U_b(x_b))/2, from central
 * differences over a cell along it. Where one body alone has the normal, it is that of this body at
 * x_a or x_b, moved by U_a or U_b: an edge or corner that slides over a face does not turn it.
 */
template <int dim>
ExpectedSlide<dim> expected_slide(const ContactPoint<dim> &point, const ContactPair &pair,
                                  const ExactDistances<dim>      &distances,
                                  const IncrementPrediction<dim> &prediction);
} // namespace scree
