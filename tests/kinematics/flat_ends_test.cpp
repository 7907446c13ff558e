#include "kinematics/flat_ends.hpp"

#include "condyle/bearing.hpp"
#include "condyle/joint_checks.hpp"
#include "condyle/make_joint.hpp"
#include "mesh/cut_mesh.hpp"
#include "support/test.hpp"

/// A closed bone that ends in a plane near the joint is found wherever it was cut, and nothing else is.

namespace condyle {
namespace {

constexpr double ball_radius = 24;

TriMesh kept_behind(const TriMesh& bone, const Vec3& point, const Vec3& normal) {
  const std::array planes{mesh::CuttingPlane{point, normal.normalized()}};
  return mesh::cut_by_planes(Mesh(bone), "bone", planes).inner.mesh;
}

TriMesh balls() {
  return test::joined(test::sphere({0, 0, 0}, ball_radius, 5), test::sphere({0, -120, 0}, 30, 4));
}

std::vector<ImageCut> ends_of(const TriMesh& bone) {
  return kinematics::flat_ends(Mesh(bone));
}

Joint hip_of_balls(TriMesh fixed, TriMesh mobile) {
  return make_joint({.name = "hip"}, {"hip bone", std::move(fixed)}, {"femur", std::move(mobile)}).joint;
}

bool notes_flat_end(const Joint& joint) {
  const std::vector<JointNote> notes = check_joint(joint, {});
  return std::any_of(notes.begin(), notes.end(),
                     [](const JointNote& note) { return note.code == JointNoteCode::flat_end; });
}

/// The wall of a large socket, cut in front of the joint.
TriMesh wall_cut_at(double distance, const Vec3& normal = Vec3::UnitX()) {
  return kept_behind(test::socket({0, 0, 0}, 26, 150, 5), distance * normal.normalized(), normal);
}

TEST(FlatEnds, AnyPlaneThatABoneWasCutByIsFound) {
  for (const Vec3& normal : {Vec3(1, 0, 0), Vec3(0.3, 0.8, -0.5), Vec3(-1, 2, 1)}) {
    const auto ends = ends_of(kept_behind(test::sphere({5, -3, 2}, 60, 5), {10, 0, 0}, normal));
    ASSERT_EQ(ends.size(), 1u);
    EXPECT_GT(ends[0].normal.dot(normal.normalized()), 1 - 1e-9);
    EXPECT_NEAR(ends[0].offset_mm, normal.normalized().dot(Vec3(10, 0, 0)), 1e-9);
  }
  EXPECT_TRUE(ends_of(test::sphere({5, -3, 2}, 60, 5)).empty());
}

/// A ball of voxels as a stack of discs, as high as they are: the uppermost is flat.
TriMesh stack_of_discs(double radius, double step) {
  const int half = static_cast<int>(radius / step);
  std::vector<std::array<double, 2>> profile = {{0, half * step}};
  for (int layer = -half; layer < half; ++layer) {
    const double middle = std::abs(layer + 0.5) * step,
                 wide = std::sqrt(std::max(radius * radius - middle * middle, 0.0));
    profile.insert(profile.end(), {{wide, -layer * step}, {wide, -(layer + 1) * step}});
  }
  profile.push_back({0, -half * step});
  return test::mapped(test::turned_solid(profile, 64),
                      [](const Vec3& p) { return Vec3(p.y(), p.z(), p.x()); });
}

TEST(FlatEnds, TheUppermostStepOfAStaircaseOfVoxelsIsNone) {
  for (const double voxel : {0.5, 1.0, 2.0}) {
    const TriMesh ball = stack_of_discs(50, voxel);
    ASSERT_TRUE(Mesh(ball).is_closed());
    EXPECT_TRUE(ends_of(ball).empty()) << voxel;
    EXPECT_EQ(ends_of(kept_behind(ball, {0, 20.25, 0}, Vec3::UnitY())).size(), 1u) << voxel;
  }
}

TEST(FlatEnds, SizeDoesNotMatter) {
  const TriMesh cut = kept_behind(test::sphere({5, -3, 2}, 60, 5), {10, 0, 0}, {1, 1, 0});
  for (const double scale : {0.1, 10.0}) EXPECT_EQ(ends_of(test::scaled_by(cut, scale)).size(), 1u) << scale;
}

TEST(FlatEnds, AFaceHasItsAreaAndItsDistanceFromTheCentre) {
  // A disc of radius sqrt(60^2 - 20^2), as a polygon of the mesh's chords.
  const TriMesh cut = kept_behind(test::sphere({0, 0, 0}, 60, 6), {20, 0, 0}, Vec3::UnitX());
  const auto ends = ends_of(cut);
  ASSERT_EQ(ends.size(), 1u);
  const kinematics::FlatFace face = kinematics::face_in(cut, ends[0]);
  EXPECT_NEAR(face.distance_mm, 20, 1e-9);
  const double disc = std::numbers::pi * 3200, edge = 60 * std::numbers::pi / 2 / 64 * 1.5;
  EXPECT_LT(face.area_mm2, disc);
  EXPECT_GT(face.area_mm2, disc * (1 - edge * edge / 3200));
}

constexpr double farthest = kinematics::farthest_flat_end * ball_radius;

TEST(FlatEnds, ABoneThatEndsNearTheJointIsNoted) {
  EXPECT_TRUE(notes_flat_end(hip_of_balls(wall_cut_at(farthest - 1), balls())));
  EXPECT_FALSE(notes_flat_end(hip_of_balls(wall_cut_at(farthest + 1), balls())));
  EXPECT_TRUE(notes_flat_end(hip_of_balls(wall_cut_at(50, {1, 1, 1}), balls())));
  EXPECT_FALSE(notes_flat_end(hip_of_balls(test::sphere({0, 90, 0}, 60, 4), balls())));
}

TEST(FlatEnds, OfAFemurLikewise) {
  const auto cut_at = [&](double height) {
    return test::joined(test::sphere({0, 0, 0}, ball_radius, 5),
                        kept_behind(test::sphere({0, -100, 0}, 80, 5), {0, -height, 0}, -Vec3::UnitY()));
  };
  EXPECT_TRUE(notes_flat_end(hip_of_balls(test::sphere({0, 90, 0}, 60, 4), cut_at(farthest - 1))));
  EXPECT_FALSE(notes_flat_end(hip_of_balls(test::sphere({0, 90, 0}, 60, 4), cut_at(farthest + 1))));
}

TEST(FlatEnds, ContactOnSuchAFaceIsNoLimit) {
  const Joint joint = hip_of_balls(wall_cut_at(50), balls());
  const motion::BearingFinding bearing = motion::find_bearing_surface(joint);
  ASSERT_EQ(bearing.fixed_cuts.size(), 1u);
  EXPECT_NEAR(bearing.fixed_cuts[0].offset_mm, 50, 1e-9);
  EXPECT_TRUE(bearing.mobile_cuts.empty());
}

TEST(FlatEnds, WhereAnImageEndsItIsNotSaidTwice) {
  Joint joint = hip_of_balls(wall_cut_at(50), balls());
  joint.fixed.image = BodyImage{Eigen::Matrix3d::Identity(), {{Vec3::UnitX(), 50}}};
  EXPECT_FALSE(notes_flat_end(joint));
  joint.fixed.image->cuts.clear();
  EXPECT_TRUE(notes_flat_end(joint)) << "the map ends inside its image";
}

TEST(FlatEnds, TheRimOfACupIsNone) {
  // Its flat rim goes through the joint centre, and the cup opens through it.
  EXPECT_FALSE(notes_flat_end(hip_of_balls(test::socket({0, 0, 0}, 26, 60, 5), balls())));
  EXPECT_EQ(ends_of(test::socket({0, 0, 0}, 26, 60, 5)).size(), 1u);
}

TEST(FlatEnds, PlanesOfImplantsAndOfBodiesOfSeveralBonesMayBeMeant) {
  Joint joint = hip_of_balls(wall_cut_at(50), balls());
  const std::size_t vertices = joint.fixed.mesh.vertices().size(),
                    triangles = joint.fixed.mesh.triangles().size();
  joint.fixed.parts = {{"shell", 0, vertices, 0, triangles}};
  EXPECT_TRUE(notes_flat_end(joint)) << "one mesh of its own";
  joint.fixed.parts.push_back({"liner", vertices, 0, triangles, 0});
  EXPECT_FALSE(notes_flat_end(joint));
  joint.fixed.parts.clear();
  joint.implant.emplace();
  EXPECT_FALSE(notes_flat_end(joint));
}

TEST(FlatEnds, RealBonesHaveNoneNearTheJointUntilTheyAreCut) {
  FOUND_OR_SKIP(data, test::shared_data());
  for (const char* name : {"hip_vhf_right", "hip_libhip_m1_left"}) {
    const TriMesh hip_bone = test::read_ply(*data / name / "hip_bone.ply"),
                  real = test::read_ply(*data / name / "femur.ply");
    EXPECT_FALSE(notes_flat_end(hip_of_balls(hip_bone, real))) << name;
    EXPECT_TRUE(notes_flat_end(hip_of_balls(kept_behind(hip_bone, {0, 35, 0}, Vec3::UnitY()), real))) << name;
    EXPECT_TRUE(notes_flat_end(hip_of_balls(kept_behind(hip_bone, {30, 0, 0}, Vec3::UnitX()), real))) << name;
    EXPECT_TRUE(notes_flat_end(hip_of_balls(hip_bone, kept_behind(real, {0, -55, 0}, -Vec3::UnitY()))))
        << name;
    EXPECT_FALSE(notes_flat_end(hip_of_balls(hip_bone, kept_behind(real, {0, -75, 0}, -Vec3::UnitY()))))
        << name;
  }
}

}  // namespace
}  // namespace condyle
