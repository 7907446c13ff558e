#include "io/picture/surface_values.hpp"
#include "mesh/surface_distance.hpp"
#include "support/test.hpp"

namespace condyle::test {
namespace {

/// A ball that runs into the side of its socket.
const Pose X_FM(Eigen::Translation3d(1, 1.5, 0));

Joint ball_in_socket() {
  return {"ball",
          JointKind::free,
          Side::right,
          {"fixed", socket(Vec3::Zero(), 10, 14, 5)},
          {"mobile", sphere(Vec3::Zero(), 9, 5)}};
}

TEST(PictureValues, OfNearestDistancesAreThoseOfEveryVertex) {
  const Joint joint = ball_in_socket();
  const io::BothValues values = io::surface_values(io::PictureColour::nearest, joint, {}, X_FM);
  const mesh::SurfaceDistance to_fixed(joint.fixed.mesh);
  std::size_t inside = 0;
  for (std::size_t v = 0; v < values.mobile.mm.size(); ++v) {
    EXPECT_EQ(std::abs(values.mobile.mm[v]), to_fixed(posed(X_FM, joint.mobile.mesh.vertices()[v])));
    inside += values.mobile.mm[v] < 0;
  }
  EXPECT_GT(inside, 0u);
  EXPECT_LT(inside, values.mobile.mm.size());
}

TEST(PictureValues, OfDepthsMeasureHowFarOutsideOnlyBesideTheInside) {
  const Joint joint = ball_in_socket();
  const auto& near = io::surface_values(io::PictureColour::nearest, joint, {}, X_FM).mobile.mm;
  const io::BothValues values = io::surface_values(io::PictureColour::depth, joint, {}, X_FM);
  const auto& outside = values.mobile.outside;
  std::size_t measured = 0;
  for (const Triangle& triangle : joint.mobile.mesh.triangles()) {
    const bool is_outside =
        std::all_of(triangle.begin(), triangle.end(), [&](Index v) { return near[v] > 0; });
    for (const Index v : triangle)
      if (is_outside)
        EXPECT_GT(outside[v], 0);
      else
        EXPECT_EQ(outside[v], near[v]);
  }
  for (std::size_t v = 0; v < near.size(); ++v) measured += outside[v] == near[v];
  EXPECT_GT(measured, 10u);
  EXPECT_LT(measured, near.size() / 2);
}

TEST(PictureValues, OfArcsAreAboutTheirAxis) {
  const Joint joint = ball_in_socket();
  const contact::AxisLine axis{{0.2, 0, 1}, {-4, 9, 0}};
  const auto arcs = contact::JointContact(joint).tangential(X_FM, axis).mobile_in_fixed;
  const auto values = io::surface_values(io::PictureColour::depth, joint, {}, X_FM, axis).mobile;
  for (std::size_t v = 0; v < values.mm.size(); ++v) {
    const bool is_inside = arcs->state[v] == PointState::inside,
               is_freed = std::isfinite(arcs->arc_gap_mm[v]);
    EXPECT_EQ(values.is_bound[v] != 0, is_inside && !is_freed) << v;
    EXPECT_EQ(values.mm[v], !is_inside ? 0 : is_freed ? -arcs->arc_gap_mm[v] : -values.outside[v]) << v;
  }
  EXPECT_GT(*std::max_element(values.mm.begin(), values.mm.end()), 0.5);
}

}  // namespace
}  // namespace condyle::test
