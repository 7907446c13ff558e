#include "condyle/contact_measures.hpp"
#include "condyle/joint_coordinates.hpp"
#include "condyle/sample/cartilages.hpp"
#include "condyle/sample/hip.hpp"
#include "support/test.hpp"

/// Overlaps of the sample's bones and cartilages, against values that exact integration gave in another program, to the digits it
/// gave; those of cartilages along two directions.

namespace condyle::sample {
namespace {

contact::ContactMeasures measured(const contact::JointContact& joint, const Pose& X_FM) {
  return contact::measure_contact(joint, X_FM, contact::MeasuredContact(joint.radial(X_FM)),
                                  contact::DistancesOf::vertices_inside);
}

contact::JointContact cartilages(CartilageScenario scenario, double clearance_mm) {
  const SampleCartilages made = sample_cartilages({}, {.clearance_mm = clearance_mm}, scenario);
  return {made.acetabular, made.femoral};
}

TEST(SampleOverlap, OfCartilagesThatTouchIsWhatExactIntegrationGives) {
  const contact::JointContact joint = cartilages(CartilageScenario::five, 0);
  const std::vector<std::pair<double, double>> cases{{0, 19.378492},    {0.01, 25.282265}, {0.1, 117.040948},
                                                     {0.2, 239.707828}, {0.4, 503.953159}, {1, 1347.921829}};
  for (const auto& [up_mm, volume_mm3] : cases) {
    Pose X_FM = Pose::Identity();
    X_FM.translation().y() = up_mm;
    const contact::ContactMeasures found = measured(joint, X_FM);
    EXPECT_NEAR(*found.volume_mm3, volume_mm3, 5e-7 + found.volume_error_mm3) << up_mm;
    EXPECT_LT(found.volume_error_mm3, 1e-5) << up_mm;
    EXPECT_GT(found.fixed->area_mm2, 0) << up_mm;
    EXPECT_EQ(found.mobile_covered_again_mm3, 0) << up_mm;
    EXPECT_EQ(found.fixed_covered_again_mm3, 0) << up_mm;
  }
}

/// These references have four decimals, and the last of them differs by one unit from what three directions and the sums over both
/// patches agree on.
TEST(SampleOverlap, OfCartilagesOfFourSizesIsWhatExactIntegrationGives) {
  struct Case {
    CartilageScenario scenario;
    double clearance_mm, volume_mm3;
  };
  for (const auto& [scenario, clearance_mm, volume_mm3] :
       {Case{CartilageScenario::seven, 0, 7.7537}, Case{CartilageScenario::seven, -0.05, 125.6587},
        Case{CartilageScenario::seven, -0.1, 257.6496}, Case{CartilageScenario::six, -0.3, 827.6305}})
    EXPECT_NEAR(*measured(cartilages(scenario, clearance_mm), Pose::Identity()).volume_mm3, volume_mm3, 3e-4)
        << clearance_mm;
}

TEST(SampleOverlap, OfTheHipIsWhatExactIntegrationGives) {
  const SampleHip hip = sample_hip({}, Scenario::two);
  const contact::JointContact joint(hip.hip_bone, hip.femur);
  const auto at = [](double flexion, double adduction, double internal_rotation) {
    return pose_at({.side = Side::right},
                   {Angle::degrees(flexion), Angle::degrees(adduction), Angle::degrees(internal_rotation)});
  };
  for (const auto& [X_FM, volume_mm3] :
       {std::pair(at(130, 0, 20), 478.077155), std::pair(at(110, 15, 35), 1041.4065)}) {
    const contact::ContactMeasures found = measured(joint, X_FM);
    EXPECT_NEAR(*found.volume_mm3, volume_mm3, 5e-7 + found.volume_error_mm3);
    EXPECT_LT(found.volume_error_mm3, 1e-6);
  }
}

}  // namespace
}  // namespace condyle::sample
