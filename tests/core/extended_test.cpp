#include "core/extended.hpp"

#include "core/composed.hpp"
#include "support/test.hpp"

namespace condyle::core {
namespace {

#if LDBL_MANT_DIG == 64 && defined(__SIZEOF_FLOAT128__)
__extension__ typedef __float128 Quad;
using Emulated = RoundedTo64<Quad>;

TEST(Extended, HasTheBitsOfThisMachineWhereLongDoubleIsLonger) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> within(-1000, 1000);
  std::size_t differing = 0;
  for (int i = 0; i < 200000; ++i) {
    const double a = within(random), b = within(random), c = within(random), d = within(random),
                 e = within(random);
    const auto row = [&]<class Number>(Number) {
      return static_cast<double>(Number(a) * Number(b) + Number(c) * Number(d) + Number(e));
    };
    const double here = row(static_cast<long double>(0)), emulated = row(Emulated(0));
    ASSERT_EQ(here, emulated) << i;
    differing += here != static_cast<double>(Quad(a) * Quad(b) + Quad(c) * Quad(d) + Quad(e));
  }
  // Without the second rounding some coordinates would differ.
  EXPECT_GT(differing, 10u);
}

TEST(Extended, RoundsHalvesToEvenAndCarries) {
  // 1 + 2^-64 is the middle between 1 and the next number of 64 bits; 1 + 3 2^-64 that of the next two.
  const double half = 0x1p-64, most = 0x1.fffffffffffffp0;
  const auto sum = [](auto a, auto b, auto c) { return a + b + c; };
  for (const double steps : {1.0, 3.0, 5.0, 7.0})
    EXPECT_EQ(static_cast<double>(sum(Emulated(1), Emulated(steps * half), Emulated(-1))),
              static_cast<double>(sum(1.0L, static_cast<long double>(steps * half), -1.0L)))
        << steps;
  EXPECT_EQ(static_cast<double>(sum(Emulated(most), Emulated(0x1.fffffffffp-53), Emulated(0x1p-63))),
            static_cast<double>(sum(static_cast<long double>(most), 0x1.fffffffffp-53L, 0x1p-63L)));
}
#endif

TEST(Composed, MovesPointsAsBothPosesDoAndHasTheOrderOfVectorisedSums) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> within(-50, 50);
  for (int i = 0; i < 1000; ++i) {
    Pose poses[2] = {Pose::Identity(), Pose::Identity()};
    for (Pose& pose : poses) {
      pose.linear() = Eigen::Quaterniond(within(random), within(random), within(random), within(random))
                          .normalized()
                          .toRotationMatrix();
      pose.translation() = Vec3(within(random), within(random), within(random));
    }
    const Pose &first = poses[0], &second = poses[1];
    const Pose both = composed(first, second);
    const Vec3 p(within(random), within(random), within(random));
    // A dozen roundings of numbers below 256.
    EXPECT_LE((posed(both, p) - posed(first, posed(second, p))).norm(), 12 * 256 * 0x1p-53);
    const auto term = [&](int row, int k) { return first(row, k) * second(k, 0); };
    EXPECT_EQ(both(0, 0), (term(0, 0) + term(0, 1)) + term(0, 2));
    EXPECT_EQ(both(2, 0), term(2, 0) + (term(2, 1) + term(2, 2)));
  }
}

}  // namespace
}  // namespace condyle::core
