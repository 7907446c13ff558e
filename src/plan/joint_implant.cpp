#include <algorithm>
#include <cmath>
#include <string>

#include "condyle/implant.hpp"
#include "kinematics/posed_parts.hpp"
#include "plan/implant_shape.hpp"

namespace condyle::plan {
namespace {

/// Off the centre by no more than rounding.
constexpr double centred_mm = 1e-9;

/// Whether the body has this mesh, which is all of a body that is one mesh.
bool has_mesh(const Body& body, std::string_view mesh) {
  return body.parts.empty() || std::any_of(body.parts.begin(), body.parts.end(),
                                           [&](const BodyPart& part) { return part.name == mesh; });
}

bool is_rotation_about_centre(const Eigen::Affine3d& motion) {
  return motion.translation().norm() <= centred_mm &&
         (motion.linear().transpose() * motion.linear()).isIdentity(1e-12);
}

std::span<const PosedPart> parts_of(const Joint& joint) {
  return joint.posed ? std::span<const PosedPart>(joint.posed->parts) : std::span<const PosedPart>();
}

}  // namespace

JointImplant implant_in_joint(const Implant& implant, const Joint& joint) {
  const bool is_hip = std::holds_alternative<TotalHip>(implant);
  const char *fixed = is_hip ? "liner" : "pillar", *mobile = is_hip ? "neck" : "liner";
  JointImplant found{joint.fixed.parts.empty() ? "" : fixed, joint.mobile.parts.empty() ? "" : mobile};
  if (is_hip) found.cup_axis = plan::axes_of(implant, joint.side).liner;
  for (const auto& [body, mesh] : {std::pair{&joint.fixed, fixed}, {&joint.mobile, mobile}})
    if (!has_mesh(*body, mesh)) {
      found.why_no_pair = body->name + " has no mesh called " + mesh;
      return found;
    }
  found.pair = revolved_pair(implant, joint.side);
  found.why_no_pair = why_not_revolved(implant);
  return found;
}

std::optional<CupAngles> cup_angles(const Joint& joint, CupDefinition definition) {
  if (!joint.implant || !joint.implant->cup_axis) return std::nullopt;
  const Eigen::Affine3d motion =
      kinematics::motion_of_mesh(parts_of(joint), joint.side, BodyRole::fixed, joint.implant->fixed_mesh);
  return cup_angles(motion.linear() * *joint.implant->cup_axis, definition, joint.side);
}

ClosedForm closed_form(const Joint& joint) {
  return closed_form(joint, parts_of(joint));
}

ClosedForm closed_form(const Joint& joint, std::span<const PosedPart> parts) {
  if (!joint.implant) return {};
  const JointImplant& implant = *joint.implant;
  if (!implant.pair) return {std::nullopt, implant.why_no_pair};
  if (joint.kind != JointKind::ball) return {std::nullopt, "the centre of the joint is not held"};
  const auto moved = [&](BodyRole role, const std::string& mesh) {
    return kinematics::motion_of_mesh(parts, joint.side, role, mesh);
  };
  const Eigen::Affine3d fixed = moved(BodyRole::fixed, implant.fixed_mesh),
                        mobile = moved(BodyRole::mobile, implant.mobile_mesh);
  if (!is_rotation_about_centre(fixed) || !is_rotation_about_centre(mobile))
    return {std::nullopt,
            "a part shifts or scales the implant, whose axes then do not meet in the joint centre"};
  RevolvedPair pair = *implant.pair;
  pair.fixed_axis = fixed.linear() * pair.fixed_axis;
  pair.mobile_axis = mobile.linear() * pair.mobile_axis;
  return {pair, {}};
}

}  // namespace condyle::plan
