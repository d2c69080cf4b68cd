// One run owns its output directory.
#include <gtest/gtest.h>

#include <scree/application/directory_lock.h>
#include <scree/base/exceptions.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

namespace scree
{
namespace
{
namespace fs = std::filesystem;

class Lock : public testing::Test
{
protected:
  void SetUp() override
  {
    char name[] = "/tmp/scree_lock_XXXXXX";
    ASSERT_NE(mkdtemp(name), nullptr);
    directory = name;
    file      = directory + "/lock";
  }
  void TearDown() override
  {
    fs::remove_all(directory);
  }
  std::string refusal() const
  {
    try
      {
        const DirectoryLock second(directory, "--output " + directory);
      }
    catch (const UserError &error)
      {
        return error.what();
      }
    return "";
  }

  std::string directory, file;
};

TEST_F(Lock, ASecondRunIsRefusedAndToldWhoOwnsTheDirectory)
{
  {
    const DirectoryLock first(directory, "");
    EXPECT_EQ(first.previous(), "");
    const std::string message = refusal();
    EXPECT_NE(message.find("another run owns the directory: process " + std::to_string(getpid())),
              std::string::npos)
      << message;
    EXPECT_NE(message.find(", begun 2"), std::string::npos) << message;
    EXPECT_TRUE(fs::exists(file));
  }
  EXPECT_FALSE(fs::exists(file));
  EXPECT_EQ(refusal(), "");
}

TEST_F(Lock, MovesButIsNotCopied)
{
  DirectoryLock first(directory, "");
  DirectoryLock second = std::move(first);
  EXPECT_NE(refusal(), "");
  second = DirectoryLock();
  EXPECT_EQ(refusal(), "");
}

TEST_F(Lock, WhatAKilledRunLeftIsNoObstacleAndIsTold)
{
  const pid_t child = fork();
  if (child == 0)
    {
      DirectoryLock lock(directory, "");
      _exit(0); // without removing it
    }
  waitpid(child, nullptr, 0);
  ASSERT_TRUE(fs::exists(file));
  const DirectoryLock lock(directory, "");
  EXPECT_EQ(lock.previous().find("process " + std::to_string(child)), 0u) << lock.previous();
}

TEST_F(Lock, AnotherProcessIsRefused)
{
  const DirectoryLock lock(directory, "");
  const pid_t         child = fork();
  if (child == 0)
    _exit(refusal().empty() ? 1 : 0);
  int status = 1;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
}

TEST_F(Lock, AFileThatSomebodyElseMadeIsLeftAlone)
{
  {
    const DirectoryLock lock(directory, "");
    fs::remove(file);
    std::ofstream(file) << "mine\n";
  }
  EXPECT_TRUE(fs::exists(file));
}
} // namespace
} // namespace scree
