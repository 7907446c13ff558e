#include "condyle/contact_measures.hpp"

#include "contact/chosen_arcs.hpp"
#include "support/test.hpp"

namespace condyle::test {
namespace {

/// A wall in front of the joint, x = 40, and an arm that hangs from the centre along -y and is flexed into it. Rays to
/// the arm's end run along the wall; rotating back frees it.
class ArmIntoWall : public ::testing::Test {
 protected:
  const contact::JointContact joint{box({40, -120, -50}, {60, -20, 50}), box({-1, -100, -2}, {1, -10, 2})};
  const JointAngles pose{Angle::degrees(25), {}, {}};
  const Pose X_FM = pose_at({.side = Side::right}, pose);
  const contact::RadialContact contact = joint.radial(X_FM);
  const contact::ContactMeasures measures = contact::measure_contact(
      joint, X_FM, contact::MeasuredContact(contact), contact::DistancesOf::vertices_inside);
};

TEST_F(ArmIntoWall, IsAsDeepAsTheRotationThatFreesItSoonest) {
  const contact::ReliableContact found = contact::reliable_depths(
      joint, JointKind::ball, {.side = Side::right}, pose, contact, measures.distances);
  ASSERT_TRUE(found.mobile && found.mobile->deepest);
  const contact::DeepestReliable& deepest = *found.mobile->deepest;
  EXPECT_GT(deepest.ray_to_normal.degrees(), 60);
  EXPECT_EQ(deepest.kind, contact::DepthKind::flexion);
  // The front edge of the arm's end, (1, -100), meets x = 40 where flexion is asin(40 / r) - atan2(1, 100).
  const double r = std::hypot(1, 100);
  const double back = Angle::degrees(25).radians() - (std::asin(40 / r) - std::atan2(1, 100));
  const auto& flexion = deepest.rotations[0];
  ASSERT_TRUE(flexion);
  EXPECT_NEAR(flexion->angle.radians(), back, 1e-12);
  EXPECT_NEAR(deepest.depth_mm, back * r, 1e-10);
  EXPECT_EQ(deepest.depth_mm, flexion->arc_mm);
  for (const auto& way : deepest.rotations) {
    if (way) {
      EXPECT_GE(way->arc_mm, deepest.depth_mm);
    }
  }
  EXPECT_LE(deepest.nearest_distance_mm, deepest.depth_mm);
}

TEST_F(ArmIntoWall, AHingeTurnsAboutOneAxisOnly) {
  const contact::ReliableContact found =
      contact::reliable_depths(joint, JointKind::hinge, {}, pose, contact, measures.distances);
  ASSERT_TRUE(found.mobile && found.mobile->deepest);
  EXPECT_TRUE(found.mobile->deepest->rotations[0]);
  EXPECT_FALSE(found.mobile->deepest->rotations[1]);
  EXPECT_FALSE(found.mobile->deepest->rotations[2]);
}

TEST_F(ArmIntoWall, WithoutRotationsOnlyTheNearestDistanceIsLeft) {
  const contact::ReliableContact found = contact::reliable_radial_depths(contact, measures.distances);
  const radial::RadialResults& radial = *contact.mobile_in_fixed;
  std::size_t inside = 0;
  for (std::size_t v = 0; v < radial.size(); ++v) {
    if (radial.state[v] != PointState::inside) {
      EXPECT_EQ(found.mobile->kind[v], contact::DepthKind::none);
      EXPECT_EQ(found.mobile->depth_mm[v], 0);
      continue;
    }
    ++inside;
    EXPECT_EQ(found.mobile->kind[v], contact::DepthKind::nearest);
    EXPECT_EQ(found.mobile->depth_mm[v], measures.distances.mobile[v]);
  }
  EXPECT_GT(inside, 0u);
  EXPECT_EQ(found.mobile->without, inside);
  EXPECT_FALSE(found.mobile->deepest);
}

TEST(ReliableDepths, WhereTheSurfaceFacesTheRayTheRadialDepthIsIt) {
  // A ball of radius 24 in a socket of radius 23: every ray is a normal, up to what flat triangles are off.
  const contact::JointContact joint(socket({0, 0, 0}, 23, 60, 3), sphere({0, 0, 0}, 24, 3));
  const contact::RadialContact contact = joint.radial(Pose::Identity());
  const contact::ContactMeasures measures = contact::measure_contact(
      joint, Pose::Identity(), contact::MeasuredContact(contact), contact::DistancesOf::vertices_inside);
  const contact::ReliableContact found = contact::reliable_depths(
      joint, JointKind::ball, {.side = Side::right}, {}, contact, measures.distances);
  const radial::RadialResults& radial = *contact.mobile_in_fixed;
  std::size_t along_rays = 0;
  for (std::size_t v = 0; v < radial.size(); ++v) {
    if (found.mobile->kind[v] != contact::DepthKind::radial) continue;
    ++along_rays;
    EXPECT_EQ(found.mobile->depth_mm[v], -radial.radial_gap_mm[v]);
    EXPECT_LE(radial.ray_to_normal[v].degrees(), 60);
  }
  EXPECT_GT(along_rays, 90u);
}

/// Every third vertex from `first` on.
std::vector<Index> some_of(const Mesh& mesh, Index first) {
  std::vector<Index> some;
  for (Index v = first; v < mesh.vertices().size(); v += 3) some.push_back(v);
  return some;
}

void expect_those_of_all(const tangential::TangentialResults& some, const std::vector<Index>& vertices,
                         const tangential::TangentialResults& all) {
  ASSERT_EQ(some.size(), vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Index v = vertices[i];
    ASSERT_EQ(some.state[i], all.state[v]) << v;
    ASSERT_EQ(some.angular_gap[i], all.angular_gap[v]) << v;
    ASSERT_EQ(some.arc_gap_mm[i], all.arc_gap_mm[v]) << v;
    ASSERT_EQ(some.triangle[i], all.triangle[v]) << v;
    ASSERT_EQ(some.rotation_sense[i], all.rotation_sense[v]) << v;
  }
}

TEST(ChosenArcs, AreThoseOfAllVerticesBitByBit) {
  const contact::JointContact joint(socket({0, 0, 0}, 23, 60, 3), sphere({0, 0, 0}, 24, 3));
  const Pose X_FM = pose_at({.side = Side::right}, {Angle::degrees(25), Angle::degrees(-10), {}});
  const contact::ChosenVertices chosen{some_of(joint.mobile(), 1), some_of(joint.fixed(), 2)};
  for (const Vec3& axis : {Vec3(0, 0, 1), Vec3(1, 0.2, -0.3)}) {
    const contact::ChosenArcs some = contact::arcs_of(joint, X_FM, axis, chosen);
    const contact::TangentialContact all = joint.tangential(X_FM, axis);
    expect_those_of_all(some.mobile, chosen.mobile, *all.mobile_in_fixed);
    expect_those_of_all(some.fixed, chosen.fixed, *all.fixed_in_mobile);
  }
}

TEST(ChosenArcs, OfABodyThatIsOpenNoneAreAsked) {
  TriMesh open = box({40, -120, -50}, {60, -20, 50});
  open.triangles.pop_back();
  const contact::JointContact joint(open, box({-1, -100, -2}, {1, -10, 2}));
  const contact::ChosenArcs arcs = contact::arcs_of(joint, Pose::Identity(), Vec3(0, 0, 1), {{}, {0, 1}});
  EXPECT_EQ(arcs.mobile.size(), 0u);
  EXPECT_EQ(arcs.fixed.size(), 2u);
}

}  // namespace
}  // namespace condyle::test
