#include <scree/parameters/nearest_name.h>

#include <algorithm>
#include <cctype>
#include <numeric>

namespace scree
{
namespace
{
std::string
lower_case(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(),
                 [](const unsigned char c) { return std::tolower(c); });
  return text;
}

/** The least number of insertions, deletions and replacements of characters from a to b. */
std::size_t
levenshtein_distance(const std::string &a, const std::string &b)
{
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i)
    {
      std::size_t diagonal = row[0];
      row[0]               = i;
      for (std::size_t j = 1; j <= b.size(); ++j)
        {
          const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
          diagonal                   = row[j];
          row[j]                     = std::min({replaced, row[j] + 1, row[j - 1] + 1});
        }
    }
  return row.back();
}
} // namespace

std::string
nearest_name(const std::string &name, const std::vector<std::string> &candidates)
{
  const std::string lower = lower_case(name);
  std::string       nearest;
  std::size_t       smallest = std::max<std::size_t>(2, name.size() / 3) + 1;
  // A name of two letters is close to every other one.
  smallest = std::min(smallest, std::max<std::size_t>(name.size(), 1));
  for (const auto &candidate : candidates)
    {
      const auto [shorter, longer] = std::minmax({candidate.size(), name.size()});
      if (longer - shorter >= smallest)
        continue;
      const std::size_t distance = levenshtein_distance(lower, lower_case(candidate));
      if (distance < smallest)
        {
          smallest = distance;
          nearest  = candidate;
        }
    }
  return nearest;
}

std::string
did_you_mean(const std::string &name, const std::vector<std::string> &candidates)
{
  const std::string nearest = nearest_name(name, candidates);
  return nearest.empty() ? "" : "; did you mean '" + nearest + "'?";
}
} // namespace scree
