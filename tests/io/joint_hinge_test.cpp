#include "condyle/io/joint_file.hpp"
#include "condyle/io/mesh_file.hpp"
#include "support/joint_text.hpp"
#include "support/test.hpp"
#include "support/tube.hpp"

namespace condyle {
namespace {

/// A hinge whose mobile body is a tube, tilted by 5 degrees from Z, beside a box.
class ReadHinge : public ::testing::Test {
 protected:
  void SetUp() override {
    io::write_mesh(folder / "ulna.ply", test::box({-30, -40, -50}, {60, -100, 50}));
    X.translation() = Vec3(3, 4, 5);
    io::write_mesh(folder / "humerus.ply", posed(X, test::tube(12, 60, 60, 30)));
  }
  io::LoadedJoint read(std::string_view centre, std::string_view axes = test::plain_axes) const {
    return io::read_joint(folder.file("elbow.toml", test::joint_text({.kind = "hinge",
                                                                      .side = "left",
                                                                      .fixed = "mesh = \"ulna.ply\"",
                                                                      .mobile = "mesh = \"humerus.ply\"",
                                                                      .centre = centre,
                                                                      .axes = axes})));
  }

  const test::TemporaryFolder folder;
  Pose X = Pose(Eigen::AngleAxisd(Angle::degrees(5).radians(), Vec3::UnitX()));
};

/// The rest of it is asked of make_joint.
TEST_F(ReadHinge, IsFittedToItsCylinder) {
  const auto [joint, report] = read("\"fit\"");
  ASSERT_TRUE(report.placement.cylinder);
  EXPECT_NEAR(report.placement.axis_rotation.degrees(), 5, 1e-10);
  ASSERT_FALSE(report.processing.empty());
  test::expect_begins(report.processing.back(), "axis fitted: cylinder of radius 12.000 mm");
}

TEST_F(ReadHinge, NamesLeftOutAreTheBodiesRoles) {
  const auto [joint, report] = read("[0, 0, 0]");
  EXPECT_EQ(joint.kind, JointKind::hinge);
  EXPECT_EQ(joint.fixed.name, "fixed");
  EXPECT_EQ(joint.mobile.name, "mobile");
}

TEST_F(ReadHinge, NoCylinderIsAMeshError) {
  EXPECT_THROW(read("\"fit\"\nfit_body = \"fixed\""), MeshError);
}

}  // namespace
}  // namespace condyle
