#pragma once

#include <optional>
#include <string>
#include <vector>

#include "condyle/kinematics/joint.hpp"
#include "condyle/motion/first_contact.hpp"

/// Range of motion: how far a joint turns in each clinical direction before bone meets bone, where, and why.
/// docs/mathematics.md, section 6.

namespace condyle {

/// Which way the varied angle turns: flexion, adduction and internal rotation are positive.
enum class TurnSense { positive, negative };

/// A motion as a clinician names it: one joint angle turns from where `start` has it, the other two are held.
struct Motion {
  std::string name;
  JointAngle vary = JointAngle::flexion;
  TurnSense sense = TurnSense::positive;
  JointAngles start;
  Angle range;  ///< how far it may turn from its start, positive
};

/// The built-in motions of the hip, in the order in which clinicians list them: flexion, extension,
/// abduction, adduction, internal_rotation, external_rotation, the last four again with _at_90_flexion,
/// fadir, faber. Ranges are wide enough that bone, not the range, ends them on a usual hip; extension turns
/// towards negative flexion, and so on.
std::vector<Motion> hip_motions();

/// A contact point on both bodies and what touches there.
struct ContactPlace {
  Feature fixed_feature, mobile_feature;
  Vec3 fixed_point, mobile_point;  ///< mm, each in its own body's frame
};

/// Where one motion ends.
struct MotionLimit {
  Motion motion;
  Angle turned;  ///< from the start, >= 0
  LimitReason reason = LimitReason::end_of_range;
  std::optional<ContactPlace> contact;
  bool articular = false;  ///< contact inside the articular region (see ArticularRegion), not at rim or neck
  Angle shortfall;         ///< true contact is at `turned` or past it by at most this

  JointAngles angles_at_limit() const noexcept;
};

}  // namespace condyle
