#include "condyle/hip_measures.hpp"
#include "measure/analytic_hip.hpp"
#include "mesh/subdivide.hpp"
#include "support/real_hip.hpp"
#include "support/test.hpp"
#include "support/voxelised.hpp"

/// Real hips: the values of an independent prototype, and what must not change them.

namespace condyle::measure {
namespace {

using namespace test;

std::optional<Joint> hip_libhip_m1_left() {
  const auto data = shared_data();
  if (!data) return std::nullopt;
  return Joint{"m1",
               JointKind::ball,
               Side::left,
               {"hip bone", read_ply(*data / "hip_libhip_m1_left/hip_bone.ply")},
               {"femur", read_ply(*data / "hip_libhip_m1_left/femur.ply")}};
}

#define SKIP_WITHOUT(hip) \
  if (!(hip)) GTEST_SKIP() << "no real hip in CONDYLE_DATA"

struct Published {
  const char* key;
  double value, within;
};

void expect_published(const Joint& hip, std::initializer_list<Published> values) {
  const HipMeasures m = measure_hip(hip);
  for (const auto& [key, value, within] : values) {
    const MeasureDefinition* definition = measure_definition(key);
    ASSERT_TRUE(definition) << key;
    const Measure& measure = definition->of(m);
    ASSERT_TRUE(measure.value) << key << ": " << measure.why_none;
    EXPECT_NEAR(*measure.value, value, within) << key;
  }
}

// The prototype fitted heads and shafts of its own: the ranges are its bands for 1 mm of the centre and half a millimetre of surface.
// Its alpha angles are whole degrees, of contours taken in steps. Its version 15 mm up, 23.3, is left out: the roof begins there, ours is 24.3, and 24.4 with hours four times as fine.
TEST(RealMeasures, TheVisibleHumansRightHipIsAsThePrototypeMeasuredIt) {
  const auto hip = hip_vhf_right();
  SKIP_WITHOUT(hip);
  expect_published(*hip, {{"head_radius_mm", 23.82, 0.1},
                          {"neck_shaft_angle_deg", 121.7, 1.4},
                          {"femoral_version_deg", 8.8, 2.4},
                          {"alpha_12_deg", 40, 1},
                          {"alpha_1_30_deg", 53, 1.5},
                          {"alpha_3_deg", 54, 2},
                          {"acetabular_inclination_deg", 52.0, 1.2},
                          {"acetabular_version_deg", 25.3, 1},
                          {"acetabular_version_0mm_deg", 25.3, 1},
                          {"acetabular_version_5mm_deg", 26.1, 1},
                          {"acetabular_version_10mm_deg", 26.3, 1},
                          {"centre_edge_lateral_section_deg", 32.4, 0.5},
                          {"centre_edge_anterior_section_deg", 52.5, 0.5},
                          {"head_covered_share", 0.40, 0.01},
                          {"ischiofemoral_distance_mm", 26.8, 0.1}});
}

// What there is of the shaft is short, and its axis is ours: torsion is seen along it, and 1:30 turned by it. The ranges of these two are the
// shared file's for torsion and for alpha there.
TEST(RealMeasures, TheLeftHipOfLibHipIsAsThePrototypeMeasuredItAndHasNoKnee) {
  const auto hip = hip_libhip_m1_left();
  SKIP_WITHOUT(hip);
  expect_published(*hip, {{"head_radius_mm", 26.16, 0.1},
                          {"neck_shaft_angle_deg", 131.3, 1.4},
                          {"torsion_in_frame_deg", 42, 2.4},
                          {"alpha_12_deg", 41, 1},
                          {"alpha_1_30_deg", 49, 2},
                          {"alpha_3_deg", 47, 1},
                          {"acetabular_inclination_deg", 53.7, 1.2},
                          {"acetabular_version_deg", 17.4, 1},
                          {"centre_edge_lateral_section_deg", 37.4, 0.5},
                          {"centre_edge_anterior_section_deg", 65.1, 0.5},
                          {"head_covered_share", 0.48, 0.01},
                          {"ischiofemoral_distance_mm", 19.1, 0.1}});
  // Published by its authors, by definitions that are not known: 8 degrees and 1 mm.
  expect_published(*hip, {{"neck_shaft_angle_deg", 136, 8}, {"head_radius_mm", 26.96, 1}});
  const HipMeasures m = measure_hip(*hip);
  EXPECT_FALSE(m.femur.version.value);
  EXPECT_NE(m.femur.version.why_none.find("the mesh ends above the knee"), std::string::npos);
}

TEST(RealMeasures, AlphaOfTheVisibleHumanAtThreeIsFlaggedAndElsewhereNot) {
  const auto hip = hip_vhf_right();
  SKIP_WITHOUT(hip);
  const FemurMeasures femur = measure_hip(*hip).femur;
  EXPECT_NE(femur.alpha_3.note.find("at a tolerance of 1 mm"), std::string::npos) << femur.alpha_3.note;
  EXPECT_TRUE(femur.alpha_12.note.empty());
  for (const NeckHour& hour : femur.around_neck) {
    ASSERT_TRUE(hour.alpha_deg) << hour.hour;
    EXPECT_LT(*hour.alpha_deg, 78) << hour.hour;
    EXPECT_FALSE(hour.outside_again_deg) << hour.hour;
  }
}

struct LabelMapBound {
  const char* key;
  double within;
};

TEST(RealMeasures, LabelMapsOfOneMillimetreHaveTheMeasuresOfTheirMeshes) {
  for (const auto& hip : {hip_vhf_right(), hip_libhip_m1_left()}) {
    SKIP_WITHOUT(hip);
    const VoxelGrid grid =
        grid_around(hip->fixed.mesh, hip->mobile.mesh, Eigen::Matrix3d::Identity(), Vec3(.13, .57, .91));
    Joint of_voxels = *hip;
    of_voxels.fixed = body_of("hip bone", voxelised(hip->fixed.mesh, grid));
    of_voxels.mobile = body_of("femur", voxelised(hip->mobile.mesh, grid));
    const HipMeasures a = measure_hip(*hip), b = measure_hip(of_voxels);
    for (const auto& [key, within] : {LabelMapBound{"head_radius_mm", 0.1},
                                      {"neck_shaft_angle_deg", 0.2},
                                      {"femoral_version_deg", 1},
                                      {"torsion_in_frame_deg", 1},
                                      {"acetabular_inclination_deg", 0.7},
                                      {"acetabular_version_deg", 0.7},
                                      {"centre_edge_lateral_section_deg", 0.7},
                                      {"centre_edge_anterior_section_deg", 0.7},
                                      {"centre_edge_posterior_section_deg", 0.7},
                                      {"alpha_12_deg", 2},
                                      {"alpha_1_30_deg", 2}}) {
      const Measure &x = measure_definition(key)->of(a), &y = measure_definition(key)->of(b);
      ASSERT_EQ(x.value.has_value(), y.value.has_value()) << key;
      if (x.value) {
        EXPECT_NEAR(*x.value, *y.value, within) << key;
      }
    }
  }
}

/// Largest change of any measure, and of alpha and rim at every hour.
void expect_same(const HipMeasures& a, const HipMeasures& b, double within) {
  for (const MeasureDefinition& definition : measure_definitions()) {
    const Measure &x = definition.of(a), &y = definition.of(b);
    ASSERT_EQ(x.value.has_value(), y.value.has_value()) << definition.key << y.why_none;
    if (x.value) {
      EXPECT_NEAR(*x.value, *y.value, within) << definition.key;
    }
  }
}

TEST(RealMeasures, AMirroredHipHasTheSameMeasures) {
  for (const auto& hip : {hip_vhf_right(), hip_libhip_m1_left()}) {
    SKIP_WITHOUT(hip);
    expect_same(measure_hip(*hip), measure_hip(mirrored_hip(*hip)), 1e-6);
  }
}

/// The bones in another frame of the world and back: their coordinates are rounded elsewhere.
Joint moved_and_back(const Joint& hip) {
  Pose X = Pose::Identity();
  X.linear() = Eigen::AngleAxisd(1.1, Vec3(1, -2, 3).normalized()).toRotationMatrix();
  X.translation() = Vec3(400, -250, 800);
  const auto moved = [&](const Mesh& mesh) { return posed(inverted(X), posed(X, mesh.arrays())); };
  return {
      hip.name, hip.kind, hip.side, {"hip bone", moved(hip.fixed.mesh)}, {"femur", moved(hip.mobile.mesh)}};
}

TEST(RealMeasures, ARigidMotionOfTheMeshesWithTheirFrameChangesNothing) {
  for (const auto& hip : {hip_vhf_right(), hip_libhip_m1_left()}) {
    SKIP_WITHOUT(hip);
    expect_same(measure_hip(*hip), measure_hip(moved_and_back(*hip)), 1e-6);
  }
}

// Four triangles for one leave the surface where it is, but not the head: its sphere is fitted to vertices, and its centre moves by
// 0.006 mm. Angles that are flagged move by 30 degrees with a millimetre of it.
TEST(RealMeasures, FourTrianglesForOneChangeAMeasureByLessThanAFifthUnlessItIsFlagged) {
  for (const auto& hip : {hip_vhf_right(), hip_libhip_m1_left()}) {
    SKIP_WITHOUT(hip);
    Joint fine = *hip;
    fine.fixed = {"hip bone", mesh::subdivided(hip->fixed.mesh)};
    fine.mobile = {"femur", mesh::subdivided(hip->mobile.mesh)};
    const HipMeasures a = measure_hip(*hip), b = measure_hip(fine);
    int flagged = 0;
    for (const MeasureDefinition& definition : measure_definitions()) {
      const Measure &x = definition.of(a), &y = definition.of(b);
      ASSERT_EQ(x.value.has_value(), y.value.has_value()) << definition.key << y.why_none;
      if (!x.value) continue;
      const bool is_at_3 = definition.key.starts_with("alpha_3") && hip->side == Side::right;
      const bool is_flagged = is_at_3 || definition.key.starts_with("alpha_largest");
      flagged += is_at_3;
      EXPECT_NEAR(*x.value, *y.value, is_flagged ? 0.5 : 0.2) << definition.key;
    }
    EXPECT_EQ(flagged, hip->side == Side::right ? 2 : 0);
  }
}

}  // namespace
}  // namespace condyle::measure
