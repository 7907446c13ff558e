#include "scene_poses.hpp"

#include <cmath>
#include <numbers>

#include "motion/search/first_contact.hpp"

namespace bench {
namespace {

using condyle::Angle;
using condyle::Pose;
using condyle::Vec3;

constexpr double golden_ratio = std::numbers::phi;

/// The k-th of n directions spread evenly over the part of the sphere within `half_angle` of +z: a spiral of
/// equal steps in height.
Vec3 spiral_direction(int k, int n, Angle half_angle) {
  const double lowest = std::cos(half_angle.radians());
  const double z = 1 - (1 - lowest) * (k + 0.5) / n;
  const double turn = condyle::two_pi * k / golden_ratio, rho = std::sqrt(1 - z * z);
  return {rho * std::cos(turn), rho * std::sin(turn), z};
}

/// Numbers spread evenly over [0, 1): multiples of the golden ratio.
double spread(int k) {
  return std::fmod(k / golden_ratio, 1.0);
}

Pose turned(const Vec3& axis, Angle angle) {
  return Pose(Eigen::AngleAxisd(angle.radians(), axis));
}

constexpr PoseKind kind_of(int i) {
  constexpr PoseKind in_turn[] = {PoseKind::free, PoseKind::grazing, PoseKind::deep};
  return in_turn[i % 3];
}

}  // namespace

std::vector<ScenePose> poses_to_contact(const condyle::TriMesh& fixed, const condyle::TriMesh& mobile) {
  const condyle::motion::FeatureTree fixed_tree(fixed), mobile_tree(mobile);
  condyle::motion::RotatingBody rotating(mobile_tree);
  const int axes = (poses_per_scene + 2) / 3;
  const condyle::motion::RotationRange range{.negative = Angle::radians(0), .positive = Angle::degrees(180)};

  std::vector<ScenePose> poses;
  Vec3 axis;
  Angle limit;
  for (int i = 0; i < poses_per_scene; ++i) {
    const int k = i / 3;
    if (i % 3 == 0) {
      axis = spiral_direction(k, axes, Angle::degrees(180));
      const condyle::AxisFrame frame({0, 0, 0}, axis);
      const condyle::motion::RotationTable stationary(fixed_tree, frame);
      rotating.start_at(frame, Pose::Identity());
      limit = first_contact(stationary, rotating, range).positive.turned;
    }
    const PoseKind kind = kind_of(i);
    const Angle angle = kind == PoseKind::free      ? limit * (0.2 + 0.75 * spread(k))
                        : kind == PoseKind::grazing ? limit + Angle::degrees(0.02 + 0.2 * spread(k))
                                                    : limit + Angle::degrees(5 + 20 * spread(k));
    poses.push_back({turned(axis, angle), kind});
  }
  return poses;
}

std::vector<ScenePose> poses_in_socket(double clearance_mm, const Vec3& into_socket, Angle largest_turn) {
  const Eigen::Quaterniond to_socket = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), into_socket);
  std::vector<ScenePose> poses;
  for (int i = 0; i < poses_per_scene; ++i) {
    const PoseKind kind = kind_of(i);
    const double out_mm = i % 2 == 0 ? 0 : -0.3;
    const double shift_mm = kind == PoseKind::free      ? out_mm
                            : kind == PoseKind::grazing ? clearance_mm
                                                        : clearance_mm + 0.5;
    Pose X_FM =
        turned(spiral_direction(i, poses_per_scene, Angle::degrees(180)), largest_turn * spread(i + 1));
    X_FM.translation() = shift_mm * (to_socket * spiral_direction(poses_per_scene - 1 - i, poses_per_scene,
                                                                  Angle::degrees(40)));
    poses.push_back({X_FM, kind});
  }
  return poses;
}

}  // namespace bench
