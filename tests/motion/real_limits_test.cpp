#include "condyle/contact.hpp"
#include "condyle/impingement_zone.hpp"
#include "condyle/range_of_motion.hpp"
#include "support/test.hpp"

/// Every built-in motion of real real_hips, against the exact sets of intersecting triangles.

namespace condyle::motion {
namespace {

struct HipFiles {
  const char* name;
  const char* fixed;
  const char* mobile;
  Side side;
  friend void PrintTo(const HipFiles& hip, std::ostream* out) { *out << hip.name; }
};
const HipFiles real_hips[] = {
    {"vhf", "hip_vhf_right/hip_bone.ply", "hip_vhf_right/femur.ply", Side::right},
    {"libhip_coarse", "hip_libhip_m1_left/coarse/hip_bone_2442.ply",
     "hip_libhip_m1_left/coarse/femur_1542.ply", Side::left},
};

class RealHipLimits : public testing::TestWithParam<HipFiles> {
 protected:
  void SetUp() override {
    FOUND_OR_SKIP(data, test::shared_data());
    joint_ = {GetParam().name,
              JointKind::ball,
              GetParam().side,
              {"hip bone", test::read_ply(*data / GetParam().fixed)},
              {"femur", test::read_ply(*data / GetParam().mobile)}};
  }
  Pose pose_past(const MotionLimit& limit, Angle past) const {
    const Angle by = limit.motion.sense == RotationSense::positive ? past : -past;
    return pose_at(joint_.coordinates(), turned_by(limit.angles_at_limit(), limit.motion.vary, by));
  }

