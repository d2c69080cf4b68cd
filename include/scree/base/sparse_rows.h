#pragma once

#include <cstddef>
#include <vector>

namespace scree
{
/** Sparse rows on this process; columns are unknowns of any process. */
struct SparseRows
{
  std::vector<std::size_t> begin = {0}; //!< row i has the entries begin[i] ... begin[i + 1] - 1
  std::vector<int>         columns;
  std::vector<double>      values;

  std::size_t n_rows() const
  {
    return begin.size() - 1;
  }
};
} // namespace scree
