#include "io/model/joint_axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <vector>

#include "core/trigonometry.hpp"
#include "io/file/in_quotes.hpp"
#include "io/model/spatial_transform.hpp"

namespace condyle::io {
namespace {

/// Axes that a modeller lays along a bone's function are within 10 degrees of the body's in knees (Rajagopal et al. 2016).
constexpr double most_off_deg = 30;

/// Frames that stand upright are nearer to it than to any other.
constexpr double upright_deg = 45;

/// Joints from the ground to a body: more than any model of a person has, so that a long chain costs no square.
constexpr int most_joints_above = 200;

/// The angle between an axis of a frame and its namesake of another, for the axis that is farthest off.
double farthest_axis_deg(const Eigen::Matrix3d& R) {
  return core::arccosine(std::clamp(R.diagonal().minCoeff(), -1.0, 1.0)) * 180 / std::numbers::pi;
}

/// S with columns along axes of a frame, right-handed, for which R S is nearest to the identity. The identity itself before
/// others as near.
Eigen::Matrix3d nearest_renaming(const Eigen::Matrix3d& R) {
  constexpr double as_near = 1e-9;
  Eigen::Matrix3d nearest = Eigen::Matrix3d::Identity();
  for (int x = 0; x < 6; ++x)
    for (int y = 0; y < 6; ++y) {
      if (x % 3 == y % 3) continue;
      Eigen::Matrix3d S = Eigen::Matrix3d::Zero();
      S(x % 3, 0) = x < 3 ? 1 : -1;
      S(y % 3, 1) = y < 3 ? 1 : -1;
      S.col(2) = S.col(0).cross(S.col(1));
      if ((R * S).trace() > (R * nearest).trace() + as_near) nearest = S;
    }
  return nearest;
}

bool turns_about_own_axes(const SpatialTransform& axes) {
  constexpr double along = 1 - 1e-6;  // cosine: 0.1 degrees
  return std::all_of(axes.begin(), axes.begin() + 3, [](const TransformAxis& axis) {
    return axis.coordinates.empty() || axis.axis.cwiseAbs().maxCoeff() > along;
  });
}

}  // namespace

StandingModel::StandingModel(const Model& model) : model_(model) {
  for (const ModelJoint& joint : model.joints)
    if (joint.transform && !above_.contains(joint.child_body))
      above_.emplace(
          joint.child_body,
          Above{joint.parent_body, pose_of(joint, std::vector<double>(joint.coordinates.size())).linear()});
}

std::optional<Eigen::Matrix3d> StandingModel::rotation(std::string_view body) const {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  for (int joints = 0; joints <= most_joints_above; ++joints) {
    if (body == "ground") return R;
    const auto above = above_.find(body);
    if (above == above_.end()) return std::nullopt;
    R = above->second.R_PB * R;
    body = above->second.parent;
  }
  return std::nullopt;
}

bool StandingModel::has_bodies_of_a_scanner() const {
  if (of_a_scanner_) return *of_a_scanner_;
  int turned_bodies = 0;
  for (const ModelJoint& joint : model_.joints) {
    if (!joint.transform || joint.parent_body == "ground") continue;
    const auto R_GP = rotation(joint.parent_body);
    if (!R_GP) continue;
    const Eigen::Matrix3d& R_PF = joint.X_PF.linear();
    const bool in_body = farthest_axis_deg(R_PF) <= upright_deg,
               in_ground = farthest_axis_deg(*R_GP * R_PF) <= upright_deg;
    turned_bodies += (in_ground && !in_body) - (in_body && !in_ground);
  }
  of_a_scanner_ = turned_bodies > 0;
  return *of_a_scanner_;
}

std::string_view nearest_axis(const Vec3& direction) {
  constexpr std::string_view names[2][3] = {{"X, forwards", "Y, up", "Z, to the right"},
                                            {"-X, backwards", "-Y, down", "-Z, to the left"}};
  int axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  return names[direction[axis] < 0][axis];
}

JointAxes axes_of(const StandingModel& model, const ModelJoint& joint) {
  const Eigen::Matrix3d& R_PF = joint.X_PF.linear();
  const std::string body = in_quotes(joint.parent_body);
  JointAxes axes;
  const auto R_GP = model.rotation(joint.parent_body);
  if (R_GP && farthest_axis_deg(*R_GP) > upright_deg && model.has_bodies_of_a_scanner()) {
    axes.R_PB = R_GP->transpose();
    axes.turned = fmt::format(
        "an axis of body {} is {:.0f} degrees from the ground's in the standing model, and frames of joints "
        "are not: angles are named by the ground's axes",
        body, farthest_axis_deg(*R_GP));
  }
  const Eigen::Matrix3d R_BF = axes.R_PB.transpose() * R_PF, S = io::nearest_renaming(R_BF);
  const double off = farthest_axis_deg(R_BF * S);
  constexpr double same = 1e-6;
  const bool is_far = off > most_off_deg;
  if (off <= same || (!is_far && io::turns_about_own_axes(joint.transform->axes))) {
    axes.R_PA = R_PF * S, axes.R_FA = S;
    if (axes.turned.empty() && !S.isIdentity(0))
      axes.turned = fmt::format(
          "the joint's frame is turned in body {}, its X along {}, its Y along {} and its Z along {}: angles "
          "are named by the body's axes",
          body, nearest_axis(R_PF.col(0)), nearest_axis(R_PF.col(1)), nearest_axis(R_PF.col(2)));
    return axes;
  }
  axes.R_PA = axes.R_PB, axes.R_FA = R_PF.transpose() * axes.R_PB;
  if (axes.turned.empty() && is_far)
    axes.turned = fmt::format(
        "an axis of the joint's frame is {:.0f} degrees from any of body {}: angles are about the body's "
        "axes, X anterior, Y superior and Z to the right",
        off, body);
  return axes;
}

}  // namespace condyle::io
