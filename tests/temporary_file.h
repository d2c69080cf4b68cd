#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <string>

namespace scree
{
/** A file of this test, which ends with it. */
class TemporaryFile
{
public:
  TemporaryFile(const std::string &name, const std::string &content)
      : name(::testing::TempDir() + name)
  {
    std::ofstream(this->name, std::ios::binary) << content;
  }
  TemporaryFile(const TemporaryFile &) = delete;
  ~TemporaryFile()
  {
    std::remove(name.c_str());
  }

  const std::string name;
};
} // namespace scree
