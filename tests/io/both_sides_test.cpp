#include "io/result/both_sides.hpp"

#include "io/rom_scene.hpp"
#include "support/test.hpp"

namespace condyle::test {
namespace {

/// A motion of flexion that contact ends at this angle.
motion::MotionLimit ends_at(const char* name, RotationSense sense, double deg) {
  motion::MotionLimit limit;
  limit.motion = {name, JointAngle::flexion, sense};
  limit.end.reason = motion::LimitReason::contact;
  limit.end.turned = Angle::degrees(deg);
  limit.end.contact = {{}, {}, Vec3(1, 0, 0), Vec3(1, 0, 0)};
  return limit;
}

RangeAnswer ends_at(Side side, double flexion_deg, double extension_deg) {
  Joint joint = arm_and_post();
  joint.side = side;
  return {.joint = joint,
          .limits = {ends_at("flexion", RotationSense::positive, flexion_deg),
                     ends_at("extension", RotationSense::negative, extension_deg)}};
}

void add_bands(RangeAnswer& answer) {
  for (const motion::MotionLimit& limit : answer.limits) {
    motion::LimitBand band;
    band.p5 = Angle::degrees(20);
    band.median = limit.end.turned;
    band.p95 = Angle::degrees(40);
    answer.bands.push_back(band);
  }
}

TEST(BothSides, AreLeftThenRightAndTheDifferenceIsLeftLessRight) {
  RangeAnswer left = ends_at(Side::left, 40, 40), right = ends_at(Side::right, 50.5, 20);
  EXPECT_EQ(io::both_sides_csv(shown(left), shown(right)),
            "motion,left_deg,left_p5_deg,left_p95_deg,right_deg,right_p5_deg,right_p95_deg,difference_deg\n"
            "flexion,40,,,50.5,,,-10.5\n"
            "extension,40,,,20,,,20\n");
  const std::string text = io::both_sides_text(shown(left), shown(right));
  expect_says(text, "  flexion         40.00        50.50         -10.5\n");
  expect_says(text, "total arcs (deg), left and right: flexion to extension 80.0 and 70.5 (+9.5)");
  add_bands(left);
  expect_says(io::both_sides_csv(shown(left), shown(right)), "extension,40,20,40,20,,,20\n");
}

TEST(BothSides, HaveNoDifferenceWhereNoContactOfBonesEndsAMotion) {
  RangeAnswer left = ends_at(Side::left, 40, 20), right = ends_at(Side::right, 50, 15);
  add_bands(left);
  left.limits[0].end.reason = motion::LimitReason::end_of_range;
  right.limits[1].end.contact->kind = motion::ContactKind::cut;
  EXPECT_EQ(io::both_sides_csv(shown(left), shown(right)),
            "motion,left_deg,left_p5_deg,left_p95_deg,right_deg,right_p5_deg,right_p95_deg,difference_deg\n"
            "flexion,,,,50,,,\n"
            "extension,20,20,40,,,,\n");
  const std::string text = io::both_sides_text(shown(left), shown(right));
  expect_says(text, "cut of image");
  expect_silent(text, "total arcs");
}

}  // namespace
}  // namespace condyle::test
