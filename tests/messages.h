#pragma once

#include <gtest/gtest.h>

#include <scree/base/exceptions.h>

#include <string>

namespace scree
{
/** The message of the UserError that `f` ends with, or "". */
template <typename F>
std::string
complaint(const F &f)
{
  try
    {
      f();
    }
  catch (const UserError &error)
    {
      return error.what();
    }
  return "";
}

inline void
expect_contains(const std::string &text, const std::string &part)
{
  EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in:\n" << text;
}
} // namespace scree
