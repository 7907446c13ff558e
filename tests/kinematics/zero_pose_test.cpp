#include "condyle/joint_checks.hpp"
#include "condyle/make_joint.hpp"
#include "support/test.hpp"

/// Where a femur lies when its angles are zero is read from its condyles, and can be made neutral by them.

namespace condyle {
namespace {

constexpr double head_mm = 24, condyle_mm = 20;

/// A head, a shaft, and two balls for condyles, 50 mm apart, with their backs 20 mm behind the shaft's axis: in neutral.
TriMesh whole_femur() {
  const TriMesh condyles =
      test::joined(test::sphere({0, -380, 25}, condyle_mm, 4), test::sphere({0, -380, -25}, condyle_mm, 4));
  return test::joined(test::joined(test::sphere({0, 0, 0}, head_mm, 5), condyles),
                      test::box({-8, -365, -8}, {8, -20, 8}));
}
TriMesh upper_femur() {
  return test::joined(test::sphere({0, 0, 0}, head_mm, 5), test::box({-8, -200, -8}, {8, -20, 8}));
}

JointAngles lying_at(double flexion, double adduction, double rotation) {
  return {Angle::degrees(flexion), Angle::degrees(adduction), Angle::degrees(rotation)};
}

JointDescription described_hip(Side side = Side::right) {
  return {.name = "hip", .side = side};
}

/// The femur as a scan shows it that lies at these angles.
PlacedJoint hip_with(const TriMesh& mobile, const JointDescription& description, const JointAngles& lies_at) {
  const TriMesh scanned = posed(pose_at(description.coordinates(), lies_at), mobile);
  return make_joint(description, {"hip bone", test::socket({0, 0, 0}, 26, 60, 3)}, {"femur", scanned});
}

bool notes_turned_leg(const PlacedJoint& placed) {
  for (const JointNote& note : check_joint(placed.joint, placed.placement))
    if (note.code == JointNoteCode::turned_leg) return true;
  return false;
}

void expect_angles(const JointAngles& found, const JointAngles& expected, double tolerance_deg) {
  EXPECT_NEAR(found.flexion.degrees(), expected.flexion.degrees(), tolerance_deg);
  EXPECT_NEAR(found.adduction.degrees(), expected.adduction.degrees(), tolerance_deg);
  EXPECT_NEAR(found.internal_rotation.degrees(), expected.internal_rotation.degrees(), tolerance_deg);
}

/// The line to the middle of the far end has settled to far less after five rounds.
constexpr double rounding_deg = 1e-3;

TEST(ZeroPose, AFemursCondylesSayAtWhichAnglesItLies) {
  for (const Side side : {Side::right, Side::left})
    for (const JointAngles& lies_at : {lying_at(0, 0, 0), lying_at(0, 0, -25), lying_at(0, 0, 18.1),
                                       lying_at(20, 0, 0), lying_at(12, -9, 21.5)}) {
      const ZeroPose zero = zero_pose(hip_with(whole_femur(), described_hip(side), lies_at).joint);
      EXPECT_EQ(zero.from, ZeroFrom::as_given);
      ASSERT_TRUE(zero.femur);
      expect_angles(*zero.femur, lies_at, rounding_deg);
    }
}

TEST(ZeroPose, ALegMoreThanFiveDegreesOffNeutralInAnyAngleIsNoted) {
  for (const double off : {4.9, -4.9, 5.1, -5.1})
    for (const JointAngles& lies_at : {lying_at(off, 0, 0), lying_at(0, off, 0), lying_at(0, 0, off)})
      EXPECT_EQ(notes_turned_leg(hip_with(whole_femur(), described_hip(), lies_at)), std::abs(off) > 5)
          << off;
}

TEST(ZeroPose, TheNoteSaysByHowMuchInEachAngle) {
  const auto [joint, placement] = hip_with(whole_femur(), described_hip(Side::left), lying_at(3, -2, -25));
  std::string texts;
  for (const JointNote& note : check_joint(joint, placement)) texts += note.text + '\n';
  test::expect_says(texts, "flexion 3.0, adduction -2.0, internal rotation -25.0 degrees");
}

TEST(ZeroPose, TheAnatomyGivesTheReferencePoseFromWhichAnglesCountFromNeutral) {
  for (const Side side : {Side::right, Side::left}) {
    JointDescription description = described_hip(side);
    description.zero_from = ZeroFrom::anatomy;
    const JointAngles lies_at = lying_at(7, 4, -25);
    const PlacedJoint placed = hip_with(whole_femur(), description, lies_at);
    expect_angles(placed.placement.reference_pose.angles, lies_at, rounding_deg);
    EXPECT_EQ(placed.placement.zero_from, ZeroFrom::anatomy);
    test::expect_says(placed.placement.processing.back(),
                      "flexion 7.00, adduction 4.00, internal rotation -25.00");
    const ZeroPose zero = zero_pose(placed.joint);
    EXPECT_TRUE(zero.is_neutral());
    EXPECT_FALSE(notes_turned_leg(placed));
    EXPECT_LT(test::farthest(placed.joint.mobile.mesh.vertices(), whole_femur().vertices),
              400 * Angle::degrees(2 * rounding_deg).radians());
  }
}

TEST(ZeroPose, TheCentreMayBeFittedAndTheUnitMetres) {
  JointDescription description = described_hip();
  description.zero_from = ZeroFrom::anatomy;
  description.frame.centre = CentreFit{};
  description.units = LengthUnit::metres;
  const auto elsewhere = [](const TriMesh& mesh) {
    return test::mapped(mesh, [](const Vec3& p) { return Vec3((p + Vec3(30, -40, 50)) / 1000); });
  };
  const TriMesh scanned = posed(pose_at(description.coordinates(), lying_at(0, 0, -25)), whole_femur());
  const auto placed = make_joint(description, {"hip bone", elsewhere(test::socket({0, 0, 0}, 26, 60, 3))},
                                 {"femur", elsewhere(scanned)});
  expect_angles(placed.placement.reference_pose.angles, lying_at(0, 0, -25), rounding_deg);
}

TEST(ZeroPose, WithoutCondylesTheAnatomyGivesNoneAndZeroIsNotKnown) {
  JointDescription description = described_hip();
  const PlacedJoint as_given = hip_with(upper_femur(), description, {});
  EXPECT_FALSE(zero_pose(as_given.joint).femur);
  EXPECT_FALSE(zero_pose(as_given.joint).is_neutral());
  EXPECT_FALSE(notes_turned_leg(as_given));
  test::expect_says(zero_text(as_given.joint, zero_pose(as_given.joint)), "how the leg lay is not known");
  description.zero_from = ZeroFrom::anatomy;
  EXPECT_THROW(hip_with(upper_femur(), description, {}), MeshError);
}

TEST(ZeroPose, AReferencePoseThatIsStatedIsNeutralUnlessCondylesContradictIt) {
  JointDescription description = described_hip();
  description.zero_from = ZeroFrom::stated;
  EXPECT_TRUE(zero_pose(hip_with(upper_femur(), description, {}).joint).is_neutral());
  const PlacedJoint contradicted = hip_with(whole_femur(), description, lying_at(0, 0, -25));
  EXPECT_FALSE(zero_pose(contradicted.joint).is_neutral());
  EXPECT_TRUE(notes_turned_leg(contradicted));
  // Other angles than zero state themselves.
  description.zero_from = ZeroFrom::as_given;
  description.reference_pose.angles = lying_at(0, 0, -25);
  const PlacedJoint agreed = hip_with(whole_femur(), description, lying_at(0, 0, -25));
  EXPECT_EQ(zero_pose(agreed.joint).from, ZeroFrom::stated);
  EXPECT_TRUE(zero_pose(agreed.joint).is_neutral());
  EXPECT_FALSE(notes_turned_leg(agreed));
}

TEST(ZeroPose, LandmarksOfBothBodiesAreBelieved) {
  JointDescription description = described_hip();
  description.frame.axes = AnteriorPelvicPlane{{0, 0, 120}, {0, 0, -120}, {0, -90, 0}};
  const Pose X = pose_at(description.coordinates(), lying_at(0, 0, -12));
  description.frame.mobile_axes = FemurLandmarks{X * Vec3(0, -380, -40), X * Vec3(0, -380, 40)};
  const PlacedJoint placed = hip_with(whole_femur(), description, lying_at(0, 0, -20));
  const ZeroPose zero = zero_pose(placed.joint);
  EXPECT_EQ(zero.from, ZeroFrom::landmarks);
  EXPECT_TRUE(zero.is_neutral());
  EXPECT_FALSE(notes_turned_leg(placed));
  description.zero_from = ZeroFrom::anatomy;
  EXPECT_THROW(hip_with(whole_femur(), description, {}), UsageError);
}

TEST(ZeroPose, OnlyAHipHasOneFromItsAnatomy) {
  JointDescription knee{.name = "knee", .zero_from = ZeroFrom::anatomy, .anatomy = Anatomy::knee};
  EXPECT_THROW(hip_with(whole_femur(), knee, {}), UsageError);
  JointDescription with_angles = described_hip();
  with_angles.zero_from = ZeroFrom::anatomy;
  with_angles.reference_pose.angles = lying_at(1, 0, 0);
  EXPECT_THROW(hip_with(whole_femur(), with_angles, {}), UsageError);
}

TEST(ZeroPose, ARealFemurTurnedInItsScanIsNotedAndMadeNeutral) {
  FOUND_OR_SKIP(data, test::shared_data());
  const TriMesh hip_bone = test::read_ply(*data / "hip_vhf_right/hip_bone.ply"),
                real = test::read_ply(*data / "hip_vhf_right/femur.ply");
  const auto made = [&](const JointAngles& turned, ZeroFrom from) {
    JointDescription description = described_hip();
    description.zero_from = from;
    return make_joint(description, {"hip bone", hip_bone},
                      {"femur", posed(pose_at(description.coordinates(), turned), real)});
  };
  const PlacedJoint as_is = made({}, ZeroFrom::as_given);
  EXPECT_TRUE(zero_pose(as_is.joint).is_neutral());
  EXPECT_FALSE(notes_turned_leg(as_is));
  EXPECT_TRUE(notes_turned_leg(made(lying_at(0, 0, -25), ZeroFrom::as_given)));
  EXPECT_TRUE(notes_turned_leg(made(lying_at(20, 0, 0), ZeroFrom::as_given)));
  // However it lay, from neutral it is the same femur: to what the choice of 45 mm of its end leaves.
  const PlacedJoint neutral = made({}, ZeroFrom::anatomy);
  for (const JointAngles& turned : {lying_at(0, 0, -25), lying_at(20, 0, 0), lying_at(-5, 8, 30)}) {
    const PlacedJoint other = made(turned, ZeroFrom::anatomy);
    EXPECT_LT(test::farthest(other.joint.mobile.mesh.vertices(), neutral.joint.mobile.mesh.vertices()),
              400 * Angle::degrees(2 * rounding_deg).radians());
  }
}

}  // namespace
}  // namespace condyle
