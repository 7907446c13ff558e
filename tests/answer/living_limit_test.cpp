#include "answer/living_limit.hpp"

#include "support/test.hpp"

namespace condyle::test {
namespace {

using enum JointAngle;
constexpr RotationSense plus = RotationSense::positive, minus = RotationSense::negative;

/// A hip of two boxes: only what it is called matters here.
Joint small_hip() {
  const TriMesh bone = box({0, 0, 0}, {1, 1, 1});
  Joint joint{"hip", JointKind::ball, Side::right, {"pelvis", Mesh(bone)}, {"femur", Mesh(bone)}};
  joint.zero_from = ZeroFrom::stated;
  return joint;
}

/// A motion from this flexion that impinges after so many degrees.
motion::MotionLimit impinging(JointAngle vary, RotationSense sense, double from_flexion_deg,
                              double turned_deg) {
  motion::MotionLimit limit;
  limit.motion = {vary == flexion && sense == plus ? "flexion"
                  : vary == flexion                ? "extension"
                                                   : "any",
                  vary,
                  sense,
                  {Angle::degrees(from_flexion_deg), {}, {}},
                  Angle::degrees(180)};
  limit.end.turned = Angle::degrees(turned_deg);
  limit.end.reason = motion::LimitReason::contact;
  limit.end.contact = motion::ContactWitness{{}, {}, {1, 2, 3}, {1, 2, 3}, motion::ContactKind::impingement};
  return limit;
}

struct Published {
  JointAngle vary;
  RotationSense sense;
  double from_flexion_deg;
  Closeness closeness;
  double mean_deg, sd_deg;
};
// From the abstract, anew: close, moderate and weak differences of bone and cadaver.
constexpr Published published[] = {
    {flexion, plus, 0, Closeness::close, 3.1, 3.9},
    {internal_rotation, plus, 90, Closeness::close, 4.3, 4.6},
    {internal_rotation, plus, 71, Closeness::close, 4.3, 4.6},
    {internal_rotation, plus, 70, Closeness::weak, 37.1, 9.4},
    {internal_rotation, plus, 0, Closeness::weak, 37.1, 9.4},
    {internal_rotation, plus, -10, Closeness::weak, 79.6, 4.8},
    {internal_rotation, minus, 0, Closeness::moderate, 10.3, 5.8},
    {internal_rotation, minus, 30, Closeness::moderate, 10.3, 5.8},
    {internal_rotation, minus, 31, Closeness::weak, 45.9, 11.3},
    {internal_rotation, minus, 90, Closeness::weak, 45.9, 11.3},
    {internal_rotation, minus, -10, Closeness::moderate, 11.7, 7.2},
    {internal_rotation, minus, -21, Closeness::weak, 15.8, 4.8},
    {adduction, minus, 0, Closeness::weak, 18.6, 11.3},
    {flexion, minus, 0, Closeness::weak, 51.9, 14.4},
};

TEST(LivingLimit, HasThePublishedGapOfEachMotionAndAnExpectedEndOfTheCloseOnesOnly) {
  const Joint joint = small_hip();
  for (const auto& [vary, sense, from, closeness, mean_deg, sd_deg] : published) {
    const auto living = living_limit(joint, impinging(vary, sense, from, 100), nullptr);
    ASSERT_TRUE(living && living->gap) << static_cast<int>(vary) << " from " << from;
    EXPECT_EQ(living->gap->closeness, closeness) << static_cast<int>(vary) << " from " << from;
    EXPECT_NEAR(living->gap->mean.degrees(), mean_deg, 1e-12);
    EXPECT_NEAR(living->gap->sd.degrees(), sd_deg, 1e-12);
    EXPECT_EQ(living->gap->hips, 9);
    EXPECT_EQ(living->expected.has_value(), closeness == Closeness::close)
        << static_cast<int>(vary) << " from " << from;
    if (!living->expected) continue;
    EXPECT_NEAR(living->expected->degrees(), 100 - mean_deg, 1e-12);
    EXPECT_NEAR(living->expected_sd->degrees(), sd_deg, 1e-12);
  }
}

TEST(LivingLimit, AddsTheBandsOwnDeviationAsAnIndependentOne) {
  motion::LimitBand band;
  for (const double deg : {98.0, 100.0, 102.0, 104.0}) band.turned.push_back(Angle::degrees(deg));
  const auto living = living_limit(small_hip(), impinging(flexion, plus, 0, 100), &band);
  // Squares of -3, -1, 1, 3 over 3.
  EXPECT_NEAR(living->expected_sd->degrees(), std::sqrt(3.9 * 3.9 + 20.0 / 3), 1e-12);
}

TEST(LivingLimit, ExpectsNoEndWhereStudiesDoNotReach) {
  Joint joint = small_hip();
  const auto expects = [&](const motion::MotionLimit& limit) {
    const auto living = living_limit(joint, limit, nullptr);
    return living && living->expected.has_value();
  };
  const motion::MotionLimit usual = impinging(internal_rotation, plus, 90, 30);
  EXPECT_TRUE(expects(usual));
  EXPECT_FALSE(expects(impinging(internal_rotation, plus, 90, 4.2))) << "it would be below 0";
  motion::MotionLimit other = usual;
  other.end.reason = motion::LimitReason::end_of_range, other.end.contact.reset();
  EXPECT_FALSE(expects(other)) << "bone did not end it";
  other = usual;
  other.end.contact->kind = motion::ContactKind::cut;
  EXPECT_FALSE(expects(other)) << "an image ends there, not the bone";
  other = usual;
  other.motion.start.adduction = Angle::degrees(10);
  EXPECT_FALSE(living_limit(joint, other, nullptr)) << "FADIR is another motion";
  joint.planned = "without 40.9 mm3 of femur";
  EXPECT_FALSE(expects(usual)) << "after such cuts people moved no farther than before";
  joint.planned.clear();
  joint.person.age_years = 12;
  EXPECT_FALSE(expects(usual)) << "the cadavers were of adults";
  joint.person.age_years = 18;
  EXPECT_TRUE(expects(usual));
}

TEST(LivingLimit, ExpectsNoEndWhereADepthWasAllowed) {
  const std::vector limits{impinging(flexion, plus, 0, 120)};
  RangeAnswer answer{.joint = small_hip(), .limits = limits};
  EXPECT_TRUE(living_limit(answer, 0)->expected);
  answer.depths.resize(1);
  EXPECT_FALSE(living_limit(answer, 0)->expected);
  EXPECT_TRUE(living_limit(answer, 0)->people);
}

TEST(LivingLimit, IsOfNativeHipsWhoseZeroIsNeutralOnly) {
  const motion::MotionLimit usual = impinging(flexion, plus, 0, 120);
  for (const auto& change :
       {+[](Joint& joint) { joint.zero_from = ZeroFrom::as_given; },
        +[](Joint& joint) { joint.implant.emplace(); }, +[](Joint& joint) { joint.person.species = "cat"; },
        +[](Joint& joint) { joint.anatomy = Anatomy::shoulder; },
        +[](Joint& joint) { joint.kind = JointKind::hinge; }}) {
    Joint joint = small_hip();
    ASSERT_TRUE(living_limit(joint, usual, nullptr));
    change(joint);
    EXPECT_FALSE(living_limit(joint, usual, nullptr));
  }
}

TEST(LivingLimit, HasPeopleOfTheAgeAndSexAtHand) {
  Joint joint = small_hip();
  const auto people = [&](JointAngle vary, RotationSense sense, double from, std::optional<double> age,
                          std::optional<Sex> sex) {
    joint.person = {age, sex};
    const auto living = living_limit(joint, impinging(vary, sense, from, 100), nullptr);
    return living && living->people
               ? std::optional(std::pair(living->people->low.degrees(), living->people->high.degrees()))
               : std::nullopt;
  };
  const auto is = [](const auto& range, double low, double high) {
    return range && std::abs(range->first - low) < 1e-12 && std::abs(range->second - high) < 1e-12;
  };
  EXPECT_TRUE(is(people(flexion, plus, 0, 5, Sex::female), 140.8, 140.8));
  EXPECT_TRUE(is(people(flexion, plus, 0, 8.9, Sex::male), 131.1, 131.1));
  EXPECT_TRUE(is(people(flexion, minus, 0, 2, {}), 26.2, 28.3)) << "either sex";
  EXPECT_FALSE(people(flexion, plus, 0, 9, Sex::female))
      << "that group could not be read, and clinical ranges are of adults";
  EXPECT_TRUE(is(people(flexion, plus, 0, 70, Sex::female), 120, 120));
  EXPECT_TRUE(is(people(internal_rotation, plus, 0, 30, {}), 29.6, 35.2));
  EXPECT_TRUE(is(people(internal_rotation, plus, 0, {}, Sex::male), 29, 50.2));
  EXPECT_TRUE(is(people(internal_rotation, minus, 90, {}, {}), 40.6, 40.6));
  EXPECT_FALSE(people(internal_rotation, minus, 90, 70, {})) << "the study ends at 60 years";
}

TEST(LivingLimit, SaysInTextWhoseNumberItIs) {
  Joint joint = small_hip();
  EXPECT_EQ(text_of(living_limit(joint, impinging(flexion, plus, 0, 133.7), nullptr)), "some 131 (SD 4)");
  EXPECT_EQ(text_of(living_limit(joint, impinging(flexion, minus, 0, 70), nullptr)), "clinical 30");
  EXPECT_EQ(text_of(living_limit(joint, impinging(internal_rotation, plus, 0, 70), nullptr)),
            "groups' means 29–50");
  EXPECT_EQ(text_of(living_limit(joint, impinging(internal_rotation, minus, 90, 70), nullptr)), "mean 41");
  EXPECT_EQ(text_of(std::nullopt), "-");
}

}  // namespace
}  // namespace condyle::test
