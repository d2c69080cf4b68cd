#pragma once

#include <scree/base/expression.h>
#include <scree/parameters/section.h>

namespace scree
{
/**
 * Records a problem of entry `key` if `text` is not a formula with `n_components` components.
 * @param hint what else to tell then
 */
template <int dim>
void
check_expression(const ParameterSection &section, const std::string &key, const std::string &text,
                 const unsigned int n_components, const std::string &hint = "")
{
  try
    {
      Expression<dim>(text, n_components, key);
    }
  catch (const UserError &error)
    {
      section.error(key, error.what() + (hint.empty() ? "" : " (" + hint + ")"));
    }
}
} // namespace scree
