#include <gtest/gtest.h>

#include <scree/state/bounded_archive.h>

#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>
#include <cstring>
#include <map>
#include <sstream>
#include <vector>

using namespace scree;

namespace
{
template <typename T>
std::string
written(const T &value)
{
  std::ostringstream              stream;
  boost::archive::binary_oarchive archive(stream);
  archive << value;
  return stream.str();
}

template <typename T>
T
read(const std::string &bytes)
{
  std::istringstream stream(bytes);
  BoundedArchive     archive(stream, bytes.size());
  T                  result;
  archive >> result;
  return result;
}

/** `bytes` with the 8 bytes that are `length` made `forged`. */
std::string
with_length(std::string bytes, const std::uint64_t length, const std::uint64_t forged)
{
  const std::string old(reinterpret_cast<const char *>(&length), sizeof length);
  const auto        at = bytes.rfind(old);
  EXPECT_NE(at, std::string::npos);
  std::memcpy(&bytes[at], &forged, sizeof forged);
  return bytes;
}
} // namespace

TEST(BoundedArchive, ReadsWhatWasWritten)
{
  const std::vector<double>                             numbers(37, 1.5);
  const std::map<std::string, std::vector<std::string>> lists{{"a", {"b", ""}}, {"", {}}};
  EXPECT_EQ(read<std::vector<double>>(written(numbers)), numbers);
  EXPECT_EQ((read<std::map<std::string, std::vector<std::string>>>(written(lists))), lists);
  EXPECT_EQ(read<std::string>(written(std::string("text"))), "text");
}

TEST(BoundedArchive, RefusesForgedLengths)
{
  const std::uint64_t long_ones[] = {1u << 20, std::uint64_t(1) << 40, ~std::uint64_t(0)};
  for (const std::uint64_t forged : long_ones)
    {
      EXPECT_THROW(
        read<std::vector<double>>(with_length(written(std::vector<double>(37, 1.5)), 37, forged)),
        std::length_error);
      EXPECT_THROW(read<std::string>(with_length(written(std::string(41, 'x')), 41, forged)),
                   std::length_error);
      EXPECT_THROW(read<std::vector<std::string>>(
                     with_length(written(std::vector<std::string>(43, "x")), 43, forged)),
                   std::length_error);
    }
}
