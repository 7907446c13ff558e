#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/bearing.hpp"
#include "condyle/error.hpp"
#include "condyle/first_contact.hpp"
#include "condyle/joint.hpp"

/// Range of motion: how far a joint turns in each clinical direction before bone meets bone, where, and why.
/// docs/mathematics/06-range-of-motion.md.

namespace condyle::motion {

// Meshes that are in contact in the reference pose, as segmented ones often are, and what can be done about
// it. Never done silently, and never by moving a mesh.

/// Treatment of two bodies that are in contact in the reference pose.
enum class ReferenceContact : std::uint8_t {
  refuse,  ///< ReferenceContactError: what can be done, and the place of greatest depth
  accept,  ///< motions that start in contact are reported as such
};

/// Leaves out the triangles of each body that meet the other body in the reference pose, and with them `rings`
/// rings of neighbours: triangles that share a vertex with one left out, then with one of those, and so on.
/// With no ring only the crossing triangles go, and their neighbours, which barely clear each other, end most
/// motions at once.
struct LeaveOutReferenceContacts {
  int rings = 2;
};

/// Triangles excluded from contact. Triangles left out leave open meshes, and an open mesh has no inside: a body
/// wholly swallowed by the other one is then not noticed at the start of a motion, and a vertex deep in the hole
/// meets nothing. Everything else about the limits stays exact.
struct OverlapOptions {
  /// The pose in which the meshes are known: checked for contact, and the pose in which contacts are left out.
  JointAngles reference_pose = {};
  ReferenceContact reference_contact = ReferenceContact::refuse;
  std::optional<LeaveOutReferenceContacts> leave_out_reference_contacts = {};
};

/// How many triangles of each body the overlap options leave out.
struct LeftOut {
  std::size_t fixed_triangles = 0, mobile_triangles = 0;
};

/// Bodies in contact in the reference pose although the options do not cover it.
class ReferenceContactError : public MeshError {
 public:
  using MeshError::MeshError;
};

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
[[nodiscard]] std::vector<Motion> hip_motions();

/// The built-in motions of a joint that is no hinge: hip_motions(), and for other joints each of its angles in both
/// senses (an angle without known range turns by 90 or 120 degrees at most), rotation again _at_90_flexion if it
/// flexes.
///
///     knee      flexion 0 to 180, extension, adduction, abduction, internal_rotation, external_rotation
///     ankle     dorsiflexion, plantarflexion, inversion, eversion, internal_rotation, external_rotation
///     elbow     flexion 0 to 180, extension, varus, valgus, pronation and supination 0 to 180
///     shoulder  abduction and flexion 0 to 180, extension 0 to 90: elevation from where the arm hangs, in the planes
///               0, 90 and -90 degrees with internal rotation held at 0, -90 and 90; horizontal_flexion and _extension:
///               the plane of elevation from 0 at elevation 90; rotations, and again _at_90_abduction
///
/// Abduction, flexion and extension of a shoulder are rotations about the X axis and, either way, about the Z axis, and begin
/// with the identity: the arm is not turned about its own axis on the way. The horizontal motions begin where 90 degrees of
/// abduction end, and are rotations about the Y axis.
///
/// A hinge has the two of its first angle, 0 to 180 degrees each. Normal ranges are known here of hips only: those that are
/// published of shoulders are of the arm against the trunk, to which the scapula adds.
[[nodiscard]] std::vector<Motion> built_in_motions(JointKind kind, Anatomy joint);

/// Built-in motions with the user's: one of a known name replaces it in its place, others follow in order.
[[nodiscard]] std::vector<Motion> with_own_motions(std::vector<Motion> built_in, std::span<const Motion> own);

/// The motion of that name; where none has it as written, the first that has it in any case, with blanks or hyphens for
/// underscores. Throws UsageError that lists the valid names.
[[nodiscard]] const Motion& motion_named(std::span<const Motion> motions, std::string_view name);

/// Throws UsageError if this kind of joint has no such motion: a range that is not above 0 and at
/// most a full turn, an angle that is not finite, or a hinge turned or held in another angle than flexion.
void check_motion(const Motion& motion, JointKind kind);

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
  /// Translation at the limit, x, y and z of its frame; only of a joint whose centre is not held.
  std::optional<Vec3> translation_mm = {};
  /// The record or load of its translation ends at the limit, before the motion's range: the joint may turn farther.
  bool translation_ends = false;