  Joint joint_{{}, JointKind::ball, Side::right, {{}, TriMesh{}}, {{}, TriMesh{}}};
};
INSTANTIATE_TEST_SUITE_P(SharedData, RealHipLimits, testing::ValuesIn(real_hips),
                         [](const auto& hip) { return hip.param.name; });

TEST_P(RealHipLimits, AreFreeAMicrodegreeBeforeAndInContactAMicrodegreeAfter) {
  const contact::JointContact exact(joint_.fixed.mesh, joint_.mobile.mesh);
  const auto limits = RangeOfMotion(joint_, {.bearing = {.rule = BearingRule::count}}).limits(hip_motions());
  std::size_t contacts = 0;
  for (const MotionLimit& limit : limits) {
    SCOPED_TRACE(limit.motion.name);
    ASSERT_NE(limit.end.reason, LimitReason::contact_at_start);
    const Angle microdegree = Angle::degrees(1e-6);
    EXPECT_TRUE(exact.pairs(pose_past(limit, -microdegree)).empty());
    // 20 poses on the way.
    for (int k = 1; k <= 20; ++k)
      EXPECT_TRUE(exact.pairs(pose_past(limit, limit.end.turned * (-k / 20.0))).empty());
    if (limit.end.reason != LimitReason::contact) continue;
    ++contacts;
    const auto pairs = exact.pairs(pose_past(limit, microdegree));
    ASSERT_FALSE(pairs.empty());
    // The limit names one place on both bones, within the error_bound and the rounding of a pose.
    const Vec3 seen_from_F = pose_past(limit, Angle()) * limit.end.contact->mobile_point;
    EXPECT_LT((seen_from_F - limit.end.contact->fixed_point).norm(), 1e-9);
  }
  EXPECT_GE(contacts, 11u);
}

TEST_P(RealHipLimits, HaveZonesThatGrowFromTheContactPoint) {
  const BearingOptions all{.rule = BearingRule::count};
  const auto limits = RangeOfMotion(joint_, {.bearing = all}).limits(hip_motions());
  const ZoneFinder shortly_after(joint_, {.bearing = all, .past = Angle::degrees(0.5)}),
      later(joint_, {.bearing = all, .past = Angle::degrees(5)});
  ASSERT_TRUE(later.neck());
  for (const MotionLimit& limit : limits) {
    SCOPED_TRACE(limit.motion.name);
    const auto small = shortly_after.zone(limit), large = later.zone(limit);
    ASSERT_EQ(small.has_value(), limit.end.reason == LimitReason::contact);
    if (!small) continue;
    EXPECT_GT(small->fixed.area_mm2, 0);
    EXPECT_GE(large->fixed.triangles.size(), small->fixed.triangles.size());
    EXPECT_GE(large->mobile.triangles.size(), small->mobile.triangles.size());
    // Half a degree past the limit the zone is no further from the contact point than some ten triangles.
    EXPECT_LT((*small->fixed.centroid_mm - limit.end.contact->fixed_point).norm(), 40);
    EXPECT_EQ(large->fixed.radial_depth_mm.size(), joint_.fixed.mesh.vertices().size());
    EXPECT_EQ(large->mobile.tangential_depth_mm.size(), joint_.mobile.mesh.vertices().size());
    // No vertex is deeper along the arc than the motion went past the limit: rotating back by that frees it.
    for (const double depth : large->mobile.tangential_depth_deg) EXPECT_LE(depth, 5 + 1e-9);
    for (const double depth : large->fixed.tangential_depth_deg) EXPECT_LE(depth, 5 + 1e-9);
  }
}

TEST_P(RealHipLimits, FindTheNeckWhereAnatomyHasIt) {
  const ZoneFinder finder(joint_);
  ASSERT_TRUE(finder.neck());
  const Vec3 d = finder.neck()->direction;
  // Neck-shaft angles of adults are 110 to 145 degrees, and the femur hangs nearly along -Y.
  const double to_shaft = std::acos(d.y()) * 180 / std::numbers::pi;
  EXPECT_GT(to_shaft, 110);
  EXPECT_LT(to_shaft, 145);
  EXPECT_GT(d.z() * (joint_.side == Side::right ? 1 : -1), 0.4) << "lateral";
}

/// Segmented without care for contact: 47 pairs of triangles meet in the reference pose (the data's own table),
/// and the hip bone is open.
TEST(OverlappingRealHip, IsRefusedUntilAnOptionSaysWhatToDo) {
  FOUND_OR_SKIP(data, test::shared_data());
  const Joint joint{"gait2392",
                    JointKind::ball,
                    Side::right,
                    {"hip bone", test::read_ply(*data / "hip_gait2392_lowres_dirty/pelvis_r.ply")},
                    {"femur", test::read_ply(*data / "hip_gait2392_lowres_dirty/femur_r.ply")}};
  try {
    const RangeOfMotion refused(joint, {.bearing = {.rule = BearingRule::count}});
    FAIL() << "accepted";
  } catch (const MeshError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("47 pairs of triangles meet; an open mesh has no depth"), std::string::npos) << text;
  }
  const RangeOfMotion bones(joint,
                            {.bearing = {.rule = BearingRule::count},
                             .overlap = {.leave_out_reference_contacts = LeaveOutReferenceContacts{}}});
  EXPECT_GT(bones.left_out().fixed_triangles, 0u);
  std::size_t contacts = 0;
  for (const MotionLimit& limit : bones.limits(hip_motions())) {
    EXPECT_NE(limit.end.reason, LimitReason::contact_at_start) << limit.motion.name;
    contacts += limit.end.reason == LimitReason::contact;
  }
  EXPECT_GT(contacts, 3u);
}

/// All of its contact in the reference pose is bearing contact.
TEST(OverlappingRealHip, IsAnsweredWhereOnlyBearingSurfacesOverlap) {
  FOUND_OR_SKIP(data, test::shared_data());
  const RangeOfMotion range({"gait2392",
                             JointKind::ball,
                             Side::right,
                             {"hip bone", test::read_ply(*data / "hip_gait2392_lowres_dirty/pelvis_r.ply")},
                             {"femur", test::read_ply(*data / "hip_gait2392_lowres_dirty/femur_r.ply")}});
  for (const MotionLimit& limit : range.limits(hip_motions())) {
    if (limit.motion.start != JointAngles{}) continue;
    EXPECT_NE(limit.end.reason, LimitReason::contact_at_start) << limit.motion.name;
    ASSERT_TRUE(limit.end.bearing_contact) << limit.motion.name;
    EXPECT_EQ(limit.end.bearing_contact->turned, Angle()) << limit.motion.name;
  }
}

}  // namespace
}  // namespace condyle::motion
