// Each warning is new once for each kind and body, also after it was saved.
#include <gtest/gtest.h>

#include <scree/base/warnings.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <sstream>

using namespace scree;

TEST(Warnings, AreNewOnce)
{
  Warnings warnings;
  EXPECT_TRUE(warnings.is_new(Warning::loose, 3));
  EXPECT_FALSE(warnings.is_new(Warning::loose, 3));
  EXPECT_TRUE(warnings.is_new(Warning::turned, 3));
  EXPECT_TRUE(warnings.is_new(Warning::under_resolved, 3, 4));
  EXPECT_TRUE(warnings.is_new(Warning::under_resolved, 3, 5));
  EXPECT_EQ(warnings.count(Warning::under_resolved), 2u);

  std::stringstream               bytes;
  boost::archive::binary_oarchive out(bytes);
  out << static_cast<const Warnings &>(warnings);
  Warnings                        resumed;
  boost::archive::binary_iarchive in(bytes);
  in >> resumed;
  EXPECT_FALSE(resumed.is_new(Warning::turned, 3));
  EXPECT_TRUE(resumed.is_new(Warning::turned, 4));
}
