#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/bearing.hpp"
#include "condyle/first_contact.hpp"
#include "condyle/joint.hpp"
#include "condyle/overlap_options.hpp"

/// Range of motion: how far a joint turns in each clinical direction before bone meets bone, where, and why.
/// docs/mathematics/06-range-of-motion.md.

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

/// The built-in motions of a joint that is no hinge: hip_motions(), and for other joints each of its angles in both
/// senses (an angle without known range turns by 90 or 120 degrees at most), rotation again _at_90_flexion if it
/// flexes.
///
///     knee      flexion 0 to 180, extension, adduction, abduction, internal_rotation, external_rotation
///     ankle     dorsiflexion, plantarflexion, inversion, eversion, internal_rotation, external_rotation
///     elbow     flexion 0 to 180, extension, varus, valgus, pronation and supination 0 to 180
///     shoulder  abduction and flexion 0 to 180, extension 0 to 90: elevation in the planes 0, 90 and -90 degrees;
///               horizontal_flexion and _extension: the plane of elevation from 0 at elevation 90; rotations, and again
///               _at_90_abduction
///
/// A hinge has the two of its first angle, 0 to 180 degrees each. Normal ranges are known here of hips only.
std::vector<Motion> built_in_motions(JointKind kind, Anatomy joint);

/// Built-in motions with the user's: one of a known name replaces it in its place, others follow in order.
std::vector<Motion> with_own_motions(std::vector<Motion> built_in, std::span<const Motion> own);

/// The motion of that name; where none has it as written, the first that has it in any case, with blanks or hyphens for
/// underscores. Throws UsageError with the names there are.
const Motion& motion_named(std::span<const Motion> motions, std::string_view name);

/// Throws UsageError if this kind of joint has no such motion: a range that is not above 0 and at
/// most a full turn, an angle that is not finite, or a hinge turned or held in another angle than flexion.
void check_motion(const Motion& motion, JointKind kind);

/// Angles between which nothing meets.
struct FreeInterval {
  Angle low, high;  ///< of the varied angle less its start: low <= high, both in the range
  /// `turned` of either is measured from `start` in its sense if the start is in the interval, else from the
  /// interval's middle. Either ends by contact or at the end of the range.
  Limit at_low, at_high;

  bool holds_start() const noexcept { return low <= Angle() && high >= Angle(); }
};

/// All angles of one joint angle that are free.
struct FreeAngles {
  RotationLimits from_start;
  std::vector<FreeInterval> intervals;  ///< ascending

  /// The one that holds the start, else the nearest to it, the lower of two as near; null if nothing is free.
  const FreeInterval* nearest_to_start() const noexcept;
};

/// How a head lies in its socket where a motion ends.
struct HeadAtLimit {
  /// Between the centres of head and socket, mm; empty if no socket was fitted.
  std::optional<double> centre_distance_mm;
  /// The smallest distance between the bearing surface and the fixed body, mm; 0 if they meet, empty where bearing
  /// contact counts.
  std::optional<double> joint_space_mm;
};

/// Where one motion ends.
struct MotionLimit {
  Motion motion = {};
  Limit end = {};
  std::optional<HeadAtLimit> head = {};  ///< where a bearing surface is known

  JointAngles angles_at_limit() const noexcept;
};

/// These angles with one of them changed by `by`.
JointAngles turned_by(JointAngles from, JointAngle angle, Angle by) noexcept;

/// This angle of the three.
Angle angle_of(const JointAngles& angles, JointAngle angle) noexcept;

struct RangeOptions {
  BearingOptions bearing = {};
  OverlapOptions overlap = {};
};

/// A joint made ready for motions: exact limits, each from tables that are built once.
///
/// Changing one joint angle rotates one body about an axis that is constant in the other (section 6), so the body in
/// which the axis is constant carries the table and the other one rotates:
///
///     varied             axis             table on                     rotating body
///     flexion            e1, in F         F, once                      M, from the pose
///     internal rotation  e3, in M         M, once                      F, from the inverse pose, about -e3
///     adduction          e2, in neither   F, once per flexion value    M, from the pose
///
/// With F rotating instead of M, contact is reported the same: features and points say fixed and mobile.
///
/// If a bearing surface is known (find_bearing_surface) and does not count, a limit is the first contact of the rest
/// of the mobile body, exactly, and the limit also reports bearing contact before it. The rest is an open surface:
/// the fixed body is not noticed inside of it.
///
/// Guarantee: as of FirstContact, for the vertices of the rotating body as rounded into the frame of the axis:
/// never past a contact, short of one by at most `error_bound`. All limits of one joint and pose are the same
/// bits on any thread and in any order.
class RangeOfMotion {
 public:
  /// Throws ReferenceContactError if the bodies are in contact in the reference pose and the options say nothing
  /// about it: the message explains what can be done and names the deepest vertex. Contact that does not count is
  /// none.
  explicit RangeOfMotion(const Joint& joint, const RangeOptions& options = {});
  ~RangeOfMotion();
  RangeOfMotion(const RangeOfMotion&) = delete;
  RangeOfMotion& operator=(const RangeOfMotion&) = delete;

  /// Throws UsageError if check_motion() does.
  MotionLimit limit(const Motion& motion) const;
  /// The same for many, in their order, on all threads.
  std::vector<MotionLimit> limits(std::span<const Motion> motions) const;

  /// How far one angle changes from this start in either sense. The start must be finite, the range as RotationRange
  /// says, and on a hinge flexion is the only angle. May be called from any thread.
  RotationLimits both_limits(JointAngle vary, const JointAngles& start, const RotationRange& range) const;

  /// All intervals of one angle that are free within the range: the one that holds the start, if the start is free,
  /// has the limits of both_limits(); others lie beyond contact. Intervals below 1e-9 rad are none. Some milliseconds
  /// if the fixed mesh is closed, else more. Throws UsageError for a range of more than half a turn in either sense.
  /// May be called from any thread.
  FreeAngles free_angles(JointAngle vary, const JointAngles& start, const RotationRange& range) const;

  JointKind kind() const noexcept;
  CoordinateSystem coordinates() const noexcept;
  /// The bearing surface, or why there is none and everything counts.
  const BearingFinding& bearing() const noexcept;
  BearingRule bearing_rule() const noexcept;
  /// How much of each body the overlap options leave out.
  const LeftOut& left_out() const noexcept;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace condyle
