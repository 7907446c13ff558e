#include <gtest/gtest.h>

#include "condyle/error.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/io/mesh_file.hpp"
#include "core/predicates.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_meshes.hpp"
#include "support/tube.hpp"

namespace condyle {
namespace {

using test::TemporaryFolder;

/// A hinge whose mobile body is a tube, tilted by 5 degrees from Z, beside a box.
class ReadHinge : public ::testing::Test {
 protected:
  void SetUp() override {
    io::write_mesh(folder / "ulna.ply", test::box({-30, -40, -50}, {60, -100, 50}));
    X.translation() = Vec3(3, 4, 5);
    io::write_mesh(folder / "humerus.ply", posed(X, test::tube(12, 60, 60, 30)));
  }
  io::LoadedJoint read(std::string_view frame) const {
    return io::read_joint(
        folder.file("elbow.toml",
                    "condyle = 1\nname = \"elbow\"\nkind = \"hinge\"\nside = \"left\"\nunits = \"mm\"\n"
                    "[fixed]\nmesh = \"ulna.ply\"\n[mobile]\nmesh = \"humerus.ply\"\n[frame]\n" +
                        std::string(frame)));
  }

  const TemporaryFolder folder;
  Pose X = Pose(Eigen::AngleAxisd(Angle::degrees(5).radians(), Vec3::UnitX()));
};

constexpr const char* standard_axes = "anterior = [1, 0, 0]\nsuperior = [0, 1, 0]\n";

TEST_F(ReadHinge, AFittedAxisRotatesTheFrameToItAndReportsByHowMuch) {
  const auto [joint, report] = read("centre = \"fit\"\n" + std::string(standard_axes));
  ASSERT_TRUE(report.placement.cylinder);
  // The tube's vertices carry u of some 40 mm; over its 60 mm the axis tilts by that at most.
  EXPECT_NEAR(report.placement.axis_rotation.degrees(), 5, 1e-10);
  EXPECT_NEAR(report.placement.cylinder->cylinder.radius, 12, 1e-11);
  EXPECT_LE((report.placement.X_WF.linear() - X.linear()).cwiseAbs().maxCoeff(), 1e-12);
  // In the joint frame the tube lies about Z: every vertex of its wall is 12 mm from it.
  for (const Index v : report.placement.cylinder->vertices) {
    const Vec3 p = joint.mobile.mesh.vertices()[v];
    EXPECT_NEAR(std::hypot(p.x(), p.y()), 12, 1e-11);
  }
  ASSERT_FALSE(report.processing.empty());
  EXPECT_TRUE(report.processing.back().starts_with("axis fitted: cylinder of radius 12.000 mm"))
      << report.processing.back();
}

TEST_F(ReadHinge, NamesLeftOutAreTheBodiesRoles) {
  const auto [joint, report] = read("centre = [0, 0, 0]\n" + std::string(standard_axes));
  EXPECT_EQ(joint.kind, JointKind::hinge);
  EXPECT_EQ(joint.fixed.name, "fixed");
  EXPECT_EQ(joint.mobile.name, "mobile");
}

TEST_F(ReadHinge, AnAxisFarFromTheGivenOneIsRefused) {
  // Axes with Z along the tube's radius: right = (0, 0, 1) x ... is perpendicular to the fitted axis.
  EXPECT_THROW(read("centre = \"fit\"\nanterior = [0, 1, 0]\nsuperior = [0, 0, 1]\n"), MeshError);
}

TEST_F(ReadHinge, NoCylinderIsAMeshError) {
  EXPECT_THROW(read("centre = \"fit\"\nfit_body = \"fixed\"\n" + std::string(standard_axes)), MeshError);
}

}  // namespace
}  // namespace condyle
