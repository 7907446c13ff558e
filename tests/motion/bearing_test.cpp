#include "condyle/bearing.hpp"

#include "condyle/impingement_zone.hpp"
#include "condyle/range_of_motion.hpp"
#include "motion/joint_scenes.hpp"
#include "motion/motion_cases.hpp"
#include "support/test.hpp"

/// Bearing contact is distinguished from impingement, and only impingement ends motions.

namespace condyle::motion {
namespace {

using namespace test;

TEST(BearingSurface, IsTheHeadWithinTheMarginOfItsSphere) {
  const Vec3 offset(0.1, -0.05, 0.15);
  const Joint joint = head_and_post_joint(offset);
  const auto surface = find_bearing_surface(joint).surface;
  ASSERT_TRUE(surface);
  EXPECT_LT((surface->head.centre - offset).norm(), 1e-9);
  EXPECT_NEAR(surface->head.radius, head_radius, 1e-9);
  ASSERT_TRUE(surface->socket);
  EXPECT_LT(surface->socket->centre.norm(), 1e-9);
  EXPECT_NEAR(surface->socket->radius, socket_radius, 1e-9);
  EXPECT_EQ(surface->margin_mm, by_head(usual_bearing_margin_mm, surface->head));
  // The arm is 12 triangles farther out; the head has all others.
  EXPECT_EQ(surface->count(), joint.mobile.mesh.triangles().size() - 12);
}

/// A head and its arm as two meshes of one body, one or both declared to be bearing.
Joint of_two_meshes(const Vec3& offset, PartContact head, PartContact arm) {
  Joint joint = head_and_post_joint(offset);
  const std::size_t vertices = joint.mobile.mesh.vertices().size();
  const std::size_t triangles = joint.mobile.mesh.triangles().size();
  joint.mobile.parts = {{"arm", 0, 8, 0, 12, arm}, {"head", 8, vertices - 8, 12, triangles - 12, head}};
  return joint;
}

TEST(BearingSurface, IsTheMeshToldToBe) {
  const Vec3 offset(0.1, -0.05, 0.15);
  const Joint joint = of_two_meshes(offset, PartContact::bearing, PartContact::ends);
  const auto surface = find_bearing_surface(joint).surface;
  ASSERT_TRUE(surface);
  EXPECT_EQ(surface->parts, std::vector<std::string>{"head"});
  EXPECT_LT((surface->head.centre - offset).norm(), 1e-9);
  EXPECT_NEAR(surface->head.radius, head_radius, 1e-9);
  EXPECT_EQ(surface->count(), joint.mobile.mesh.triangles().size() - 12);
  EXPECT_EQ(surface->triangles.front(), 0);
  EXPECT_EQ(find_bearing_surface(joint, {.margin_mm = 1}).surface->margin_mm, 1);
  const BearingFinding arm =
      find_bearing_surface(of_two_meshes(offset, PartContact::ends, PartContact::bearing));
  EXPECT_FALSE(arm.surface);
  EXPECT_NE(arm.why_none.find("spherical"), std::string::npos) << arm.why_none;
}

TEST(BearingSurface, GivenByMeshesLeavesMotionsToTheOthers) {
  // The head stands half a millimetre in its socket.
  const Vec3 off(3.5, 0, 0);
  const Joint joint = of_two_meshes(off, PartContact::bearing, PartContact::ends);
  Joint arm = joint;
  arm.mobile.mesh = mesh_of_part(joint.mobile, "arm");
  arm.mobile.parts.clear();
  const RangeOfMotion range(joint);
  const RangeOfMotion of_arm(arm, {.bearing = {.rule = BearingRule::count}});
  std::size_t ended = 0;
  for (const Motion& motion : hip_motions()) {
    const MotionLimit limit = range.limit(motion), expected = of_arm.limit(motion);
    EXPECT_EQ(limit.end.turned, expected.end.turned) << motion.name;
    EXPECT_EQ(limit.end.reason, expected.end.reason) << motion.name;
    ended += limit.end.reason == LimitReason::contact;
  }
  EXPECT_GT(ended, 0u);
  RangeOptions all{.bearing = {.rule = BearingRule::count}};
  all.overlap.reference_contact = ReferenceContact::accept;
  EXPECT_EQ(RangeOfMotion(joint, all).limit(flexion()).end.reason, LimitReason::contact_at_start);
}

TEST(BearingSurface, HasTheBoneUnderABearingCartilage) {
  // The head is a cartilage half a millimetre thick over a ball of bone, which stands in the socket too.
  const Vec3 off(3.8, 0, 0);
  Joint joint = of_two_meshes(off, PartContact::bearing, PartContact::ends);
  const TriMesh bone = sphere(off, head_radius - 0.5, 3);
  const std::size_t vertices = joint.mobile.mesh.vertices().size();
  const std::size_t triangles = joint.mobile.mesh.triangles().size();
  joint.mobile.mesh = joined(joint.mobile.mesh, bone);
  joint.mobile.parts.push_back({"ball", vertices, bone.vertices.size(), triangles, bone.triangles.size()});
  const RangeOfMotion range(joint);
  ASSERT_TRUE(range.bearing().surface);
  EXPECT_EQ(range.bearing().surface->count(), joint.mobile.mesh.triangles().size() - 12) << "all but the arm";
  EXPECT_NEAR(range.limit(flexion()).end.turned.radians(),
              RangeOfMotion(of_two_meshes(off, PartContact::bearing, PartContact::ends))
                  .limit(flexion())
                  .end.turned.radians(),
              angle_tolerance);
}

/// The mesh of a bone and of its cartilage as one body.
Body with_cartilage(const char* name, const TriMesh& bone, const TriMesh& cartilage, PartContact contact) {
  Body body{name, joined(bone, cartilage)};
  body.parts = {{"bone", 0, bone.vertices.size(), 0, bone.triangles.size()},
                {"cartilage", bone.vertices.size(), cartilage.vertices.size(), bone.triangles.size(),
                 cartilage.triangles.size(), contact}};
  return body;
}

TEST(BearingSurface, LeavesAReserveWhereTheRimIsNear) {
  // The rim's inner edge is a circle of socket_radius about the centre.
  const Joint joint = head_and_post_joint(Vec3::Zero());
  const auto usual = find_bearing_surface(joint).surface;
  ASSERT_TRUE(usual && usual->rim_gap_mm);
  EXPECT_NEAR(*usual->rim_gap_mm, socket_radius - head_radius, 1e-9);
  Joint narrow = joint;
  narrow.mobile.mesh = joined(sphere({0, 0, 0}, 21.5, 4), box({-1, -100, -1}, {1, -50, 1}));
  const auto surface = find_bearing_surface(narrow).surface;
  ASSERT_TRUE(surface);
  EXPECT_NEAR(surface->margin_mm, 1.5 - by_head(rim_reserve_mm, 21.5), 1e-9);
  EXPECT_EQ(find_bearing_surface(narrow, {.margin_mm = 1.75}).surface->margin_mm, 1.75) << "as stated";
}

TEST(BearingSurface, WhoseMarginIsNarrowerThanSurfacesAreRoughSaysSo) {
  Joint joint = head_and_post_joint(Vec3::Zero());
  const auto margin_of = [&](double radius) {
    joint.mobile.mesh = joined(sphere({0, 0, 0}, radius, 4), box({-1, -100, -1}, {1, -50, 1}));
    return find_bearing_surface(joint).narrow_margin;
  };
  // Reserve and bound grow with the head: 23 - r - r / 48 = r / 24.
  const double narrow_radius = socket_radius / (1 + (rim_reserve_mm + narrow_bearing_margin_mm) / 24);
  EXPECT_FALSE(margin_of(narrow_radius - 0.01));
  ASSERT_TRUE(margin_of(narrow_radius + 0.01));
  EXPECT_NEAR(margin_of(narrow_radius + 0.01)->margin_mm,
              socket_radius - (narrow_radius + 0.01) * (1 + rim_reserve_mm / 24), 1e-9);
  // A staircase of voxels is as rough as their diagonal, where that is more: 1.73 mm of cubes of 1 mm, 0.87 of 0.5.
  joint.fixed.image = BodyImage{0.5 * Eigen::Matrix3d::Identity(), {}};
  EXPECT_FALSE(margin_of(narrow_radius - 0.01));
  joint.fixed.image->voxel = Eigen::Matrix3d::Identity();
  EXPECT_TRUE(margin_of(narrow_radius - 0.01));
  const double radius_of_diagonal = (socket_radius - std::sqrt(3.0)) / (1 + rim_reserve_mm / 24);
  EXPECT_TRUE(margin_of(radius_of_diagonal + 0.01));
  EXPECT_FALSE(margin_of(radius_of_diagonal - 0.01));
  // An implant's facets, of 4 degrees here, stand out by hundredths of a millimetre.
  joint.fixed.image = {};
  joint.implant = JointImplant{};
  const auto radius_at = [&](double margin) { return (socket_radius - margin) / (1 + rim_reserve_mm / 24); };
  EXPECT_FALSE(margin_of(radius_at(0.1)));
  EXPECT_TRUE(margin_of(radius_at(0.01)));
}

TEST(BearingSurface, OfACartilageThatHasNoRoomSaysSoToo) {
  Joint joint = head_and_post_joint(Vec3::Zero());
  const auto margin_of = [&](double radius) {
    joint.mobile = with_cartilage("femur", box({-1, -100, -1}, {1, -50, 1}), sphere({0, 0, 0}, radius, 4),
                                  PartContact::bearing);
    return find_bearing_surface(joint).narrow_margin;
  };
  // No reserve is kept at the rim of a cartilage.
  const double narrow_radius = socket_radius / (1 + narrow_bearing_margin_mm / 24);
  EXPECT_FALSE(margin_of(narrow_radius - 0.01));
  ASSERT_TRUE(margin_of(narrow_radius + 0.01));
  ASSERT_TRUE(margin_of(socket_radius + 0.2)) << "pressed into its socket";
  EXPECT_NEAR(margin_of(socket_radius + 0.2)->gap_mm, -0.2, 1e-9);
}

TEST(BearingSurface, IsNotInvented) {
  const auto why_none = [](const Joint& joint) {
    const BearingFinding finding = find_bearing_surface(joint);
    EXPECT_FALSE(finding.surface);
    return finding.why_none;
  };
  Joint joint = head_and_post_joint({0, -6, 0});
  EXPECT_NE(why_none(joint).find("6.0 mm from the joint centre"), std::string::npos) << why_none(joint);
  joint = head_and_post_joint(Vec3::Zero());
  const std::string not_of_a_head = "bearing contact is not distinguished from impingement in this joint";
  for (const Anatomy other : {Anatomy::knee, Anatomy::ankle, Anatomy::elbow}) {
    joint.anatomy = other;
    EXPECT_EQ(why_none(joint), not_of_a_head);
  }
  joint = head_and_post_joint(Vec3::Zero());
  joint.kind = JointKind::hinge;
  EXPECT_EQ(why_none(joint), not_of_a_head);
  EXPECT_NE(why_none(post_joint(JointAngle::flexion, Side::right).joint).find("no head"), std::string::npos);
  joint = head_and_post_joint(Vec3::Zero());
  joint.mobile.mesh = sphere({0, 0, 0}, 22.7, 4);
  EXPECT_NE(why_none(joint).find("0.30 mm apart"), std::string::npos) << why_none(joint);
  joint.mobile.mesh = sphere({0, 0, 0}, 20, 4);
  EXPECT_NE(why_none(joint).find("all of it"), std::string::npos) << "as a cartilage is";
  for (const double margin : {-0.1, std::nan(""), HUGE_VAL})
    EXPECT_THROW(find_bearing_surface(joint, {.margin_mm = margin}), UsageError) << margin;
}

TEST(BearingSurface, HoldsAVertexOrEdgeWhenItHoldsAllItsTriangles) {
  const Joint joint = head_and_post_joint(Vec3::Zero());
  const TriMesh &fixed = joint.fixed.mesh, &mobile = joint.mobile.mesh;
  BearingFinding found = find_bearing_surface(joint);
  const auto head = static_cast<Index>(mobile.triangles.size() - 1);  // the arm comes first
  const auto [a, b, c] = mobile.triangles[head];
  const auto holds = [&](FeatureKind kind, Index id, Index other = no_index) {
    const ContactWitness contact{{}, {kind, id, other}, {}, {}};
    return found.kind_of(fixed, mobile, contact) == ContactKind::bearing;
  };
  EXPECT_TRUE(holds(FeatureKind::face, head) && holds(FeatureKind::vertex, a) &&
              holds(FeatureKind::edge, a, b));
  EXPECT_FALSE(holds(FeatureKind::face, 0) || holds(FeatureKind::vertex, mobile.triangles[0][0]));
  found.roles.mobile[head] = ContactRole::ends;
  EXPECT_FALSE(holds(FeatureKind::face, head) || holds(FeatureKind::vertex, a) ||
               holds(FeatureKind::vertex, c) || holds(FeatureKind::edge, a, b) ||
               holds(FeatureKind::edge, b, c));
}

TEST(BearingContact, DoesNotEndAMotionAndStandsBesideItsLimit) {
  // Off by more than the joint space, out of the socket: rotating back brings the head's centre round to its wall.
  const Joint joint = head_and_post_joint({0, -3.5, 0});
  const RangeOfMotion range(joint), all(joint, {.bearing = {.rule = BearingRule::count}});
  Motion back = flexion();
  back.sense = RotationSense::negative, back.range = Angle::radians(two_pi);
  for (const Motion& motion : {flexion(), back}) {
    const MotionLimit limit = range.limit(motion), counted = all.limit(motion);
    ASSERT_EQ(limit.end.reason, LimitReason::contact);
    EXPECT_EQ(limit.end.kind(), ContactKind::impingement);
    ASSERT_TRUE(limit.head && limit.head->joint_space_mm && limit.head->centre_distance_mm);
    EXPECT_NEAR(*limit.head->centre_distance_mm, 3.5, 1e-9) << "turning about the socket's centre keeps it";
    if (counted.end.kind() == ContactKind::bearing) {
      ASSERT_TRUE(limit.end.bearing_contact);
      EXPECT_EQ(limit.end.bearing_contact->turned, counted.end.turned);
      EXPECT_EQ(limit.end.bearing_contact->contact->mobile_feature, counted.end.contact->mobile_feature);
    } else {
      EXPECT_FALSE(limit.end.bearing_contact);
      EXPECT_EQ(limit.end.turned, counted.end.turned);
    }
  }
  EXPECT_NEAR(range.limit(flexion()).end.turned.radians(), post_limit(), angle_tolerance);
  EXPECT_FALSE(range.limit(flexion()).end.bearing_contact);
  EXPECT_TRUE(range.limit(back).end.bearing_contact);
}

TEST(BearingContact, InTheReferencePoseRefusesNothing) {
  const Joint joint = head_and_post_joint({0, 3.5, 0});
  EXPECT_THROW(RangeOfMotion(joint, {.bearing = {.rule = BearingRule::count}}), ReferenceContactError);
  const MotionLimit limit = RangeOfMotion(joint).limit(flexion());
  EXPECT_NEAR(limit.end.turned.radians(), post_limit(), angle_tolerance);
  ASSERT_TRUE(limit.end.bearing_contact);
  EXPECT_EQ(limit.end.bearing_contact->turned, Angle());
  EXPECT_EQ(limit.head->joint_space_mm, 0);
}

TEST(BearingContact, DoesNotEndAPathOrAddToAZone) {
  const Joint joint = head_and_post_joint({0, 3.5, 0});
  const std::vector<JointAngles> waypoints{{}, {Angle::degrees(60), Angle(), Angle()}};
  const PathLimit path = PathFinder(joint).limit(waypoints);
  EXPECT_EQ(path.reason, LimitReason::contact);
  // A path ends where some rotation by its tolerance of 0.001 degrees might bring contact; the arm meets the post's edge
  // nearly at a right angle.
  EXPECT_NEAR(path.at.flexion.degrees(), post_limit() * 180 / std::numbers::pi, 0.002);
  const auto zone = ZoneFinder(joint).zone(RangeOfMotion(joint).limit(flexion()));
  ASSERT_TRUE(zone);
  EXPECT_LE(zone->mobile.triangles.back(), 12u) << "the arm's";
  const TriMesh& mobile = joint.mobile.mesh;
  for (std::size_t v = 0; v < mobile.vertices.size(); ++v)
    if (mobile.vertices[v].norm() < 30) {
      EXPECT_EQ(zone->mobile.radial_depth_mm[v], 0) << v;
    }
  const auto whole = ZoneFinder(joint, {.bearing = {.rule = BearingRule::count}})
                         .zone(RangeOfMotion(joint).limit(flexion()));
  EXPECT_GT(whole->mobile.triangles.back(), 12u);
}

/// Limits of the two clean hips with the centre moved by a millimetre: examples/centre_displacement.cpp prints all.
struct Displaced {
  Vec3 centre;
  std::array<double, 12> limits_deg;
};
enum class Fits {
  anew,  ///< for every centre
  once,  ///< and moved with the others: a head is the same whatever the centre, and on fine meshes slow to find
};
struct HipTable {
  const char* name;
  const char* folder;
  Side side;
  Fits fits;
  std::array<Displaced, 7> rows;
  friend void PrintTo(const HipTable& hip, std::ostream* out) { *out << hip.name; }
};

/// Computed by other means (an experiment on cut meshes), to a hundredth of a degree.
const HipTable hips[] = {
    {"vhf",
     "hip_vhf_right",
     Side::right,
     Fits::anew,
     {{{{0, 0, 0}, {133.78, 72.77, 61.42, 39.26, 102.77, 55.14, 75.44, 53.40, 32.69, 110.67, 25.96, 120.00}},
       {{-1, 0, 0}, {131.59, 72.96, 61.42, 39.26, 99.62, 56.37, 65.37, 52.36, 30.57, 114.89, 23.48, 120.00}},
       {{1, 0, 0}, {136.06, 72.85, 61.42, 39.26, 106.01, 53.97, 80.59, 54.01, 34.71, 105.97, 28.40, 120.00}},
       {{0, -1, 0}, {137.09, 78.16, 61.29, 39.98, 102.77, 55.14, 75.97, 56.09, 37.68, 113.17, 31.12, 120.00}},
       {{0, 1, 0}, {125.56, 68.58, 61.40, 38.56, 102.77, 55.14, 72.14, 49.63, 25.75, 108.41, 19.20, 120.00}},
       {{0, 0, -1}, {133.78, 72.77, 59.16, 39.31, 98.24, 52.98, 70.64, 51.80, 30.47, 107.91, 23.79, 120.00}},
       {{0, 0, 1},
        {133.78, 72.77, 63.71, 39.20, 115.50, 57.74, 80.27, 54.22, 35.08, 113.59, 28.33, 120.00}}}}},
    {"libhip",
     "hip_libhip_m1_left",
     Side::left,
     Fits::once,
     {{{{0, 0, 0}, {120.78, 20.96, 40.89, 30.22, 115.61, 22.97, 70.85, 29.46, 49.07, 72.78, 36.47, 43.38}},
       {{-1, 0, 0}, {118.91, 21.38, 40.89, 30.22, 115.65, 23.60, 66.46, 28.67, 47.43, 76.65, 34.27, 42.81}},
       {{1, 0, 0}, {122.48, 20.55, 40.89, 30.22, 115.77, 22.37, 75.97, 30.67, 50.44, 68.37, 38.68, 44.93}},
       {{0, -1, 0}, {124.65, 23.29, 40.67, 30.68, 115.61, 22.97, 70.53, 31.86, 53.23, 75.65, 43.39, 39.96}},
       {{0, 1, 0}, {116.53, 19.55, 40.91, 29.77, 115.61, 22.97, 71.57, 27.63, 42.45, 69.58, 30.49, 48.81}},
       {{0, 0, -1}, {120.78, 20.96, 42.67, 30.14, 120.00, 25.31, 74.82, 29.78, 51.82, 73.58, 40.47, 49.21}},
       {{0, 0, 1}, {120.78, 20.96, 39.12, 30.29, 109.98, 20.84, 67.60, 29.19, 46.05, 71.95, 32.77, 40.19}}}}},
};

class DisplacedCentre : public testing::TestWithParam<HipTable> {};
INSTANTIATE_TEST_SUITE_P(SharedData, DisplacedCentre, testing::ValuesIn(hips),
                         [](const auto& hip) { return hip.param.name; });

TEST_P(DisplacedCentre, ByAMillimetreMovesLimitsByDegreesNotByTens) {
  FOUND_OR_SKIP(data, test::shared_data());
  const HipTable& hip = GetParam();
  const TriMesh fixed = read_ply(*data / hip.folder / "hip_bone.ply"),
                mobile = read_ply(*data / hip.folder / "femur.ply");
  std::vector<double> changes;
  std::optional<BearingSurface> first;
  for (const Displaced& row : hip.rows) {
    SCOPED_TRACE(testing::Message() << "centre " << row.centre.transpose());
    const Joint joint{hip.name,
                      JointKind::ball,
                      hip.side,
                      {"hip bone", test::shifted_by(fixed, -row.centre)},
                      {"femur", test::shifted_by(mobile, -row.centre)}};
    BearingOptions bearing{.margin_mm = 2};
    if (hip.fits == Fits::once && first) {
      bearing.surface = first;
      bearing.surface->head.centre -= row.centre;
    }
    const RangeOfMotion range(joint, {.bearing = bearing});
    if (!first) first = range.bearing().surface;
    ASSERT_TRUE(first);
    const auto limits = range.limits(hip_motions());
    for (std::size_t i = 0; i < limits.size(); ++i) {
      const double limit = limits[i].end.turned.degrees();
      EXPECT_NEAR(limit, row.limits_deg[i], 0.01) << limits[i].motion.name;
      EXPECT_NE(limits[i].end.reason, LimitReason::contact_at_start) << limits[i].motion.name;
      if (&row != &hip.rows.front()) changes.push_back(std::abs(limit - hip.rows.front().limits_deg[i]));
    }
  }
  std::sort(changes.begin(), changes.end());
  EXPECT_LE(changes.back(), 14);
  EXPECT_LE(changes[changes.size() * 9 / 10], 6);
}

TEST(BearingCartilage, BesideItsBoneLeavesLimitsToTheBones) {
  FOUND_OR_SKIP(data, test::shared_data());
  const auto folder = *data / "hip_libhip_m1_left";
  const TriMesh hip_bone = read_ply(folder / "hip_bone.ply"), femur = read_ply(folder / "femur.ply"),
                acetabular = read_ply(folder / "acetabular_cartilage_gap.ply"),
                femoral = read_ply(folder / "femur_cartilage_gap.ply");
  const HipTable& bones = hips[1];
  for (const std::size_t row : {0u, 4u}) {
    const Vec3 by = -bones.rows[row].centre;
    SCOPED_TRACE(testing::Message() << "moved by " << by.transpose());
    const Joint joint{"four meshes", JointKind::ball, Side::left,
                      with_cartilage("hip bone", test::shifted_by(hip_bone, by),
                                     test::shifted_by(acetabular, by), PartContact::ends),
                      with_cartilage("femur", test::shifted_by(femur, by), test::shifted_by(femoral, by),
                                     PartContact::bearing)};
    const RangeOfMotion range(joint);
    for (std::size_t i = 0; i < hip_motions().size(); ++i) {
      const MotionLimit limit = range.limit(hip_motions()[i]);
      const double of_bones = bones.rows[row].limits_deg[i];
      // In external rotation the neck meets the edge of the socket's cartilage 1.54 degrees before the bone behind it: contact
      // that the bones alone do not have.
      const bool meets_cartilage_first = limit.motion.name == "external_rotation";
      EXPECT_LE(limit.end.turned.degrees(), of_bones + 1.5) << limit.motion.name;
      EXPECT_GE(limit.end.turned.degrees(), of_bones - (meets_cartilage_first ? 1.6 : 1.5))
          << limit.motion.name;
    }
  }
}

}  // namespace
}  // namespace condyle::motion
