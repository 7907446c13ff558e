#include "motion/search/contact_set.hpp"
#include "motion/search/first_contact.hpp"
#include "oracle/cgal_oracle.hpp"
#include "support/test.hpp"

/// Limits on real hips, certified by CGAL's exact triangle tests on the turned mesh: free just before,
/// touching just after.

namespace condyle {
namespace {

using test::CgalOracle;

constexpr double microdegree = 1e-6;

struct Start {
  const char* name;
  Vec3 axis;  ///< Through the joint centre, in the fixed body's frame.
  Pose X_FM;
};

Pose about(const Vec3& axis, double degrees) {
  return Pose(Eigen::AngleAxisd(Angle::degrees(degrees).radians(), axis));
}

std::vector<Start> starts() {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  const Pose flexed = about(z, 90), apart = about(z, 30) * about(x, -15) * about(y, 10);
  return {{"flexion", z, Pose::Identity()},
          {"adduction", x, Pose::Identity()},
          {"rotation", y, Pose::Identity()},
          {"adduction at 60 flexion", about(z, 60).linear() * x, about(z, 60)},
          {"rotation at 90 flexion", flexed.linear() * y, flexed},
          {"skew axis", Vec3(1, 2, 3).normalized(), apart}};
}

struct HipFiles {
  const char* name;
  const char* fixed;
  const char* mobile;
  friend void PrintTo(const HipFiles& hip, std::ostream* out) { *out << hip.name; }
};

/// Skips where the data is missing.
class FirstContactOfRealHips : public testing::TestWithParam<HipFiles> {
 protected:
  void SetUp() override {
    FOUND_OR_SKIP(data, test::shared_data());
    fixed = test::read_ply(*data / GetParam().fixed);
    mobile = test::in_spatial_order(test::read_ply(*data / GetParam().mobile));
  }
  TriMesh fixed, mobile;
};

TEST_P(FirstContactOfRealHips, StopsAtTheLimitFreeAMicrodegreeBeforeAndTouchingAMicrodegreeAfter) {
  const CgalOracle oracle(fixed);
  const motion::FeatureTree fixed_tree(fixed), mobile_tree(mobile);
  motion::RotatingBody body(mobile_tree);
  int contacts = 0;
  for (const Start& start : starts()) {
    SCOPED_TRACE(start.name);
    const AxisFrame frame(Vec3::Zero(), start.axis);
    const motion::RotationTable table(fixed_tree, frame);
    body.start_at(frame, start.X_FM);
    const auto found = first_contact(table, body);
    const auto touching = [&](double degrees) {
      return oracle.meets(posed(about(start.axis, degrees) * start.X_FM, mobile));
    };
    for (const auto& [limit, sense] : {std::pair{found.negative, RotationSense::negative},
                                       std::pair{found.positive, RotationSense::positive}}) {
      if (limit.reason == motion::LimitReason::contact_at_start) {
        EXPECT_TRUE(touching(0));
        continue;
      }
      const double sign = sign_of(sense), end = sign * limit.turned.degrees();
      for (int k = 0; k < 10; ++k) EXPECT_FALSE(touching(end * k / 10)) << k;
      EXPECT_FALSE(touching(end - sign * microdegree)) << end;
      if (limit.reason != motion::LimitReason::contact) continue;
      ++contacts;
      EXPECT_TRUE(touching(end + sign * microdegree)) << end;
      EXPECT_LE(limit.error_bound.radians(), 4e-12);
      const Vec3 there = about(start.axis, end) * start.X_FM * limit.contact->mobile_point;
      EXPECT_LT((there - limit.contact->fixed_point).norm(), 1e-9);
    }
  }
  EXPECT_GE(contacts, 4) << "too few contacts to mean anything";
}

TEST_P(FirstContactOfRealHips, TouchesThroughAFullTurnExactlyInItsContactSet) {
  const CgalOracle oracle(fixed);
  const motion::FeatureTree fixed_tree(fixed), mobile_tree(mobile);
  for (const Start& start : starts()) {
    SCOPED_TRACE(start.name);
    const AxisFrame frame(Vec3::Zero(), start.axis);
    motion::RotatingBody stationary(fixed_tree), rotating(mobile_tree);
    stationary.start_at(frame, Pose::Identity());
    rotating.start_at(frame, start.X_FM);
    const auto set = motion::contact_set(stationary, rotating);
    std::vector<double> angles;
    for (const core::Arc& arc : set.arcs()) {
      const double from = arc.start.degrees(), to = from + arc.width.degrees();
      angles.insert(angles.end(),
                    {from - microdegree, from + microdegree, to - microdegree, to + microdegree});
    }
    for (int k = 0; k < 12; ++k) angles.push_back(30 * k + 0.123);
    for (const double degrees : angles) {
      EXPECT_EQ(oracle.meets(posed(about(start.axis, degrees) * start.X_FM, mobile)),
                set.contains(Angle::degrees(degrees)))
          << degrees;
    }
  }
}

const HipFiles hips[] = {
    {"vhf", "hip_vhf_right/hip_bone.ply", "hip_vhf_right/femur.ply"},
    {"libhip", "hip_libhip_m1_left/hip_bone.ply", "hip_libhip_m1_left/femur.ply"},
    {"libhip_coarse", "hip_libhip_m1_left/coarse/hip_bone_2442.ply",
     "hip_libhip_m1_left/coarse/femur_1542.ply"},
};

INSTANTIATE_TEST_SUITE_P(SharedData, FirstContactOfRealHips, testing::ValuesIn(hips),
                         [](const auto& hip) { return hip.param.name; });

}  // namespace
}  // namespace condyle