  [[nodiscard]] JointAngles angles_at_limit() const noexcept;
};

/// Side of the joint centre, seen along the joint's Z.
enum class ContactSide : std::uint8_t { superior, anterior, inferior, posterior };

/// As in files: "superior".
[[nodiscard]] std::string_view name_of(ContactSide side) noexcept;

/// On which side of a shoulder's centre a motion ended in contact that is no bearing contact: superior, where the acromion is, anterior
/// (coracoid process), inferior (lower rim and neck of the scapula: notching) or posterior; the nearest of the four. Empty for other
/// joints, without a contact point, and for one that lies within 30 degrees of the joint's Z.
[[nodiscard]] std::optional<ContactSide> contact_side(const Joint& joint, const MotionLimit& limit) noexcept;

/// These angles with one of them changed by `by`.
[[nodiscard]] JointAngles turned_by(JointAngles from, JointAngle angle, Angle by) noexcept;

/// The end of a motion that is nearest to a pose: of each angle alone, in either sense.
struct NearestEnd {
  Limit end;
  JointAngle vary;
  RotationSense sense;
};

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
  /// The same joint with the vertices of one body elsewhere, one for each of its mesh's, mm, in its frame: as of a bone that was
  /// cut. What contact of each triangle means stays as it was found, whatever is in contact in the reference pose. Limits
  /// are those of a joint made anew with these roles, but for which pair is named where a motion starts in contact; tables of the
  /// other body are shared, not made again. Linear in the mesh of the
  /// moved body. Throws MeshError as Mesh::moved_to().
  RangeOfMotion(const RangeOfMotion& before, BodyRole moved, const Points& vertices);
  /// The same joint with both bodies and their ligaments shifted in their frames, mm: as about another centre. Linear in both meshes.
  RangeOfMotion(const RangeOfMotion& before, const Vec3& fixed_by, const Vec3& mobile_by);
  ~RangeOfMotion();
  RangeOfMotion(const RangeOfMotion&) = delete;
  RangeOfMotion& operator=(const RangeOfMotion&) = delete;

  /// Throws UsageError if check_motion() does.
  [[nodiscard]] MotionLimit limit(const Motion& motion) const;
  /// The same for many, in their order, on all threads.
  [[nodiscard]] std::vector<MotionLimit> limits(std::span<const Motion> motions) const;

  /// How far one angle changes from this start in either sense. The start must be finite, the range as RotationRange
  /// says, and on a hinge flexion is the only angle. May be called from any thread.
  [[nodiscard]] RotationLimits both_limits(JointAngle vary, const JointAngles& start,
                                           const RotationRange& range) const;

  /// All intervals of one angle that are free within the range: the one that holds the start, if the start is free,
  /// has the limits of both_limits(); others lie beyond contact. Intervals below 1e-9 rad are none. Some milliseconds
  /// if the fixed mesh is closed, else more. Throws UsageError for a range of more than half a turn in either sense.
  /// May be called from any thread.
  [[nodiscard]] FreeAngles free_angles(JointAngle vary, const JointAngles& start,
                                       const RotationRange& range) const;

  /// All positions of the mobile body along a direction of F, of any length but zero, that are free within the range about a pose;
  /// guarantee as of motion::free_slides. Bearing contact ends a slide, whatever the rule for motions: a head does not slide into its
  /// socket. Soft meshes and ligaments end none. Linear in both meshes. May be called from any thread.
  [[nodiscard]] FreeSlides free_slides(const Vec3& direction_F, const Pose& X_FM,
                                       const SlideRange& range) const;

  /// The least rotation that brings one angle to an end that contact or a ligament makes, within half a turn; empty if there is none. At a
  /// start that is not free it says so, turned by 0. Makes ready only what its searches look at. Throws MeshError as limit().
  [[nodiscard]] std::optional<NearestEnd> nearest_end(const JointAngles& start) const;
  /// The end behind a start that is beyond one: one angle turned back so far frees it. Turned by 0, as rounding may put that end just after
  /// the start. Empty where no angle does. Costs and throws as nearest_end().
  [[nodiscard]] std::optional<NearestEnd> end_behind(const JointAngles& start, Angle within) const;
  /// The smallest distance of surfaces whose contact ends a motion, mm, 0 if they meet: of a hip between the bone beside its head and the hip
  /// bone. In any pose of M in F.
  [[nodiscard]] double clearance_mm(const Pose& X_FM) const;
  /// False if no rotation about the mobile body's origin by so much brings the joint to an end from a pose with this clearance: no point
  /// moves that far. Linear in the fixed vertices.
  [[nodiscard]] bool may_end_within(Angle turn, const Vec3& origin_F, double clearance_mm) const;

  [[nodiscard]] JointKind kind() const noexcept;
  [[nodiscard]] CoordinateSystem coordinates() const noexcept;
  [[nodiscard]] TranslationFrame translation_frame() const noexcept;
  /// The bearing surface, or why there is none and everything counts.
  [[nodiscard]] const BearingFinding& bearing() const noexcept;
  [[nodiscard]] BearingRule bearing_rule() const noexcept;
  /// How much of each body the overlap options leave out.
  [[nodiscard]] const LeftOut& left_out() const noexcept;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// How far a joint follows a path on which several angles change at once.

