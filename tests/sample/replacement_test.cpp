#include "condyle/sample/hip.hpp"

#include "condyle/range_of_motion.hpp"
#include "mesh/enclosed_volume.hpp"
#include "mesh/self_crossings.hpp"
#include "support/test.hpp"

/// A total hip in the sample hip: docs/implants.md.

namespace condyle::test {
namespace {

plan::ImplantMeshes replaced(const plan::TotalHip& implant, Side side = Side::right) {
  return *sample::sample_replacement(implant, {}, sample::Scenario::one, side);
}

/// The parts of these names as one body.
Body body_with(const std::vector<plan::ImplantMesh>& meshes, const std::vector<std::string>& names) {
  TriMesh all;
  std::vector<BodyPart> parts;
  for (const auto& [part, mesh] : meshes) {
    if (std::find(names.begin(), names.end(), part) == names.end()) continue;
    parts.push_back(
        {part, all.vertices.size(), mesh.vertices.size(), all.triangles.size(), mesh.triangles.size()});
    append(all, mesh);
  }
  return {names.front(), Mesh(std::move(all)), std::move(parts)};
}

const std::vector<std::string> fixed_bone{"hip_bone"}, mobile_bone{"femur"}, fixed_implant{"liner"},
    mobile_implant{"head", "neck", "stem"}, fixed_all{"hip_bone", "liner"},
    mobile_all{"femur", "head", "neck", "stem"};

std::vector<motion::MotionLimit> limits_with(const plan::ImplantMeshes& meshes,
                                             const std::vector<std::string>& fixed,
                                             const std::vector<std::string>& mobile,
                                             Side side = Side::right) {
  const Joint joint{.name = "hip",
                    .kind = JointKind::ball,
                    .side = side,
                    .fixed = body_with(meshes.fixed, fixed),
                    .mobile = body_with(meshes.mobile, mobile)};
  return motion::RangeOfMotion(joint, {.bearing = {.rule = motion::BearingRule::count}})
      .limits(motion::hip_motions());
}

TEST(SampleReplacement, HasClosedPartsThatDoNotCrossEachOther) {
  plan::TotalHip turned;
  turned.stem_version = Angle::degrees(25), turned.offset_mm = 44, turned.leg_length_mm = 5;
  for (const plan::TotalHip& implant : {plan::TotalHip{}, turned})
    for (const Side side : {Side::right, Side::left}) {
      const plan::ImplantMeshes meshes = replaced(implant, side);
      for (const Body& body : {body_with(meshes.fixed, fixed_all), body_with(meshes.mobile, mobile_all)}) {
        EXPECT_TRUE(body.mesh.is_closed());
        EXPECT_EQ(mesh::self_crossings_of(body.mesh).pairs, 0) << body.name;
        for (const BodyPart& part : body.parts)
          EXPECT_GT(mesh::enclosed_volume(mesh_of_part(body, part.name)), 0) << part.name;
      }
    }
}

TEST(SampleReplacement, LosesTheHeadOfTheFemurAndKeepsItsTrochanter) {
  const sample::SampleHip hip = sample::sample_hip({}, sample::Scenario::one);
  const plan::ImplantMeshes meshes = replaced(plan::TotalHip{});
  const TriMesh& cut = meshes.mobile.front().mesh;
  ASSERT_EQ(meshes.mobile.front().part, "femur");
  const plan::NeckCut plane = plan::neck_cut(plan::TotalHip{}, Side::right);
  double nearest = 1e9;
  for (std::size_t v = 0; v < cut.vertices.size(); ++v) nearest = std::min(nearest, cut.vertices[v].norm());
  EXPECT_GT(nearest, plane.offset_mm - 1e-9);
  const auto top = [](const TriMesh& mesh) {
    double highest = -1e9;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
      if (mesh.vertices.z[v] > 40) highest = std::max(highest, mesh.vertices.y[v]);
    return highest;
  };
  EXPECT_DOUBLE_EQ(top(cut), top(hip.femur));
}

TEST(SampleReplacement, EndsEachMotionWhereTheFirstOfItsPartsDoes) {
  for (const Side side : {Side::right, Side::left}) {
    const plan::ImplantMeshes meshes = replaced(plan::TotalHip{}, side);
    const auto together = limits_with(meshes, fixed_all, mobile_all, side);
    const auto implant = limits_with(meshes, fixed_implant, mobile_implant, side),
               bones = limits_with(meshes, fixed_bone, mobile_bone, side),
               liner = limits_with(meshes, fixed_implant, mobile_bone, side),
               pelvis = limits_with(meshes, fixed_bone, mobile_implant, side);
    int by_bone = 0, by_implant = 0;
    for (std::size_t m = 0; m < together.size(); ++m) {
      const Angle first =
          std::min({implant[m].end.turned, bones[m].end.turned, liner[m].end.turned, pelvis[m].end.turned});
      EXPECT_NEAR(together[m].end.turned.radians(), first.radians(), 1e-9) << together[m].motion.name;
      by_bone += bones[m].end.turned < implant[m].end.turned;
      by_implant += implant[m].end.turned < bones[m].end.turned;
    }
    EXPECT_GT(by_bone, 0);
    EXPECT_GT(by_implant, 0);
  }
}

TEST(SampleReplacement, MovesTheBoneByOffsetAndLegLength) {
  plan::TotalHip longer;
  longer.leg_length_mm = 6, longer.offset_mm = 45;
  const plan::ImplantMeshes usual = replaced(plan::TotalHip{}), moved = replaced(longer);
  const auto lowest = [](const TriMesh& mesh) {
    return *std::min_element(mesh.vertices.y.begin(), mesh.vertices.y.end());
  };
  EXPECT_NEAR(lowest(moved.mobile[0].mesh), lowest(usual.mobile[0].mesh) - 6, 1e-9);
  const auto before = limits_with(usual, fixed_implant, mobile_implant),
             after = limits_with(moved, fixed_implant, mobile_implant);
  for (std::size_t m = 0; m < before.size(); ++m)
    EXPECT_NEAR(before[m].end.turned.radians(), after[m].end.turned.radians(), 1e-12)
        << before[m].motion.name;
}

TEST(SampleReplacement, RefusesACupLargerThanTheSocket) {
  plan::TotalHip large;
  large.cup_radius_mm = 30, large.offset_mm = 50;
  try {
    replaced(large);
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_STREQ(
        error.what(),
        "sample replacement: a cup of radius 30 mm is not inside the pelvis: the socket has 27.5 mm");
  }
}

}  // namespace
}  // namespace condyle::test
