#include "core/rounded.hpp"

#include <gtest/gtest.h>

namespace condyle::core {
namespace {

TEST(Rounded, HasNoMinusBeforeZeroAndKeepsItBeforeAnythingElse) {
  EXPECT_EQ(rounded(-0.0, 2), "0.00");
  EXPECT_EQ(rounded(-0.00499, 2), "0.00");
  EXPECT_EQ(rounded(-0.00501, 2), "-0.01");
  EXPECT_EQ(rounded(-0.4, 0), "0");
  EXPECT_EQ(rounded(-100.0, 1), "-100.0");
  EXPECT_EQ(rounded(Vec3(-0.001, 1.005, -2.5), 2), "(0.00, 1.00, -2.50)");
}

}  // namespace
}  // namespace condyle::core
