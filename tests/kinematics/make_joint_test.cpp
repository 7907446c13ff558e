#include "condyle/make_joint.hpp"

#include "core/predicates.hpp"
#include "support/same_bits.hpp"
#include "support/test.hpp"
#include "support/tube.hpp"

namespace condyle {
namespace {

/// A socket and a head with a long neck, the size of bones, off the grid of floats by thirds.
const Vec3 head_centre(1.0 / 3, -0.0, 2.0 / 3);
Body socket_body() {
  return {"hip bone", test::socket(head_centre, 26, 60, 3)};
}
Body head_body() {
  return {"femur",
          test::joined(test::sphere(head_centre, 24, 4), test::box({-10, -400, -10}, {10, -40, 10}))};
}

JointDescription right_hip() {
  return {.name = "right hip", .kind = JointKind::ball, .side = Side::right};
}

Body scaled(const Body& body, double scale) {
  return {body.name, test::scaled_by(body.mesh, scale)};
}

/// Message of the error, or "accepted".
template <class Error>
std::string refusal(const JointDescription& description, const Body& fixed, const Body& mobile) {
  return test::complaint_of<Error>([&] { make_joint(description, fixed, mobile); });
}

TEST(MakeJoint, TheStandardFrameKeepsEveryBit) {
  const auto [joint, placement] = make_joint(right_hip(), socket_body(), head_body());
  test::expect_same_bits(joint.mobile.mesh, head_body().mesh);
  EXPECT_EQ(joint.name, "right hip");
  EXPECT_EQ(joint.fixed.name, "hip bone");
  EXPECT_EQ(joint.mobile.name, "femur");
  EXPECT_TRUE(joint.mobile.mesh.is_closed());
  EXPECT_EQ(placement.X_WF.matrix(), Pose::Identity().matrix());
  EXPECT_TRUE(placement.axis_errors.none());
  EXPECT_TRUE(placement.processing.empty());
  EXPECT_EQ(placement.mobile.bounds.low.y(), -400);
  EXPECT_EQ(placement.mobile.likely_unit.unit, LengthUnit::millimetres);
}

TEST(MakeJoint, EveryCoordinateIsRoundedOnce) {
  JointDescription description = right_hip();
  description.units = LengthUnit::metres;
  description.frame.centre = Vec3(0.1, -0.2, 0.3);
  const Body metres = scaled(head_body(), 0.001);
  const auto [joint, placement] = make_joint(description, scaled(socket_body(), 0.001), metres);
  const Points &given = metres.mesh.vertices(), &placed = joint.mobile.mesh.vertices();
  for (std::size_t v = 0; v < given.size(); ++v) {
    // 1000 x needs 63 bits at most and the sum is rounded to 64 before it is rounded to 53.
    EXPECT_EQ(placed.x[v], static_cast<double>(1000.0L * given.x[v] - 0.1));
    EXPECT_EQ(placed.y[v], static_cast<double>(1000.0L * given.y[v] + 0.2));
    EXPECT_EQ(placed.z[v], static_cast<double>(1000.0L * given.z[v] - 0.3));
  }
}

TEST(MakeJoint, AScannersAxesArePermutedWithoutRounding) {
  // Left, posterior, superior: anterior is -y, superior z, and right -x.
  JointDescription description = right_hip();
  description.frame.axes = FrameDirections{{0, -1, 0}, {0, 0, 1}};
  EXPECT_EQ(make_joint(description, socket_body(), head_body()).joint.mobile.mesh,
            test::mapped(head_body().mesh, [](const Vec3& p) { return Vec3(-p.y(), p.z(), -p.x()); }));
}

TEST(MakeJoint, AReferencePoseMovesOnlyTheMobileMesh) {
  for (const Side side : {Side::right, Side::left}) {
    JointDescription description = right_hip();
    description.side = side;
    description.reference_pose.angles = {Angle::degrees(20), Angle::degrees(-10), Angle::degrees(5)};
    const Joint joint = make_joint(description, socket_body(), head_body()).joint;
    EXPECT_EQ(joint.fixed.mesh.arrays(), socket_body().mesh.arrays());
    // In that pose the mesh is where it was given: two rotations with a few u of 400 mm each.
    const TriMesh back = posed(pose_at({.side = side}, description.reference_pose.angles), joint.mobile.mesh);
    EXPECT_LE(test::farthest(back.vertices, head_body().mesh.vertices()), 32 * core::rounding_unit * 400);
  }
}

TEST(MakeJoint, AFittedCentreIsThatOfTheHeadOrOfTheSocket) {
  for (const auto& [role, radius] : {std::pair{BodyRole::mobile, 24.0}, std::pair{BodyRole::fixed, 26.0}}) {
    JointDescription description = right_hip();
    description.frame.centre = CentreFit{.body = role};
    const auto [joint, placement] = make_joint(description, socket_body(), head_body());
    ASSERT_TRUE(placement.sphere);
    // Vertices of 24 mm rounded to double lie on the sphere: see the tests of the fit.
    EXPECT_LE((placement.X_WF.translation() - head_centre).norm(), 1e-12);
    EXPECT_NEAR(placement.sphere->fit.sphere.radius, radius, 1e-12);
    ASSERT_EQ(placement.processing.size(), 1u);
    test::expect_begins(placement.processing[0], radius == 24 ? "centre fitted: sphere of radius 24.000 mm"
                                                              : "centre fitted: sphere of radius 26.000 mm");
  }
}

TEST(MakeJoint, AFittedAxisRotatesTheFrameOntoItByTheAngleBetween) {
  Pose X(Eigen::AngleAxisd(Angle::degrees(5).radians(), Vec3::UnitX()));
  X.translation() = Vec3(3, 4, 5);
  JointDescription elbow{.name = "elbow", .kind = JointKind::hinge, .side = Side::left};
  elbow.frame.centre = CentreFit{};
  const Body ulna{"ulna", test::box({-30, -40, -50}, {60, -100, 50})};
  const Body humerus{"humerus", posed(X, test::tube(12, 60, 60, 30))};
  const auto [joint, placement] = make_joint(elbow, ulna, humerus);
  ASSERT_TRUE(placement.cylinder);
  // The tube's vertices carry u of some 40 mm; over its 60 mm the axis tilts by that at most.
  EXPECT_NEAR(placement.axis_rotation.degrees(), 5, 1e-10);
  EXPECT_LE((placement.X_WF.linear() - X.linear()).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_NEAR(placement.cylinder->cylinder.radius, 12, 1e-11);
  ASSERT_FALSE(placement.processing.empty());
  test::expect_begins(placement.processing.back(), "axis fitted: cylinder of radius 12.000 mm");
  // In the joint frame the tube lies about Z: every vertex of its wall is 12 mm from it.
  for (const Index v : placement.cylinder->vertices) {
    const Vec3 p = joint.mobile.mesh.vertices()[v];
    EXPECT_NEAR(std::hypot(p.x(), p.y()), 12, 1e-11);
  }

  elbow.frame.axes = FrameDirections{{0, 1, 0}, {0, 0, 1}};
  test::expect_begins(refusal<MeshError>(elbow, ulna, humerus), "frame.centre: the fitted axis is ");
  elbow.frame = {.centre = CentreFit{.body = BodyRole::fixed}};
  test::expect_begins(refusal<MeshError>(elbow, ulna, humerus), "frame.centre: ulna: ");
}

TEST(MakeJoint, TheEpicondylesAndTheHipCentreGiveTheirMidpointAsOrigin) {
  JointDescription knee{.name = "knee", .kind = JointKind::hinge, .side = Side::right};
  knee.frame.axes = TransepicondylarAxis{{0, -400, -40}, {0, -400, 40}, {0, 0, 0}};
  const auto [joint, placement] = make_joint(knee, socket_body(), head_body());
  EXPECT_EQ(placement.X_WF.translation(), Vec3(0, -400, 0));
  EXPECT_EQ(placement.X_WF.linear(), Pose::Identity().linear());
}

TEST(MakeJoint, AFitThatFindsNothingNamesTheBody) {
  JointDescription description = right_hip();
  description.frame.centre = CentreFit{.body = BodyRole::mobile, .within = Sphere{{0, -300, 0}, 20}};
  test::expect_begins(refusal<MeshError>(description, socket_body(), head_body()), "frame.centre: femur: ");
}

TEST(MakeJoint, AxesThatAreNotOrthonormalAreRefusedSayingByHowMuch) {
  JointDescription description = right_hip();
  description.frame.axes = FrameDirections{{1, 0, 0}, {0.6, 0.8, 0}};
  EXPECT_EQ(refusal<UsageError>(description, socket_body(), head_body()),
            "frame: anterior and superior are 53.1301 degrees apart, not 90 (off by 36.8699)");
}

TEST(MakeJoint, MeshesOfTwoUnitsAreRefusedNamingBoth) {
  EXPECT_EQ(refusal<UsageError>(right_hip(), socket_body(), scaled(head_body(), 0.001)),
            "units: hip bone looks like millimetres and femur like metres: give both in one unit");
  const auto [joint, placement] =
      make_joint(right_hip(), scaled(socket_body(), 0.001), scaled(head_body(), 0.001));
  EXPECT_EQ(placement.fixed.likely_unit.unit, LengthUnit::metres);
}

TEST(MakeJoint, CoordinatesThatOverflowInMillimetresAreRefused) {
  TriMesh huge = head_body().mesh;
  huge.vertices.x[7] = 1e29;
  JointDescription description = right_hip();
  description.units = LengthUnit::metres;
  EXPECT_EQ(refusal<UsageError>(description, socket_body(), {"femur", huge}),
            "femur: vertex 7: coordinates too large for millimetres");
}

TEST(MakeJoint, ABadMeshIsRefusedBeforeAnythingIsComputed) {
  TriMesh bad = head_body().mesh;
  bad.triangles[3][1] = 100000;
  EXPECT_THROW(make_joint(right_hip(), socket_body(), {"femur", bad}), MeshError);
}

TEST(MakeJoint, AMeshWithoutTrianglesHasNoUnitAndIsPlaced) {
  const Body points{"points", TriMesh{head_body().mesh.vertices(), {}}};
  JointDescription description = right_hip();
  description.frame.centre = Vec3(1, 2, 3);
  const auto [joint, placement] = make_joint(description, socket_body(), points);
  EXPECT_FALSE(placement.mobile.likely_unit.unit);
  EXPECT_EQ(placement.mobile.bounds.low.y(), -402);
}

}  // namespace
}  // namespace condyle
