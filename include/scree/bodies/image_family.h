#pragma once

#include <scree/bodies/body_family.h>

namespace scree
{
/** The labels of an image, each a body: LabelImage, shape_of_label(). */
template <int dim>
FamilyKind<dim> image_family();
} // namespace scree
