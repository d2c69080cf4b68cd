#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace scree
{
/** A directory of its own that goes away. */
struct Directory
{
  Directory()
  {
    char name[] = "/tmp/scree_output_XXXXXX";
    path        = mkdtemp(name);
  }
  ~Directory()
  {
    std::filesystem::remove_all(path);
  }
  std::string path;
};

inline std::string
content(const std::string &file_name)
{
  std::ifstream      file(file_name);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}
} // namespace scree
