#include "io/result/limit_difference.hpp"

#include "rom_scene.hpp"
#include "support/test.hpp"

/// Differences between the limits of two joints: in what they are known, and in how far they are uncertain.

namespace condyle::test {
namespace {

using io::DifferenceIs;
using io::limit_differences;
using io::LimitDifference;

motion::MotionLimit limit_at(double deg, motion::LimitReason reason) {
  motion::MotionLimit limit;
  limit.motion.name = "there";
  limit.end.turned = Angle::degrees(deg);
  limit.end.reason = reason;
  return limit;
}

LimitDifference difference_of(const motion::MotionLimit& before, const motion::MotionLimit& after) {
  const Joint joint = arm_and_post();
  return limit_differences({.joint = joint, .limits = {before}}, {.joint = joint, .limits = {after}}).front();
}

TEST(LimitDifference, IsAfterMinusBeforeIfBothMotionsEndByContact) {
  const LimitDifference less = difference_of(limit_at(100, motion::LimitReason::contact),
                                             limit_at(87.5, motion::LimitReason::contact));
  EXPECT_EQ(less.motion, "there");
  EXPECT_NEAR(*less.by_deg, -12.5, 1e-13);
  EXPECT_EQ(less.is, DifferenceIs::exact);
  EXPECT_FALSE(less.band);
}

TEST(LimitDifference, IsABoundIfTheRangeOfOneMotionEndsFirst) {
  const motion::MotionLimit met = limit_at(80, motion::LimitReason::contact),
                            free = limit_at(90, motion::LimitReason::end_of_range);
  EXPECT_EQ(difference_of(met, free).is, DifferenceIs::at_least);
  EXPECT_NEAR(*difference_of(met, free).by_deg, 10, 1e-13);
  EXPECT_EQ(difference_of(free, met).is, DifferenceIs::at_most);
  EXPECT_NEAR(*difference_of(free, met).by_deg, -10, 1e-13);
}

TEST(LimitDifference, IsUnknownIfNeitherMotionEndsByContactOrOneStartsInIt) {
  const motion::MotionLimit met = limit_at(80, motion::LimitReason::contact),
                            free = limit_at(90, motion::LimitReason::end_of_range),
                            starts = limit_at(0, motion::LimitReason::contact_at_start);
  EXPECT_FALSE(difference_of(free, free).by_deg);
  EXPECT_FALSE(difference_of(starts, met).by_deg);
  EXPECT_FALSE(difference_of(met, starts).by_deg);
}

/// Limits of displaced joints from 60 to 79 degrees, each turned by so much more.
motion::LimitBand band_of(double more_deg, double slope = 0) {
  motion::LimitBand band{};
  for (int i = 0; i < 20; ++i) band.turned.push_back(Angle::degrees(60 + i + more_deg + slope * i));
  return band;
}

LimitDifference with_bands(const motion::LimitBand& before, const motion::LimitBand& after,
                           std::uint64_t seed_after = 1) {
  RangeAnswer one{.joint = arm_and_post(), .limits = {limit_at(70, motion::LimitReason::contact)}}, two = one;
  one.bands = {before}, one.band_options = {.samples = 20};
  two.bands = {after}, two.band_options = {.samples = 20, .seed = seed_after};
  return limit_differences(one, two).front();
}

TEST(LimitDifference, HasABandOfJointsThatAreDisplacedAlike) {
  // 19 degrees wide both, two apart: every pair of joints differs by two.
  const LimitDifference more = with_bands(band_of(0), band_of(2));
  EXPECT_NEAR(more.band->p5_deg, 2, 1e-12);
  EXPECT_NEAR(more.band->median_deg, 2, 1e-12);
  EXPECT_NEAR(more.band->p95_deg, 2, 1e-12);
  EXPECT_TRUE(more.band->leaves_out_zero());
  EXPECT_TRUE(with_bands(band_of(2), band_of(0)).band->leaves_out_zero());
  // From -1 to 0.9, evenly: 5 and 95 % are 0.095 from the ends.
  const LimitDifference spread = with_bands(band_of(0), band_of(-1, 0.1));
  EXPECT_NEAR(spread.band->p5_deg, -0.905, 1e-12);
  EXPECT_NEAR(spread.band->p95_deg, 0.805, 1e-12);
  EXPECT_FALSE(spread.band->leaves_out_zero());
  EXPECT_FALSE(with_bands(band_of(0), band_of(0)).band->leaves_out_zero()) << "zero is no difference";
  EXPECT_FALSE(with_bands(band_of(0), band_of(0.04)).band->leaves_out_zero()) << "shown as 0.0 degrees";
  EXPECT_TRUE(with_bands(band_of(0), band_of(-0.06)).band->leaves_out_zero());
}

TEST(LimitDifference, HasNoBandOfJointsThatAreDisplacedByOtherAmounts) {
  EXPECT_FALSE(with_bands(band_of(0), band_of(2), 2).band);
}

TEST(LimitDifference, OfAMotionOfTheSameJointIsZeroInEveryDisplacedOne) {
  const Joint joint = arm_and_post();
  const std::vector<motion::Motion> motions = motion::built_in_motions(joint.kind, joint.anatomy);
  const std::vector<motion::MotionLimit> limits = motion::RangeOfMotion(joint).limits(motions);
  const motion::BandOptions options{.samples = 20};
  const std::vector<motion::LimitBand> bands = motion::limit_bands(joint, motions, {}, options);
  const RangeAnswer rom{.joint = joint, .limits = limits, .bands = bands, .band_options = options};
  for (const LimitDifference& each : limit_differences(rom, rom)) {
    if (!each.by_deg) continue;
    EXPECT_EQ(*each.by_deg, 0);
    EXPECT_EQ(each.band->p5_deg, 0);
    EXPECT_EQ(each.band->p95_deg, 0);
  }
}

TEST(LimitDifference, WritesWhatIsNotKnownAsNull) {
  const io::Json json = io::differences_json(
      {{.motion = "a", .by_deg = 2.5, .is = DifferenceIs::at_least, .band = io::DifferenceBand{1, 2, 3}},
       {.motion = "b"}});
  EXPECT_EQ(json.dump(),
            R"([{"motion":"a","difference_deg":2.5,"difference_is":"at_least",)"
            R"("band":{"p5_deg":1.0,"median_deg":2.0,"p95_deg":3.0},"beyond_band":true},)"
            R"({"motion":"b","difference_deg":null,"difference_is":null,"band":null,"beyond_band":null}])");
}

}  // namespace
}  // namespace condyle::test
