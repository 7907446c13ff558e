#include "core/rounded.hpp"
#include "support/test.hpp"

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

TEST(AtMost, IsNeverBelowTheBoundAndLessThanADigitAbove) {
  EXPECT_EQ(at_most(0.0045, 1), "0.005");
  EXPECT_EQ(at_most(0.0042, 1), "0.005");
  EXPECT_EQ(at_most(0.004, 1), "0.004");
  EXPECT_EQ(at_most(9.4, 1), "1e+01");
  EXPECT_EQ(at_most(1.01e-9, 1), "2e-09");
  EXPECT_EQ(at_most(8.61e-11, 2), "8.7e-11");
  EXPECT_EQ(at_most(0, 1), "0");
  for (double bound = 1e-12; bound < 1e3; bound *= 1.0037)
    for (const int digits : {1, 2}) {
      const double said = std::strtod(at_most(bound, digits).c_str(), nullptr);
      EXPECT_GE(said, bound);
      EXPECT_LT(said, bound * (1 + std::pow(10, 1 - digits))) << bound;
    }
}

}  // namespace
}  // namespace condyle::core
