#include "condyle/range_of_motion.hpp"
#include "oracle/cgal_oracle.hpp"
#include "support/test.hpp"

/// Limits of the built-in motions, certified by CGAL's exact triangle tests, which share no code with the
/// library: free at 200 angles before the limit and a microdegree before it, in contact a microdegree after.

namespace condyle {
namespace {

using test::CgalOracle;

struct SidedHipFiles {
  const char* name;
  const char* fixed;
  const char* mobile;
  Side side;
  friend void PrintTo(const SidedHipFiles& hip, std::ostream* out) { *out << hip.name; }
};
const SidedHipFiles sided_hips[] = {
    {"vhf", "hip_vhf_right/hip_bone.ply", "hip_vhf_right/femur.ply", Side::right},
    {"libhip", "hip_libhip_m1_left/hip_bone.ply", "hip_libhip_m1_left/femur.ply", Side::left},
    {"libhip_coarse", "hip_libhip_m1_left/coarse/hip_bone_2442.ply",
     "hip_libhip_m1_left/coarse/femur_1542.ply", Side::left},
};

class LimitCertificate : public testing::TestWithParam<std::tuple<SidedHipFiles, std::size_t>> {};
INSTANTIATE_TEST_SUITE_P(SharedData, LimitCertificate,
                         testing::Combine(testing::ValuesIn(sided_hips),
                                          testing::Range<std::size_t>(0, motion::hip_motions().size())),
                         [](const auto& at) {
                           return std::string(std::get<0>(at.param).name) + "_" +
                                  motion::hip_motions()[std::get<1>(at.param)].name;
                         });

TEST_P(LimitCertificate, FreeBeforeAndInContactAfter) {
  FOUND_OR_SKIP(data, test::shared_data());
  const auto& [files, number] = GetParam();
  const Joint joint{files.name,
                    JointKind::ball,
                    files.side,
                    {"hip bone", test::read_ply(*data / files.fixed)},
                    {"femur", test::read_ply(*data / files.mobile)}};
  const motion::Motion motion = motion::hip_motions()[number];
  const motion::MotionLimit limit =
      motion::RangeOfMotion(joint, {.bearing = {.rule = motion::BearingRule::count}}).limit(motion);
  const CgalOracle oracle(joint.fixed.mesh);
  const TriMesh mobile = test::in_spatial_order(joint.mobile.mesh);
  const auto touching = [&](Angle turned) {
    const Angle by = motion.sense == RotationSense::positive ? turned : -turned;
    return oracle.meets(
        posed(pose_at(joint.coordinates(), motion::turned_by(motion.start, motion.vary, by)), mobile));
  };
  if (limit.end.reason == motion::LimitReason::contact_at_start) {
    EXPECT_TRUE(touching(Angle()));
    return;
  }
  const Angle microdegree = Angle::degrees(1e-6);
  constexpr int poses_before = 200;
  for (int k = 0; k < poses_before; ++k)
    EXPECT_FALSE(touching(limit.end.turned * (static_cast<double>(k) / poses_before))) << "of 200: " << k;
  EXPECT_FALSE(touching(limit.end.turned - microdegree));
  if (limit.end.reason == motion::LimitReason::contact) {
    EXPECT_TRUE(touching(limit.end.turned + microdegree));
  }
}

}  // namespace
}  // namespace condyle
