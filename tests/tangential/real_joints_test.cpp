#include "condyle/angle.hpp"
#include "condyle/tangential.hpp"
#include "core/thread_limit.hpp"
#include "mesh/winding_number.hpp"
#include "support/test.hpp"

namespace condyle::tangential {
namespace {

struct Pair {
  const char *fixed, *mobile;
};

/// Closed pairs of the real hips: bones, and cartilages with a gap and without.
constexpr Pair pairs[] = {
    {"hip_libhip_m1_left/hip_bone.ply", "hip_libhip_m1_left/femur.ply"},
    {"hip_vhf_right/hip_bone.ply", "hip_vhf_right/femur.ply"},
    {"hip_libhip_m1_left/acetabular_cartilage_gap.ply", "hip_libhip_m1_left/femur_cartilage_gap.ply"},
    {"hip_libhip_m1_left/acetabular_cartilage_nogap.ply", "hip_libhip_m1_left/femur_cartilage_nogap.ply"},
    {"hip_libhip_m1_left/coarse/hip_bone_2442.ply", "hip_libhip_m1_left/coarse/femur_1542.ply"},
};

/// Free, grazing and deep poses about the hip centre (the origin): rotations about z, x and y in degrees, and a
/// shift in mm.
struct HipPose {
  double z, x, y, shift;
};
constexpr HipPose poses[] = {{0, 0, 0, 0},     {30, 0, 0, 0},    {90, -10, 20, 0}, {120, 5, -15, 0},
                             {-30, 20, 10, 0}, {60, -40, 30, 0}, {0, 0, 0, 4},     {15, 10, -5, 12},
                             {100, 30, 40, 0}, {45, 0, -60, 25}};

Points posed_vertices(const TriMesh& mesh, const HipPose& pose) {
  const auto rotation = [](double degrees, const Vec3& axis) {
    return Eigen::AngleAxisd(Angle::degrees(degrees).radians(), axis);
  };
  Pose X = Pose::Identity();
  X.linear() =
      (rotation(pose.z, Vec3::UnitZ()) * rotation(pose.x, Vec3::UnitX()) * rotation(pose.y, Vec3::UnitY()))
          .matrix();
  X.translation() = Vec3(0.3, 1, -0.5) * pose.shift;
  return posed(X, mesh.vertices.view());
}

TEST(RealJoints, EveryStateIsThatOfTheWindingNumberAtEveryPoseAboutEveryCoordinateAxis) {
  FOUND_OR_SKIP(data, test::shared_data());
  for (const auto& pair : pairs) {
    const TriMesh fixed = test::read_ply(*data / pair.fixed), mobile = test::read_ply(*data / pair.mobile);
    const mesh::WindingNumber winding(fixed);
    std::size_t inside = 0;
    for (const Vec3& axis : {Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0, -1, 0)}) {
      const RingTable table(fixed, AxisFrame(Vec3::Zero(), axis));
      for (const auto& pose : poses) {
        const Points points = posed_vertices(mobile, pose);
        const auto results = table.query(points);
        const auto expected = winding.at(points);
        std::size_t different = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
          different += results.state[i] != expected[i].state || results.winding[i] != expected[i].winding;
          inside += results.state[i] == PointState::inside;
          // A gap is negative exactly inside.
          different += (results.angular_gap[i].radians() < 0) != (results.state[i] == PointState::inside);
        }
        EXPECT_EQ(different, 0u) << pair.fixed << " about " << axis.transpose() << ", flexed by " << pose.z;
      }
    }
    EXPECT_GT(inside, 0u) << pair.fixed;
  }
}

TEST(RealJoints, AVertexOfTheMeshItselfIsOnTheSurfaceAndItsArcsAreThoseJustBesideIt) {
  FOUND_OR_SKIP(data, test::shared_data());
  const TriMesh bone = test::read_ply(*data / "hip_libhip_m1_left/coarse/hip_bone_2442.ply");
  const RingTable table(bone, AxisFrame(Vec3::Zero(), Vec3::UnitZ()));
  const auto results = table.query(bone.vertices);
  const auto arcs = table.occupied_arcs(bone.vertices);
  const mesh::WindingNumber winding(bone);
  std::size_t compared = 0;
  for (std::size_t i = 0; i < bone.vertices.size(); ++i) {
    EXPECT_EQ(results.state[i], PointState::on_surface);
    EXPECT_EQ(results.angular_gap[i].radians(), 0);
    for (int degree = 0; degree < 360; degree += 10) {
      const Angle phi = Angle::degrees(degree + 3.7);
      const Vec3 p = Eigen::AngleAxisd(phi.radians(), Vec3::UnitZ()) * bone.vertices[i];
      const auto gap = arcs.gap_at(i, phi);
      // A circle through a vertex runs along no face; a point rotated in double is off by less than 1e-12 mm.
      if (std::abs(gap.angle.radians()) * std::hypot(p.x(), p.y()) < 1e-9) continue;
      EXPECT_EQ(gap.angle.radians() < 0, winding.at(p).state == PointState::inside) << i << " at " << degree;
      ++compared;
    }
  }
  EXPECT_GT(compared, 40000u);
}

TEST(RealJoints, AFullTurnOfTheFemurIsAnsweredByOnePass) {
  FOUND_OR_SKIP(data, test::shared_data());
  const TriMesh bone = test::read_ply(*data / "hip_libhip_m1_left/hip_bone.ply");
  const TriMesh femur = test::read_ply(*data / "hip_libhip_m1_left/coarse/femur_1542.ply");
  const auto arcs = RingTable(bone, AxisFrame(Vec3::Zero(), Vec3::UnitZ())).occupied_arcs(femur.vertices);
  const mesh::WindingNumber winding(bone);
  std::size_t inside = 0, compared = 0;
  for (int degree = 0; degree < 360; ++degree) {
    const Angle phi = Angle::degrees(degree);
    const Eigen::AngleAxisd rotation(phi.radians(), Vec3::UnitZ());
    for (std::size_t i = 0; i < femur.vertices.size(); ++i) {
      const auto gap = arcs.gap_at(i, phi);
      const Vec3 p = rotation * femur.vertices[i];
      if (std::abs(gap.angle.radians()) * std::hypot(p.x(), p.y()) < 1e-9) continue;
      EXPECT_EQ(gap.angle.radians() < 0, winding.at(p).state == PointState::inside) << i << " at " << degree;
      inside += gap.angle.radians() < 0;
      ++compared;
    }
  }
  EXPECT_GT(inside, 1000u);
  EXPECT_GT(compared, 360 * femur.vertices.size() - 1000);
}

TEST(RealJoints, OneThreadAndManyGiveTheSameBytes) {
  FOUND_OR_SKIP(data, test::shared_data());
  const TriMesh bone = test::read_ply(*data / "hip_vhf_right/hip_bone.ply");
  const Points points = posed_vertices(test::read_ply(*data / "hip_vhf_right/femur.ply"), {100, 30, 40, 0});
  const AxisFrame frame(Vec3::Zero(), Vec3(1, 2, -1));
  const RingTable table(bone, frame);
  const auto results = table.query(points);
  const auto arcs = table.occupied_arcs(points);
  const core::ThreadLimit one(1);
  const RingTable single(bone, frame);
  EXPECT_EQ(results, single.query(points));
  EXPECT_EQ(arcs, single.occupied_arcs(points));
}

}  // namespace
}  // namespace condyle::tangential
