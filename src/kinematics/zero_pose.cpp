#include "condyle/joint_checks.hpp"

#include <algorithm>
#include <cmath>

#include "core/rounded.hpp"
#include "kinematics/femoral_axes.hpp"
#include "kinematics/turned_leg.hpp"
#include "kinematics/wrong_set_up.hpp"

namespace condyle {
namespace {

double most_off_deg(const JointAngles& angles) noexcept {
  return std::max({std::abs(angles.flexion.degrees()), std::abs(angles.adduction.degrees()),
                   std::abs(angles.internal_rotation.degrees())});
}

/// "flexion 2.1, adduction -0.4, internal rotation -25.0 degrees".
std::string angles_text(const JointAngles& angles) {
  return "flexion " + core::rounded(angles.flexion.degrees(), 1) + ", adduction " +
         core::rounded(angles.adduction.degrees(), 1) + ", internal rotation " +
         core::rounded(angles.internal_rotation.degrees(), 1) + " degrees";
}

}  // namespace

std::string_view name_of(ZeroFrom from) noexcept {
  switch (from) {
    case ZeroFrom::as_given:
      return "as_given";
    case ZeroFrom::stated:
      return "stated";
    case ZeroFrom::landmarks:
      return "landmarks";
    case ZeroFrom::anatomy:
      break;
  }
  return "anatomy";
}

bool ZeroPose::is_turned() const noexcept {
  return from != ZeroFrom::landmarks && femur && most_off_deg(*femur) > most_off_neutral_deg;
}

bool ZeroPose::is_neutral() const noexcept {
  return !is_turned() && (from != ZeroFrom::as_given || femur);
}

ZeroPose zero_pose(const Joint& joint) {
  ZeroPose zero{.from = joint.zero_from};
  if (!joint.is_hip() || joint.kind == JointKind::hinge) return zero;
  // Parts that turn the femur turn it from where it lay.
  const Mesh& femur = joint.posed ? joint.posed->mobile.mesh : joint.mobile.mesh;
  if (const auto& axes = kinematics::femoral_axes(femur)) {
    Pose X_MN = Pose::Identity();
    X_MN.linear() = *axes;
    zero.femur = angles_at(joint.coordinates(), X_MN);
  }
  return zero;
}

std::string zero_text(const Joint& joint, const ZeroPose& zero) {
  const std::string& name = joint.mobile.name;
  const bool is_hip = joint.is_hip() && joint.kind != JointKind::hinge;
  switch (zero.from) {
    case ZeroFrom::landmarks:
      return "where the axes of both bodies coincide, by landmarks";
    case ZeroFrom::anatomy:
      return "neutral, by the condyles of " + name;
    case ZeroFrom::stated:
    case ZeroFrom::as_given:
      break;
  }
  const std::string pose = zero.from == ZeroFrom::stated ? "given by the reference pose stated"
                                                         : "the pose in which " + name + " is given";
  if (zero.femur)
    return pose +
           (zero.is_turned() ? "; by its condyles " : "; by its condyles within 5 degrees of neutral: ") +
           name + " lies at " + angles_text(*zero.femur);
  return is_hip && zero.from == ZeroFrom::as_given
             ? pose + "; it shows no condyles, and how the leg lay is not known"
             : pose;
}

namespace kinematics {

std::optional<JointNote> turned_leg_note(const Joint& joint, std::span<const JointNote> others) {
  if (std::any_of(others.begin(), others.end(),
                  [](const JointNote& note) { return is_wrong_set_up(note.code); }))
    return std::nullopt;
  const ZeroPose zero = zero_pose(joint);
  if (!zero.is_turned()) return std::nullopt;
  return JointNote{
      JointNoteCode::turned_leg,
      joint.mobile.name + " lies turned where angles are 0, by its condyles at " + angles_text(*zero.femur) +
          " from neutral: limits count from there, and the reference pose can be taken from the anatomy"};
}

}  // namespace kinematics
}  // namespace condyle