/// Where a path ends.
struct PathLimit {
  std::size_t segment = 0;  ///< from waypoint `segment` to the next one
  double fraction = 0;      ///< of that segment, in [0, 1]
  JointAngles at = {};
  LimitReason reason = LimitReason::end_of_range;
  /// For `contact`, the two faces that are nearest to meeting and their nearest points.
  std::optional<ContactWitness> contact = {};
  double distance_mm = 0;  ///< between these points
  std::size_t poses = 0;   ///< evaluated along the path
};

/// Follows paths of straight segments in the joint's angles. Several angles that change at once are a rotation
/// about no fixed axis, so there is no closed form; instead every step is as long as is certain to be free.
///
///     angle b          o waypoint 2
///       |     .  .   .
///       |   o  waypoint 1         steps shorten where surfaces come near:   o--------+---+--+-|
///       | .
///       o waypoint 0
///
/// On one segment the angles change by df, da, dr. With e1 and e3 at a right angle to e2, M turns by at most
/// W = sqrt(da^2 + (|df| + |dr|)^2) over the segment, so from a pose from which no rotation below c brings
/// anything together the next c / W of the segment are free.
///
/// Guarantee: the path is free up to the limit, whatever the surfaces do between two poses. The search ends if c
/// falls below the tolerance: a rotation by no more than that, about some axis, might then bring the surfaces
/// together, though not always the path itself: surfaces that pass that close count as in contact. A path along only
/// one angle is better computed as a motion, which is exact.
class PathFinder {
 public:
  /// Throws as RangeOfMotion does.
  explicit PathFinder(const Joint& joint, const RangeOptions& options = {});
  ~PathFinder();
  PathFinder(const PathFinder&) = delete;
  PathFinder& operator=(const PathFinder&) = delete;

  /// Throws UsageError for fewer than two waypoints, angles that are not finite, segments of more than a full
  /// turn, other angles than flexion on a hinge, or a tolerance below 1e-6 degrees.
  [[nodiscard]] PathLimit limit(std::span<const JointAngles> waypoints,
                                Angle tolerance = Angle::degrees(1e-3)) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// How far a free joint turns whose centre is not held: its translation follows the angle that varies.

/// Where the mobile body's origin is once an angle has turned so far from a motion's start.
struct TranslationKnot {
  Angle turned = {};                   ///< >= 0 in the motion's sense
  Vec3 translation_mm = Vec3::Zero();  ///< x, y and z of the joint's translation frame
};

/// Gives the knots of one motion, the first at its start, each farther than the one before; empty where it ends. Called with those
/// given so far.
using NextKnot = std::function<std::optional<TranslationKnot>(std::span<const TranslationKnot> before)>;

struct FollowedLimit {
  MotionLimit limit = {};  ///< its range is as far as the knots go
  double distance_mm = 0;  ///< between the surfaces that end it, at the limit
  std::size_t poses = 0;   ///< evaluated on the way
};

/// Limits of motions on which the mobile body's origin moves: between two knots its translation is linear in the angle. The axis
/// moves, so there is no closed form; as with PathFinder every step is as long as is certain to be free.
///
/// Guarantee: the motion is free up to the limit, whatever the surfaces do between two poses. It ends where less than the
/// tolerance is certain to be free. The error bound is then how far past the limit contact was found; or the tolerance, if
/// none was found within 64 of it: surfaces that pass each other so close, a few micrometres, count as in contact. Contact that does not end
/// motions is found in the same way.
class FollowedRange {
 public:
  /// Throws UsageError for a joint that is not free, and for options that leave out contacts of the reference pose. What is in
  /// contact in the reference pose is not checked.
  explicit FollowedRange(const Joint& joint, const BearingOptions& bearing = {});
  ~FollowedRange();
  FollowedRange(const FollowedRange&) = delete;
  FollowedRange& operator=(const FollowedRange&) = delete;

