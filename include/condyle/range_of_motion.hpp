#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/articular_region.hpp"
#include "condyle/first_contact.hpp"
#include "condyle/joint.hpp"
#include "condyle/overlap_options.hpp"

/// Range of motion: how far a joint turns in each clinical direction before bone meets bone, where, and why.
/// docs/mathematics.md, section 6.

namespace condyle {

/// A motion as a clinician names it: one joint angle changes from where `start` has it, the other two are held.
struct Motion {
  std::string name = {};
  JointAngle vary = JointAngle::flexion;
  RotationSense sense = RotationSense::positive;
  JointAngles start = {};
  Angle range = {};  ///< how far it may turn from its start, positive
};

/// The built-in motions of the hip, in the order in which clinicians list them: flexion, extension,
/// abduction, adduction, internal_rotation, external_rotation, the last four again with _at_90_flexion,
/// fadir, faber. Ranges are wide enough that bone, not the range, ends them on a usual hip; extension turns
/// towards negative flexion, and so on.
///
///     flexion            0 to 180      extension           0 to 90
///     abduction          0 to 90       adduction           0 to 90      (at 90 degrees the gimbal pose)
///     internal_rotation  0 to 120      external_rotation   0 to 120
///     fadir              flexion 90, adduction 15, internal rotation 0 to 120
///     faber              flexion 45, abduction 45, external rotation 0 to 120
///
/// The two tests are bedside manoeuvres without agreed angles: these are this library's definitions, written
/// here so that they can be cited and, under the same names, replaced.
std::vector<Motion> hip_motions();

/// The built-in motions of a hinge: flexion and extension, 0 to 180 degrees each.
std::vector<Motion> hinge_motions();

/// Those of this kind of joint.
std::vector<Motion> built_in_motions(JointKind kind);

/// Built-in motions with the user's: one of a known name replaces it in its place, others follow in order.
std::vector<Motion> with_own_motions(std::vector<Motion> built_in, std::span<const Motion> own);

/// The motion of that name. Throws UsageError with the names there are.
const Motion& motion_named(std::span<const Motion> motions, std::string_view name);

/// Throws UsageError where this kind of joint has no such motion: a range that is not above 0 and at
/// most a full turn, an angle that is not finite, or a hinge turned or held in another angle than flexion.
void check_motion(const Motion& motion, JointKind kind);

/// Where one motion ends.
struct MotionLimit {
  Motion motion = {};
  Limit end = {};

  JointAngles angles_at_limit() const noexcept;
};

/// These angles with one of them changed by `by`.
JointAngles turned_by(JointAngles from, JointAngle angle, Angle by) noexcept;

/// This angle of the three.
Angle angle_of(const JointAngles& angles, JointAngle angle) noexcept;

struct RangeOptions {
  /// Contacts in here are labelled articular; find_articular_region() where not stated.
  std::optional<ArticularRegion> articular = {};
  OverlapOptions overlap = {};
};

/// A joint made ready for motions: exact limits, each from tables that are built once.
///
/// Changing one joint angle rotates one body about an axis that is constant in the other (section 6), so the
/// body in which the axis is constant carries the table and the other one turns:
///
///     varied             axis             table on                     turning body
///     flexion            e1, in F         F, once                      M, from the pose
///     internal rotation  e3, in M         M, once                      F, from the inverse pose, about -e3
///     adduction          e2, in neither   F, once per flexion value    M, from the pose
///
/// With F turning instead of M, contact is reported the same: features and points say fixed and mobile.
///
/// Guarantee: as of FirstContact, for the vertices of the turning body as rounded into the frame of the axis:
/// never past a contact, short of one by at most `error_bound`. All limits of one joint and pose are the same
/// bits on any thread and in any order.
class RangeOfMotion {
 public:
  /// The joint's meshes are borrowed only here. Throws ReferenceContactError where the bodies are in contact in
  /// the reference pose and the options say nothing about it: the message explains what can be done and names
  /// the deepest vertex.
  explicit RangeOfMotion(const Joint& joint, const RangeOptions& options = {});
  ~RangeOfMotion();
  RangeOfMotion(const RangeOfMotion&) = delete;
  RangeOfMotion& operator=(const RangeOfMotion&) = delete;

  /// Throws UsageError where check_motion() does.
  MotionLimit limit(const Motion& motion) const;
  /// The same for many, in their order, on all threads.
  std::vector<MotionLimit> limits(std::span<const Motion> motions) const;

  /// How far one angle changes from this start either way. The start must be finite, the range as
  /// RotationRange says, and on a hinge flexion is the only angle. May be called from any thread.
  RotationLimits both_limits(JointAngle vary, const JointAngles& start, const RotationRange& range) const;

  JointKind kind() const noexcept;
  Side side() const noexcept;
  /// What contacts are labelled by; empty where it was not stated and no head was found: nothing is then
  /// called articular.
  const std::optional<ArticularRegion>& articular_region() const noexcept;
  /// How much of each body the options leave out.
  const LeftOut& left_out() const noexcept;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace condyle
