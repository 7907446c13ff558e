#include "core/pair.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "support/test.hpp"

namespace condyle::core {
namespace {

/// 1,000 bits: sums and products of doubles up to 2^100 apart are exact.
using Wide = boost::multiprecision::number<
    boost::multiprecision::cpp_bin_float<1000, boost::multiprecision::digit_base_2>>;

class Doubles {
 public:
  double operator()() {
    const double digits = std::uniform_real_distribution(-1.0, 1.0)(random_);
    return std::ldexp(digits, std::uniform_int_distribution(-30, 30)(random_));
  }

 private:
  std::mt19937_64 random_{11};
};

Wide wide(Pair pair) {
  return Wide(pair.high) + Wide(pair.low);
}

TEST(Pair, ProductAndSumOfTwoDoublesAreExact) {
  Doubles next;
  for (int i = 0; i < 100000; ++i) {
    const double a = next(), b = next();
    ASSERT_EQ(wide(exact_product(a, b)), Wide(a) * Wide(b)) << a << " " << b;
    ASSERT_EQ(wide(exact_sum(a, b)), Wide(a) + Wide(b)) << a << " " << b;
  }
}

TEST(Pair, ASumOfProductsIsTheNearestDoubleUnlessItLiesBetweenTwo) {
  Doubles next;
  int other = 0;
  for (int i = 0; i < 100000; ++i) {
    Pair sum{next(), 0};
    Wide exact(sum.high), largest(abs(exact));
    for (int k = 0; k < 3; ++k) {
      const double a = next(), b = next();
      sum = sum + exact_product(a, b);
      exact += Wide(a) * Wide(b);
      largest = std::max<Wide>(largest, abs(Wide(a) * Wide(b)));
    }
    // Each of three sums in pairs errs by at most 2^-104 of its terms.
    ASSERT_LE(abs(wide(sum) - exact), ldexp(largest, -100));
    other += sum.high != exact.convert_to<double>();
  }
  EXPECT_EQ(other, 0);
}

}  // namespace
}  // namespace condyle::core
