// What is no input, or far too much of one, is told at once: encodings, pipes, bounds, many
// problems.
#include <gtest/gtest.h>

#include <scree/base/exceptions.h>
#include <scree/parameters/file.h>
#include <scree/parameters/nearest_name.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <sys/stat.h>
#include <unistd.h>

#include "../messages.h"

using namespace scree;

namespace
{
const std::string plain = "subsection Grid\n  set Level = 3\nend\n";

/** The level that is read from a text, and what is said about it otherwise. */
unsigned int
level(ParameterFile file)
{
  unsigned int result = 0;
  file.root().subsection("Grid", "").entry("Level", result, "");
  file.check();
  return result;
}

std::string
complaint_of_text(const std::string &text)
{
  return complaint([&]() { ParameterFile::from_string(text); });
}

std::string
in_utf16(const std::string &text, const bool big_endian)
{
  std::string result;
  for (const char c : text)
    {
      result += big_endian ? '\0' : c;
      result += big_endian ? c : '\0';
    }
  return result;
}

double
seconds_since(const std::chrono::steady_clock::time_point &start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

class RobustFiles : public testing::Test
{
protected:
  RobustFiles()
      : path(std::filesystem::temp_directory_path() / ("scree_robust_" + std::to_string(getpid())))
  {
    std::filesystem::create_directories(path);
  }
  ~RobustFiles() override
  {
    std::filesystem::remove_all(path);
  }
  std::string write(const std::string &name, const std::string &text) const
  {
    std::ofstream(path / name, std::ios::binary) << text;
    return (path / name).string();
  }
  std::string reading(const std::string &file) const
  {
    return complaint([&]() { ParameterFile::read(file); });
  }

  std::filesystem::path path;
};
} // namespace

TEST(Robustness, EveryKindOfLineEndAndTheMarkOfUtf8AreRead)
{
  std::string crlf, cr;
  for (const char c : plain)
    {
      crlf += c == '\n' ? "\r\n" : std::string(1, c);
      cr += c == '\n' ? '\r' : c;
    }
  for (const std::string &text : {plain, crlf, cr, "\xef\xbb\xbf" + plain, "\xef\xbb\xbf" + crlf})
    EXPECT_EQ(level(ParameterFile::from_string(text)), 3u) << text;
  // Lines are counted in all of them.
  expect_contains(complaint_of_text("\r\n\r\nsett x = 1\r\n"), "input:3:");
  expect_contains(complaint_of_text("\r\rsett x = 1\r"), "input:3:");
}

TEST(Robustness, OtherEncodingsAreTold)
{
  for (const bool big_endian : {false, true})
    {
      const std::string mark = big_endian ? "\xfe\xff" : "\xff\xfe";
      expect_contains(complaint_of_text(mark + in_utf16(plain, big_endian)), "UTF-16");
      expect_contains(complaint_of_text(in_utf16(plain, big_endian)), "UTF-16");
    }
  expect_contains(complaint_of_text(std::string("\xff\xfe\0\0s\0\0\0", 8)), "UTF-32");
  // A text in UTF-8 may say what it likes in comments, titles and names.
  EXPECT_EQ(complaint_of_text("set Title = \xc3\xa4 # \xe2\x82\xac\n"), "");
}

TEST(Robustness, ControlCharactersAreToldWithTheirLine)
{
  const std::string message = complaint_of_text(plain + std::string("set Title = a\0b\n", 16));
  expect_contains(message, "input:4");
  expect_contains(message, "NUL");
  expect_contains(complaint_of_text("set Title = a\x1b[2J\n"), "0x1b");
  EXPECT_EQ(complaint_of_text("\tset Title\t=\ta\f\n"), "");
}

TEST(Robustness, DeepNestingIsRefused)
{
  std::string text;
  for (unsigned int i = 0; i < 200000; ++i)
    text += "subsection a\n";
  expect_contains(complaint_of_text(text), "nested more than 100 deep");
  std::string override_text;
  for (unsigned int i = 0; i < 1000; ++i)
    override_text += "a/";
  expect_contains(
    complaint([&]() { ParameterFile::from_string("").override_value(override_text + "b=1"); }),
    "nested more than 100 deep");
}

TEST(Robustness, ManyEntriesAndProblemsTakeTimeInProportion)
{
  const auto  start = std::chrono::steady_clock::now();
  std::string text;
  for (unsigned int i = 0; i < 100000; ++i)
    text += "set unknown " + std::to_string(i) + " = 1\n";
  const std::string message = complaint([&]() {
    ParameterFile file = ParameterFile::from_string(text);
    std::string   title;
    file.root().entry("Title", title, "");
    file.check();
  });
  expect_contains(message, "100000 problems, the first 50 of them");
  EXPECT_LT(message.size(), 20000u);
  EXPECT_LT(seconds_since(start), 10.);
}

TEST(Robustness, ManyNamesTakeTimeInProportion)
{
  const auto  start = std::chrono::steady_clock::now();
  std::string names, sections;
  for (unsigned int i = 0; i < 20000; ++i)
    {
      names += (i == 0 ? "" : ", ") + ("b" + std::to_string(i));
      sections += "subsection b" + std::to_string(i) + "\n set Level = 1\nend\n";
    }
  ParameterFile file = ParameterFile::from_string("set Names = " + names + "\n" + sections);
  unsigned int  sum  = 0;
  for (auto &[name, section] : file.root().named("Names", ""))
    {
      unsigned int value = 0;
      section.entry("Level", value, "");
      sum += value;
    }
  file.check();
  EXPECT_EQ(sum, 20000u);
  EXPECT_LT(seconds_since(start), 10.);
}

TEST(Robustness, LongValuesAreToldInShort)
{
  ParameterFile file  = ParameterFile::from_string("set Steps = " + std::string(1000000, '9'));
  unsigned int  steps = 1;
  file.root().entry("Steps", steps, "");
  const std::string message = complaint([&]() { file.check(); });
  expect_contains(message, "999 ...");
  EXPECT_LT(message.size(), 1000u);
  EXPECT_EQ(nearest_name(std::string(1000000, 'a'), {"Steps"}), "");
}

TEST(Robustness, WarningsAreKeptWithTheirPlaceAndAreNoProblem)
{
  ParameterFile    file    = ParameterFile::from_string(plain, "x.prm");
  unsigned int     value   = 0;
  ParameterSection section = file.root().subsection("Grid", "");
  section.entry("Level", value, "");
  section.warning("Level", "is low", "raise it");
  section.warning("Level", "is low", "raise it");
  file.check();
  ASSERT_EQ(file.warnings().size(), 1u);
  EXPECT_EQ(file.warnings()[0], "x.prm:2: Grid: \"Level\" = 3: is low; raise it");
}

TEST_F(RobustFiles, PipesDevicesAndDirectoriesAreNeverOpened)
{
  const std::string pipe = (path / "pipe").string();
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  for (const std::string &file : {pipe, std::string("/dev/zero"), std::string("/dev/null")})
    {
      expect_contains(reading(file), "no regular file");
      expect_contains(reading(write("includes.prm", plain + "include " + file + "\n")),
                      "no regular file");
    }
  expect_contains(reading(path.string()), "is a directory");
}

TEST_F(RobustFiles, ChainsAndTreesOfIncludesAreBounded)
{
  for (unsigned int i = 0; i < 200; ++i)
    write(std::to_string(i) + ".prm", "include " + std::to_string(i + 1) + ".prm\n");
  write("200.prm", plain);
  expect_contains(reading((path / "0.prm").string()), "more than 100 files include one another");
  EXPECT_EQ(level(ParameterFile::read((path / "110.prm").string())), 3u);

  for (unsigned int i = 0; i < 24; ++i)
    {
      const std::string next = "include tree" + std::to_string(i + 1) + ".prm\n";
      write("tree" + std::to_string(i) + ".prm", next + next);
    }
  write("tree24.prm", "set Title = leaf\n");
  const auto start = std::chrono::steady_clock::now();
  expect_contains(reading((path / "tree0.prm").string()), "more than 1000 files are included");
  EXPECT_LT(seconds_since(start), 5.);
}

TEST_F(RobustFiles, HugeFilesAreNotRead)
{
  const std::string file = write("huge.prm", plain);
  std::filesystem::resize_file(file, 100000000); // a hole, no disk is used
  expect_contains(reading(file), "too large");
}
