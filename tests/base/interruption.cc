// Signals are noted, the second one ends the program.
#include <gtest/gtest.h>

#include <scree/base/interruption.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

namespace scree
{
TEST(Interruption, TheFirstSignalIsNoted)
{
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE})
    {
      const Interruption interruption(false);
      EXPECT_EQ(Interruption::signal(), 0);
      raise(signal);
      EXPECT_EQ(Interruption::signal(), signal);
    }
  EXPECT_EQ(signal_name(SIGTERM), "SIGTERM");
  EXPECT_EQ(signal_name(1000), "1000");
}

TEST(Interruption, APipeThatStaysClosedIsNoSecondSignal)
{
  const Interruption interruption(false);
  raise(SIGPIPE);
  raise(SIGPIPE);
  EXPECT_EQ(Interruption::signal(), SIGPIPE);
}

TEST(Interruption, WhatIsIgnoredStaysIgnored)
{
  std::signal(SIGHUP, SIG_IGN);
  {
    const Interruption interruption(false);
    raise(SIGHUP);
    EXPECT_EQ(Interruption::signal(), 0);
  }
  EXPECT_EQ(std::signal(SIGHUP, SIG_DFL), SIG_IGN);
}

TEST(InterruptionDeathTest, TheSecondSignalEndsTheProgram)
{
  EXPECT_EXIT(
    {
      const Interruption interruption(true);
      raise(SIGINT);
      raise(SIGINT);
    },
    testing::KilledBySignal(SIGINT), "ends after this iteration");
}

TEST(InterruptionDeathTest, AFileIsRemovedBeforeTheEnd)
{
  const std::string name = testing::TempDir() + "scree_removed_by_signals";
  for (const bool is_noted : {false, true})
    {
      std::ofstream(name) << "x";
      EXPECT_EXIT(
        {
          const RemovalBySignals removal(name);
          if (!is_noted)
            raise(SIGPIPE);
          const Interruption interruption(false);
          raise(SIGINT);
          if (!std::ifstream(name).good())
            std::exit(1); // it stays while a run is asked to end
          raise(SIGINT);
        },
        testing::KilledBySignal(is_noted ? SIGINT : SIGPIPE), "");
      EXPECT_FALSE(std::ifstream(name).good());
    }
  std::ofstream(name) << "x";
  {
    const RemovalBySignals removal(name);
  }
  EXPECT_TRUE(std::ifstream(name).good());
  std::remove(name.c_str());
}
} // namespace scree
