#pragma once

#include <algorithm>
#include <vector>

namespace scree
{
/** Sorts values and leaves one of those that are equal. */
template <typename T>
void
sort_and_unite(std::vector<T> &values)
{
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}
} // namespace scree
