#include <scree/bodies/condition_kind.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace scree
{
template <int dim>
bool
ConditionKind<dim>::uses(const std::string &entry) const
{
  return std::find(entries.begin(), entries.end(), entry) != entries.end();
}

template <int dim>
const ConditionKind<dim> &
condition_kind(const std::string &name)
{
  for (const auto &kind : registered_conditions<dim>())
    if (kind.name == name)
      return kind;
  AssertThrow(false, dealii::ExcMessage("There is no boundary condition '" + name + "'."));
}

template struct ConditionKind<2>;
template struct ConditionKind<3>;
template const ConditionKind<2> &condition_kind(const std::string &);
template const ConditionKind<3> &condition_kind(const std::string &);
} // namespace scree
