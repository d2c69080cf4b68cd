#pragma once

#include <scree/bodies/body.h>

namespace scree
{
/**
 * The bodies of a family as a table (CSV) that Family = list reads: a row each, columns for what
 * any of them has. Numbers have all their digits.
 *
 * @throws UserError if there is no such family, or if section Shape cannot tell its shapes
 */
template <int dim>
std::string list_of_family(const std::vector<BodyParameters<dim>> &bodies,
                           const std::string                      &family);
} // namespace scree
