// The file of a checkpoint: what is written comes back, or is refused with its reason, or the one
// before is taken.
#include <gtest/gtest.h>

#include <scree/base/exceptions.h>
#include <scree/state/checkpoint_file.h>

#include <boost/crc.hpp>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <sys/stat.h>

namespace scree
{
namespace
{
namespace fs = std::filesystem;

class CheckpointFile : public testing::Test
{
protected:
  void SetUp() override
  {
    char name[] = "/tmp/scree_checkpoint_XXXXXX";
    ASSERT_NE(mkdtemp(name), nullptr);
    directory = name;
  }
  void TearDown() override
  {
    fs::remove_all(directory);
  }

  std::size_t write(const std::string &contents, const unsigned int dimension = 2,
                    const std::string &folder = "") const
  {
    return write_checkpoint_file(directory + folder, dimension,
                                 [&](std::ostream &stream) { stream << contents; });
  }
  std::string bytes(const std::string &name = "checkpoint") const
  {
    std::ifstream      file(directory + "/" + name, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }
  void put(const std::string &text, const std::string &name = "checkpoint") const
  {
    std::ofstream(directory + "/" + name, std::ios::binary) << text;
  }
  /** The message of the error that reading ends with. */
  std::string error(const unsigned int dimension = 2) const
  {
    try
      {
        read_checkpoint_file(directory, dimension);
      }
    catch (const UserError &e)
      {
        return e.what();
      }
    return "";
  }
  void expect_error(const std::string &part) const
  {
    EXPECT_NE(error().find(part), std::string::npos) << error();
  }

  std::string directory;
};

TEST_F(CheckpointFile, WhatIsWrittenComesBackAndTheOneBeforeIsKept)
{
  const std::string first("one\0two", 7), second(5000000, 'x');
  const std::size_t n_bytes = write(first);
  EXPECT_EQ(bytes().size(), n_bytes);
  EXPECT_EQ(read_checkpoint_file(directory, 2).contents, first);
  write(second);
  const auto newest = read_checkpoint_file(directory, 2);
  EXPECT_EQ(newest.contents, second);
  EXPECT_EQ(newest.warning, "");
  // As after a kill between the two renamings.
  fs::remove(directory + "/checkpoint");
  const auto older = read_checkpoint_file(directory, 2);
  EXPECT_EQ(older.contents, first);
  EXPECT_NE(older.warning.find("missing"), std::string::npos);
}

TEST_F(CheckpointFile, EveryDamagedByteIsFound)
{
  write("contents");
  const std::string good = bytes();
  for (std::size_t i = 0; i < good.size(); ++i)
    {
      std::string bad = good;
      bad[i] ^= 4;
      put(bad);
      EXPECT_NE(error(), "") << "byte " << i;
    }
  for (std::size_t n = 0; n < good.size(); ++n)
    {
      put(good.substr(0, n));
      EXPECT_NE(error(), "") << n << " bytes";
    }
  put(good);
  EXPECT_EQ(read_checkpoint_file(directory, 2).contents, "contents");
}

TEST_F(CheckpointFile, ADamagedOneIsPutAsideForTheOneBefore)
{
  write("first");
  write("second");
  std::string bad = bytes();
  bad[bad.size() / 2] ^= 1;
  put(bad);
  const auto read = read_checkpoint_file(directory, 2);
  EXPECT_EQ(read.contents, "first");
  EXPECT_NE(read.warning.find("checksum"), std::string::npos) << read.warning;
  EXPECT_EQ(bytes(), bad); // a run may be refused for other reasons
  set_damaged_aside(directory);
  EXPECT_EQ(bytes("checkpoint.damaged"), bad);
  EXPECT_FALSE(fs::exists(directory + "/checkpoint"));
  // The next one does not push the good one out.
  write("third");
  EXPECT_EQ(read_checkpoint_file(directory, 2).contents, "third");
  fs::remove(directory + "/checkpoint");
  EXPECT_EQ(read_checkpoint_file(directory, 2).contents, "first");
}

TEST_F(CheckpointFile, ErrorsSayWhatIsWrong)
{
  expect_error("there is no checkpoint");
  put("something else that is long enough to have a header");
  expect_error("is not a checkpoint of scree");
  write("contents", 3);
  fs::remove(directory + "/checkpoint.old");
  expect_error("3 dimensions");
  write("contents");
  std::string other_format = bytes();
  other_format[16]         = 99;
  other_format.resize(other_format.size() - 4);
  boost::crc_32_type crc;
  crc.process_bytes(other_format.data(), other_format.size());
  const std::uint32_t checksum = crc.checksum();
  other_format.append(reinterpret_cast<const char *>(&checksum), sizeof checksum);
  put(other_format);
  expect_error("is of format 99");
}

TEST_F(CheckpointFile, AFolderInItsPlaceCannotBeRead)
{
  fs::create_directory(directory + "/checkpoint");
  expect_error("cannot be read");
}

TEST_F(CheckpointFile, APipeInItsPlaceIsNotWaitedFor)
{
  write("first");
  write("second");
  fs::remove(directory + "/checkpoint");
  ASSERT_EQ(mkfifo((directory + "/checkpoint").c_str(), 0600), 0);
  const auto read = read_checkpoint_file(directory, 2);
  EXPECT_EQ(read.contents, "first");
  EXPECT_NE(read.warning.find("no regular file"), std::string::npos) << read.warning;
  ASSERT_EQ(mkfifo((directory + "/checkpoint.new").c_str(), 0600), 0);
  EXPECT_THROW(write("third"), UserError);
}

TEST_F(CheckpointFile, WhatIsLargerThanItSaysIsNotRead)
{
  write("contents");
  std::error_code error;
  fs::resize_file(directory + "/checkpoint", std::uintmax_t(1) << 40, error); // mostly a hole
  if (error)
    GTEST_SKIP() << "no such large files here";
  expect_error("its header says 8 for the contents");
}

TEST_F(CheckpointFile, AFullDiskLeavesTheOthersAlone)
{
  if (!fs::exists("/dev/full"))
    GTEST_SKIP() << "no /dev/full";
  write("first");
  write("second");
  const std::string newest = bytes(), older = bytes("checkpoint.old");
  fs::create_symlink("/dev/full", directory + "/checkpoint.new");
  try
    {
      write("third");
      ADD_FAILURE() << "no error";
    }
  catch (const UserError &e)
    {
      EXPECT_NE(std::string(e.what()).find("No space left"), std::string::npos) << e.what();
    }
  EXPECT_EQ(bytes(), newest);
  EXPECT_EQ(bytes("checkpoint.old"), older);
  EXPECT_FALSE(fs::exists(directory + "/checkpoint.new"));
  EXPECT_THROW(write("third", 2, "/nowhere"), UserError);
  // There is room again.
  write("third");
  EXPECT_EQ(read_checkpoint_file(directory, 2).contents, "third");
}
TEST_F(CheckpointFile, WhateverByteIsDamagedTheOneBeforeIsUsed)
{
  EXPECT_FALSE(has_checkpoint(directory));
  write("first");
  EXPECT_TRUE(has_checkpoint(directory));
  write("second");
  const std::string good = bytes(), older = bytes("checkpoint.old");
  for (std::size_t i = 0; i < good.size(); ++i)
    {
      std::string bad = good;
      bad[i] ^= 4;
      put(bad);
      put(older, "checkpoint.old");
      const auto read = read_checkpoint_file(directory, 2);
      EXPECT_EQ(read.contents, "first") << "byte " << i;
      EXPECT_EQ(read.warning.find("format"), std::string::npos) << read.warning;
    }
}

} // namespace
} // namespace scree
