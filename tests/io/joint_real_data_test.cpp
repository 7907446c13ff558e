#include "condyle/io/joint_file.hpp"
#include "condyle/io/mesh_file.hpp"
#include "support/joint_text.hpp"
#include "support/test.hpp"

namespace condyle {
namespace {

namespace fs = std::filesystem;

/// A sphere fitted by other means, published with the mesh. Both fits leave out what they take for the neck,
/// and do not take quite the same: with residuals of rms 0.3 to 0.5 mm over half a sphere the centres differ
/// by a fraction of that.
struct PublishedFit {
  const char* mesh;
  SphericalPart part;
  Vec3 centre;
  double radius, rms;
  friend void PrintTo(const PublishedFit& fit, std::ostream* out) { *out << fit.mesh; }
};

constexpr double centre_tolerance = 0.25;  // mm: half the largest rms residual
constexpr double radius_tolerance = 0.25;

class RealFit : public ::testing::TestWithParam<PublishedFit> {};

TEST_P(RealFit, IsFoundWithoutAHint) {
  const auto& published = GetParam();
  const fs::path path = test::shared_data_folder() / published.mesh;
  if (!fs::exists(path)) GTEST_SKIP() << path << " is not here";
  const auto patch = find_sphere(io::read_mesh(path).mesh, {.part = published.part});
  EXPECT_LE((patch.fit.sphere.centre - published.centre).norm(), centre_tolerance);
  EXPECT_NEAR(patch.fit.sphere.radius, published.radius, radius_tolerance);
  EXPECT_LE(patch.fit.rms_residual, 1.5 * published.rms);
  EXPECT_GE(patch.coverage, published.part == SphericalPart::head ? 0.6 : 0.2);
}

INSTANTIATE_TEST_SUITE_P(
    Hips, RealFit,
    ::testing::Values(
        PublishedFit{"hip_vhf_right/femur.ply", SphericalPart::head, {0, 0, 0}, 23.857, 0.338},
        PublishedFit{"hip_libhip_m1_left/femur.ply", SphericalPart::head, {0, 0, 0}, 26.158, 0.42},
        PublishedFit{
            "hip_libhip_m1_left/coarse/femur_1542.ply", SphericalPart::head, {0, 0, 0}, 26.158, 0.42},
        PublishedFit{
            "hip_gait2392_lowres_dirty/femur_r.ply", SphericalPart::head, {-0.16, -0.61, 0.17}, 23.40, 0.29},
        PublishedFit{
            "hip_vhf_right/hip_bone.ply", SphericalPart::socket, {-0.7409, 0.767, -0.1567}, 25.428, 0.395},
        PublishedFit{"hip_libhip_m1_left/hip_bone.ply",
                     SphericalPart::socket,
                     {0.0886, 0.7681, 0.7361},
                     27.828,
                     0.366}),
    [](const auto& test) {
      std::string name = test.param.mesh;
      for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
      return name;
    });

TEST(RealFemur, ADirtyFemurInScannerAxesStillShowsItsHead) {
  const fs::path path = test::shared_data_folder() / "femur_libhip_m5_right_dirty/femur_tracked_surface.stl";
  if (!fs::exists(path)) GTEST_SKIP() << path << " is not here";
  const auto patch = find_sphere(io::read_mesh(path).mesh);
  // Femoral heads of adults: 20 to 30 mm.
  EXPECT_GT(patch.fit.sphere.radius, 20);
  EXPECT_LT(patch.fit.sphere.radius, 30);
  EXPECT_GE(patch.coverage, 0.6);
}

TEST(RealFemur, AFitDoesNotDependOnWhereTheFemurLies) {
  const fs::path path = test::shared_data_folder() / "hip_vhf_right/femur.ply";
  if (!fs::exists(path)) GTEST_SKIP() << path << " is not here";
  const TriMesh femur = io::read_mesh(path).mesh;
  const auto still = find_sphere(femur);
  Pose X = Pose(Eigen::AngleAxisd(1.1, Vec3(1, 2, 3).normalized()));
  X.translation() = Vec3(10000, -3000, 500);
  const auto moved = find_sphere(posed(X, femur));
  // Cells and rounding differ, so the set of vertices may by a few at its rim; the centre then moves within
  // its noise.
  EXPECT_LE((moved.fit.sphere.centre - posed(X, still.fit.sphere.centre)).norm(),
            0.1 * still.fit.rms_residual);
}

TEST(RealJoint, TheVisibleHumanHipIsReadWithItsMetresSourceNamedAsSuch) {
  const fs::path pelvis = test::shared_data_folder() / "hip_vhf_right/hip_bone.ply";
  const fs::path source = test::shared_data_folder() / "hip_vhf_right/dirty/FemurL_source.obj";
  if (!fs::exists(pelvis) || !fs::exists(source)) GTEST_SKIP() << pelvis << " is not here";
  const test::TemporaryFolder folder;
  const auto joint =
      folder.file("hip.toml", test::joint_text({.side = "left",
                                                .fixed = test::mesh_key(fs::absolute(pelvis)),
                                                .mobile = test::mesh_key(fs::absolute(source))}));
  EXPECT_THROW(io::read_joint(joint), FileError);
}

}  // namespace
}  // namespace condyle
