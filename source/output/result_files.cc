#include <scree/output/result_files.h>

#include <algorithm>
#include <filesystem>
#include <regex>

namespace scree
{
std::string
result_file_in(const std::string &directory)
{
  static const std::regex whole("(history|contacts|grains|assembly|probes|study)\\.csv|"
                                "cycle-[0-9]+|checkpoint(\\.old)?"),
    of_step("(bodies|contact|points|chains|line_.*)_0*[1-9][0-9]*\\..*");
  std::string     found;
  std::error_code error;
  for (const auto &entry : std::filesystem::directory_iterator(directory, error))
    {
      const std::string name = entry.path().filename().string();
      // The one to be told does not depend on the order in the directory.
      if (std::regex_match(name, whole) || std::regex_match(name, of_step))
        found = found.empty() ? name : std::min(found, name);
    }
  return found;
}
} // namespace scree