  /// Throws UsageError as check_motion(), for knots that do not begin at the start or do not ascend, and for a tolerance below 1e-6
  /// degrees. Empty if it was stopped. From any thread.
  [[nodiscard]] std::optional<FollowedLimit> limit(const Motion& motion, const NextKnot& next,
                                                   const std::stop_token& stop = {},
                                                   Angle tolerance = Angle::degrees(1e-3)) const;

  /// Basis of the classification of contacts.
  [[nodiscard]] const BearingFinding& bearing() const noexcept;
  [[nodiscard]] BearingRule bearing_rule() const noexcept;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// Limits of joints whose meshes overlap a little in every pose: a motion ends if the deepest radial depth exceeds an
// allowed one. For such joints only; if the meshes are clean, RangeOfMotion is exact.

struct AllowedDepth {
  double depth_mm = 0;
  Angle step = Angle::degrees(1);          ///< of the search along the motion
  Angle tolerance = Angle::degrees(1e-3);  ///< of the limit, once bracketed
};

/// The deepest place of two bodies at one pose.
struct DeepestPlace {
  double depth_mm = 0;                         ///< 0 if no vertex is inside
  std::optional<ContactWitness> contact = {};  ///< that vertex, and the face that its ray leaves through
  Angle ray_to_normal = {};                    ///< at that face; beyond 60 degrees the radial depth grazes
};

struct DepthLimit {
  MotionLimit limit = {};      ///< its error bound is here the tolerance of the search
  DeepestPlace at_limit = {};  ///< at the reported angle, where the depth is still allowed
  double start_depth_mm = 0;
  /// Whether every pose tried inside the last step was as deep as the allowed ones before it: if not, the surfaces
  /// are rough at this scale and a limit a little further on would be as good.
  bool depth_grows = true;
};

/// Depth is the radial depth (docs/mathematics/02-radial-method.md) of the deepest vertex of either body in the
/// other, whatever the angle between its ray and the surface. For surfaces that slide on each other, that is the
/// depth. Where a neck runs into a rim the ray grazes the wall and the radial depth is many times the true one, so
/// there a motion ends almost as soon as a vertex is inside: the allowed depth applies to bearing surfaces.
///
/// Not exact, unlike RangeOfMotion: depth is computed at poses one step apart, and only of vertices. Contact that
/// comes and goes between two poses of the search, or of edges and faces without a vertex, is not seen. The first
/// step whose end is too deep is divided into ten parts, and the first too deep part is halved until the tolerance:
/// the reported angle is allowed, and within the tolerance after it the depth is too large.
class DepthRange {
 public:
  /// Throws UsageError for an allowed depth below 0, steps or tolerances that are not above 0, a tolerance
  /// above the step; MeshError if a mesh is open, for depth needs an inside.
  DepthRange(const Joint& joint, const AllowedDepth& allowed);
  ~DepthRange();
  DepthRange(const DepthRange&) = delete;
  DepthRange& operator=(const DepthRange&) = delete;

  [[nodiscard]] DeepestPlace deepest(const JointAngles& at) const;
  /// `contact_at_start` if the depth at the start is too large already.
  [[nodiscard]] DepthLimit limit(const Motion& motion) const;
  [[nodiscard]] std::vector<DepthLimit> limits(std::span<const Motion> motions) const;

  /// The bearing surface that labels contacts: all of them count.
  [[nodiscard]] const BearingFinding& bearing() const noexcept;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace condyle::motion
