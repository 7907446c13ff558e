#include "io/motion/motion_of_joint.hpp"

#include <utility>

namespace condyle::io {

ContactEntry motion_contact(ContactEntry entry, bool with_pressure) {
  if (!with_pressure && entry.casting == contact::Casting::both) entry.casting = contact::Casting::mobile;
  return entry;
}

MotionOfJoint::MotionOfJoint(const MotionQuestion& question, MotionRequest request)
    : joint_(question.joint.joint),
      surfaces_(question.surfaces),
      request_(std::move(request)),
      to_limits_(question.to_limits),
      notes_(question.motion.notes) {
  request_.names = {surfaces_.fixed.name, surfaces_.mobile.name};
  request_.casting = question.contact.casting == contact::Casting::fixed ? BodyRole::fixed : BodyRole::mobile;
  request_.rays = question.contact.rays;
  request_.ligaments = question.joint.joint.ligaments;
  if (question.with_pressure)
    layers_.emplace(surfaces_.fixed.mesh, surfaces_.mobile.mesh,
                    elastic_options(question.contact, surfaces_, question.joint));
  motion::add_new(notes_, motion_request_notes(layers(), request_));
}

std::optional<MotionAnswer> MotionOfJoint::answer(const Control& control) const {
  const contact::JointContact bodies(surfaces_.fixed.mesh, surfaces_.mobile.mesh);
  const auto limits = limits_of_poses(joint_);
  MotionRequest request = request_;
  request.limits = limits.get();
  if (to_limits_) request.nearest_limits = PoseStanding::FindNearest::always;
  auto answer = answer_motion(bodies, layers(), request, control);
  if (!answer) return std::nullopt;
  std::vector<motion::ContactNote> notes = notes_;
  motion::add_new(notes, std::move(answer->notes));
  answer->notes = std::move(notes);
  return answer;
}

}  // namespace condyle::io
