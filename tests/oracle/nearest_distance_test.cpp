#include "condyle/contact_measures.hpp"
#include "condyle/joint_coordinates.hpp"
#include "condyle/sample/hip.hpp"
#include "oracle/cgal_oracle.hpp"
#include "support/test.hpp"

namespace condyle::test {
namespace {

/// Every vertex of either bone against CGAL's tree, free and in contact. Both round coordinates below 400 mm in a few
/// products: 1e-12 of them, and the square root of CGAL's squared distances, near 0, of what those round.
TEST(NearestDistance, IsWhatCgalFindsForEveryVertex) {
  const sample::SampleHip hip = sample::sample_hip({}, sample::Scenario::one);
  const contact::JointContact joint(hip.hip_bone, hip.femur);
  for (const double flexion : {0.0, 90.0, 130.0}) {
    const Pose X_FM =
        pose_at({.side = Side::right}, {Angle::degrees(flexion), Angle::degrees(3), Angle::degrees(20)});
    const contact::RadialContact contact = joint.radial(X_FM);
    const contact::ContactMeasures found = contact::measure_contact(
        joint, X_FM, contact::MeasuredContact(contact), contact::DistancesOf::all_vertices);
    const TriMesh femur_in_F = posed(X_FM, hip.femur);
    const CgalOracle oracle(hip.hip_bone);
    const auto of_mobile = oracle.distances(femur_in_F.vertices);
    const auto of_fixed = CgalOracle(femur_in_F).distances(hip.hip_bone.vertices);
    ASSERT_EQ(found.distances.mobile.size(), of_mobile.size());
    ASSERT_EQ(found.distances.fixed.size(), of_fixed.size());
    for (std::size_t v = 0; v < of_mobile.size(); ++v)
      EXPECT_NEAR(found.distances.mobile[v], of_mobile[v], 1e-9) << "femur, vertex " << v;
    for (std::size_t v = 0; v < of_fixed.size(); ++v)
      EXPECT_NEAR(found.distances.fixed[v], of_fixed[v], 1e-9) << "hip bone, vertex " << v;
    // No vertex is nearer than the surfaces are.
    const double least = std::min(*std::min_element(of_mobile.begin(), of_mobile.end()),
                                  *std::min_element(of_fixed.begin(), of_fixed.end()));
    EXPECT_LE(found.nearest.distance_mm, least + 1e-9);
    EXPECT_NEAR(found.nearest.distance_mm, oracle.surface_distance(femur_in_F), 1e-9);
    EXPECT_EQ(found.nearest.distance_mm == 0, !contact.pairs.empty());
  }
}

/// Checks real bones, posed, and surfaces whose edges are nearer to each other than any vertex is to a triangle.
TEST(NearestDistance, OfTwoSurfacesIsWhatCgalFinds) {
  FOUND_OR_SKIP(data, shared_data());
  const TriMesh hip_bone = read_ply(*data / "hip_vhf_right/hip_bone.ply"),
                femur = read_ply(*data / "hip_vhf_right/femur.ply");
  const contact::JointContact joint(hip_bone, femur);
  const CgalOracle oracle(hip_bone);
  std::size_t apart = 0, between_edges = 0;
  for (const double flexion : {0.0, 25.0, 50.0, 75.0, 100.0, 140.0}) {
    const Pose X_FM = pose_at({.side = Side::right}, {Angle::degrees(flexion), Angle(), Angle::degrees(5)});
    const TriMesh femur_in_F = posed(X_FM, femur);
    const contact::ContactMeasures found = contact::measure_contact(
        joint, X_FM, contact::MeasuredContact(joint.radial(X_FM)), contact::DistancesOf::vertices_inside);
    EXPECT_NEAR(found.nearest.distance_mm, oracle.surface_distance(femur_in_F), 1e-9) << flexion;
    apart += found.nearest.distance_mm > 0;
    const double by_vertices = std::min(oracle.min_distance(femur_in_F.vertices),
                                        CgalOracle(femur_in_F).min_distance(hip_bone.vertices));
    between_edges += found.nearest.distance_mm > 0 && found.nearest.distance_mm < by_vertices - 1e-9;
  }
  EXPECT_GT(apart, 1u);
  EXPECT_GT(between_edges, 0u);
}

}  // namespace
}  // namespace condyle::test
