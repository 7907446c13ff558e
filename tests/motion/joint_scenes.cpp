#include "motion/joint_scenes.hpp"

#include <cmath>
#include <numbers>

#include "support/test_meshes.hpp"

namespace condyle::test {
namespace {

/// Coordinates passed on cyclically until the Z axis has become the axis of this angle.
TriMesh about_axis_of(JointAngle angle, TriMesh mesh) {
  const int steps = angle == JointAngle::flexion ? 0 : angle == JointAngle::adduction ? 1 : 2;
  for (int step = 0; step < steps; ++step) {
    std::swap(mesh.vertices.x, mesh.vertices.z);
    std::swap(mesh.vertices.y, mesh.vertices.z);
  }
  return mesh;
}

/// Every coordinate of a vertex moved along its ray by a wave of this height.
TriMesh bumpy(TriMesh mesh, const Vec3& centre, double height) {
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vec3 ray = mesh.vertices[v] - centre, u = ray.normalized();
    const double wave = std::sin(5 * u.x() + 1) * std::sin(4 * u.y() + 2) * std::sin(6 * u.z() + 3);
    mesh.vertices.set(v, centre + ray + height * wave * u);
  }
  return mesh;
}

TriMesh mirrored(TriMesh mesh) {
  for (double& z : mesh.vertices.z) z = -z;
  return flipped(std::move(mesh));
}

Joint joint_of(Side side, TriMesh fixed, TriMesh mobile) {
  return {"test joint", JointKind::ball, side, {"post", std::move(fixed)}, {"arm", std::move(mobile)}};
}

const TriMesh& arm() {
  static const TriMesh mesh = box({-arm_half_width, -100, -1}, {arm_half_width, -50, 1});
  return mesh;
}
const TriMesh& post() {
  static const TriMesh mesh = box({post_x, post_y, -5}, {60, -60, 5});
  return mesh;
}

}  // namespace

double post_limit() {
  return std::atan2(post_x, -post_y) - std::asin(arm_half_width / std::hypot(post_x, post_y));
}

PostJoint post_joint(JointAngle vary, Side side) {
  // Over the top the arm comes down on the far edge (60, -60), with its back.
  const double far_edge =
      2 * std::numbers::pi - std::atan2(60, 60) - std::asin(arm_half_width / std::hypot(60, 60));
  TriMesh fixed = about_axis_of(vary, post()), mobile = about_axis_of(vary, arm());
  Joint joint = joint_of(Side::right, std::move(fixed), std::move(mobile));
  if (side == Side::left) joint = mirrored(joint);
  return {std::move(joint), post_limit(), far_edge};
}

Joint bumpy_joint(Side side) {
  // Two posts in the opening, one on either side of the neck, stop turns about the socket's own axis.
  TriMesh fixed = bumpy(socket({0, 0, 0}, 24, 30, 3), Vec3::Zero(), 1.2);
  fixed = joined(fixed, bumpy(box({8, -34, -8}, {14, -27, -2}), {11, -30, -5}, 1));
  fixed = joined(fixed, bumpy(box({-14, -36, -3}, {-7, -26, 3}), {-10, -30, 0}, 1));
  TriMesh mobile = bumpy(sphere({0, 0, 0}, 20, 3), Vec3::Zero(), 1.5);
  // A neck through the opening, out of the middle.
  mobile = joined(mobile, bumpy(box({-4, -38, 2}, {6, -8, 12}), {1, -20, 7}, 1));
  Joint joint = joint_of(Side::right, std::move(fixed), std::move(mobile));
  return side == Side::right ? joint : mirrored(joint);
}

Joint mirrored(const Joint& joint) {
  Joint other = joint;
  other.side = joint.side == Side::right ? Side::left : Side::right;
  other.fixed.mesh = mirrored(joint.fixed.mesh);
  other.mobile.mesh = mirrored(joint.mobile.mesh);
  return other;
}

Joint overlapping_joint() {
  // The arm hangs 1 mm into a plate under it: along the ray of a corner that is a little more.
  return joint_of(Side::right, box({-20, -120, -20}, {20, -99, 20}), arm());
}

Joint ball_and_post_joint() {
  TriMesh fixed = joined(post(), sphere({0, 6, 0}, 9, 2)), mobile = joined(arm(), sphere({0, -4, 0}, 9, 2));
  return joint_of(Side::right, std::move(fixed), std::move(mobile));
}

Joint head_and_post_joint(const Vec3& offset) {
  TriMesh fixed = joined(post(), socket(Vec3::Zero(), socket_radius, 28, 4));
  TriMesh mobile = joined(arm(), sphere(offset, head_radius, 4));
  return joint_of(Side::right, std::move(fixed), std::move(mobile));
}

}  // namespace condyle::test
