#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "condyle/answer/case.hpp"
#include "condyle/contact_measures.hpp"
#include "condyle/first_contact.hpp"
#include "condyle/joint.hpp"
#include "condyle/joint_checks.hpp"
#include "condyle/normal_depth.hpp"
#include "condyle/pressure.hpp"

/// How deep the bodies of a joint are in each other at one pose; and, of two meshes without a joint, whether they touch, how deep, and how
/// one gets free of the other.

namespace condyle {

enum class DepthMethod : std::uint8_t {
  reliable,  ///< Along rays from the centre if that is a depth, else along the arc that frees a vertex soonest.
  radial,    ///< Along rays only.
  tangential,  ///< Along arcs about one axis of the joint.
  normal,      ///< Along normals of triangles, open meshes too.
};

/// Which measures an answer has beside its depths.
enum class MeasuresOf : std::uint8_t {
  contact,         ///< Areas, volume, centroids and nearest points too: most of the time of a deep pose.
  distances_only,  ///< Nearest distances of vertices; the other measures stay as they are made.
};

/// Options of a request at one pose, with their defaults.
struct DepthRequest {
  Pose X_FM = Pose::Identity();
  /// The angles that X_FM was made of, about whose axes arcs go; default: those that it has, which rounding may change.
  std::optional<JointAngles> pose = {};
  DepthMethod method = DepthMethod::reliable;
  /// With DepthMethod::tangential; default: flexion. Angles are for poses that do not translate, lines for any.
  std::optional<contact::ArcsAbout> about = {};
  /// With DepthMethod::normal the body whose triangles cast, and how; defaults: both, NormalDepthOptions{}.
  std::optional<contact::Casting> casting = {};
  std::optional<contact::NormalDepthOptions> rays = {};
  contact::DistancesOf distances = contact::DistancesOf::vertices_inside;
  MeasuresOf measures = MeasuresOf::contact;
  bool deepest_place = false;  ///< some milliseconds more
  const motion::RangeOfMotion* limits =
      nullptr;  ///< limits_of_poses(), by which the pose is judged; null: it is not
};

/// DepthMethod::reliable and radial: every vertex along its ray, and the depth to read of each. With `radial` that is its radial
/// depth, or its nearest distance if that is none.
struct RayDepths {
  contact::RadialContact contact;
  contact::ReliableContact reliable;
};

/// A rotation axis, by its joint angle if it is that of one, and as a line of F.
struct RotationAxis {
  std::optional<JointAngle> about;
  Vec3 direction_F;  ///< of unit length
  Vec3 point_F;
};

/// DepthMethod::tangential: every vertex along its circle.
struct ArcDepths {
  RotationAxis axis;
  contact::TangentialContact contact;
};

/// The place of one body's surface that is deepest in the other body, in F: how far it is from the nearest point of the other's surface,
/// which lies along that surface's normal where it is inside a face.
struct TouchDepth {
  BodyRole of;            ///< whose surface it is on
  double depth_mm;        ///< > 0
  double error_mm;        ///< no place of either surface is deeper by more
  Vec3 place, exit;       ///< on that surface, and the nearest point of the other one
  Vec3 normal;            ///< of unit length from place to exit
  Index triangle, other;  ///< that hold them, of this body and of the other
};

struct DepthAnswer {
  DepthRequest request;
  contact::ContactMeasures measures;  ///< with DepthMethod::normal nearest distances and points only
  std::variant<RayDepths, ArcDepths, contact::NormalContact> depths;
  std::vector<std::string> caveats = {};  ///< what the depths must be read with, a sentence each
  std::optional<PoseStanding> standing = {};
  /// The place of either surface that is deepest in the other body, whatever its vertices, as answer_touch() has it.
  std::optional<TouchDepth> deepest_place = {};

  [[nodiscard]] bool in_contact() const noexcept;
};

/// The line of an angle at a pose with these angles; that of a line is itself.
[[nodiscard]] contact::AxisLine line_of(const contact::ArcsAbout& about, const CoordinateSystem& system,
                                        const JointAngles& at);

/// Depths along arcs about an angle's axis at a pose with these angles, or about a line. Throws UsageError as line_of() and
/// check_depth_request() do for arcs.
[[nodiscard]] ArcDepths arc_depths(const contact::JointContact& bodies, const contact::ArcsAbout& about,
                                   const CoordinateSystem& system, const Pose& X_FM, const JointAngles& at);

/// Throws UsageError for options of another method, arcs about an angle's axis at a pose that translates, a line without a direction,
/// and angles that are not those of X_FM.
void check_depth_request(const Joint& joint, const DepthRequest& request);

/// Depths at one pose. `bodies` are those of `joint`, and keep their tables for the next pose: the first call builds them, later
/// ones take some milliseconds in contact, arcs more.
///
/// Throws UsageError as check_depth_request(), MeshError as JointContact::radial() does. Open meshes have no inside: what lacks
/// an answer for that is empty.
[[nodiscard]] DepthAnswer answer_depth(const contact::JointContact& bodies, const Joint& joint,
                                       const DepthRequest& request);
[[nodiscard]] DepthAnswer answer_depth(const Joint& joint, const DepthRequest& request);

// Two meshes without a joint. The fixed body's frame F is that of the answer; the mobile body is placed in it by X_FM.
//
//     const TouchAnswer touch = answer_touch(fixed, mobile, {.X_FM = X_FM});
//     if (touch.deepest) ... touch.deepest->depth_mm

/// Which measures an answer has beside contact, pairs, nearest points and the deepest place.
enum class TouchMeasures : std::uint8_t {
  depth,  ///< none
  all,    ///< areas, volume and centroids, which cost more
};

struct TouchRequest {
  Pose X_FM = Pose::Identity();
  TouchMeasures measures = TouchMeasures::all;
  /// Directions in F, of any length but zero, along which the mobile body is moved until it is free.
  std::vector<Vec3> along = {};
  /// A joint centre in F: how deep along rays from there is asked for too.
  std::optional<Vec3> centre = {};
  bool units_are_stated = false;  ///< no note asks whether lengths are mm
};

/// How far the mobile body moves along a direction until it is free.
struct FreeTranslation {
  Vec3 along;             ///< of unit length
  double distance_mm;     ///< 0 where it is free as it is; from here on it is free
  double error_bound_mm;  ///< it is in contact until so far before
};

/// Of a body that has no inside, and of the other's surface in it, nothing.
struct TouchOverlap {
  /// The space inside both, each point as often as the bodies cover it, and by how much it may be off by rounding. Empty too where a body
  /// that crosses itself is inside out there.
  std::optional<double> volume_mm3 = {};
  double volume_error_mm3 = 0;
  /// How much of it is counted again because a body covers it more than once: it crosses itself or has triangles twice.
  double fixed_covered_again_mm3 = 0, mobile_covered_again_mm3 = 0;
  std::optional<double> fixed_area_mm2 = {}, mobile_area_mm2 = {};  ///< of its surface inside the other body
  std::optional<Vec3> centroid = {};                                ///< of both areas, in F
};

struct TouchAnswer {
  TouchRequest request;
  bool in_contact = false;  ///< the surfaces meet, or one body is inside the other
  std::vector<contact::TrianglePair> pairs = {};
  /// The body that is wholly inside the other, which is closed, without their surfaces meeting.
  std::optional<BodyRole> inside = {};
  /// Nearest points of the surfaces where they do not meet.
  std::optional<contact::NearestPoints> nearest = {};
  /// Empty without contact, and where nothing of a surface is inside: bodies that touch, or whose surfaces coincide.
  std::optional<TouchDepth> deepest = {};
  /// In contact: no place of either surface is deeper in the other body. Empty if no body has an inside.
  std::optional<double> depth_bound_mm = {};
  /// About the request's centre, the depth along a ray of the deepest vertex whose ray is a depth, as DepthMethod::radial has it; 0 if there is
  /// none. Empty without a centre, without contact, and if a body has no inside.
  std::optional<double> ray_depth_mm = {};
  std::optional<TouchOverlap> overlap = {};  ///< if requested and in contact
  std::vector<FreeTranslation> free = {};    ///< in the order of `along`
  std::vector<JointNote> notes = {};         ///< meshes that have no inside, and what that leaves unknown
};

/// Throws UsageError for a pose that is no rotation with a translation and for directions that are none, MeshError if a mesh has no
/// triangle. Open meshes have no inside, and inverted ones a wrong one: a note says so, and what needs an inside is empty.
[[nodiscard]] TouchAnswer answer_touch(const contact::JointContact& bodies, const TouchRequest& request);
[[nodiscard]] TouchAnswer answer_touch(const Mesh& fixed, const Mesh& mobile, const TouchRequest& request);

struct TurnRequest {
  Vec3 axis = Vec3::UnitZ(),
       centre = Vec3::Zero();  ///< a direction of any length but zero, and a point on it, in F
  Pose X_FM = Pose::Identity();
  bool units_are_stated = false;  ///< as TouchRequest has it
};
struct TurnAnswer {
  TurnRequest request;
  motion::FreeAngles free;
  std::vector<JointNote> notes = {};
};
/// First contact and all free angles of a turn of the mobile body about an axis. Throws UsageError as motion::free_turns().
[[nodiscard]] TurnAnswer answer_turn(const Mesh& fixed, const Mesh& mobile, const TurnRequest& request);

struct SlideRequest {
  Vec3 along = Vec3::UnitZ();  ///< in F, of any length but zero
  Pose X_FM = Pose::Identity();
  bool units_are_stated = false;  ///< as TouchRequest has it
};
struct SlideAnswer {
  SlideRequest request;
  motion::FreeSlides free;
  std::vector<JointNote> notes = {};
};
/// The same along a direction. Throws UsageError as motion::free_slides().
[[nodiscard]] SlideAnswer answer_slide(const Mesh& fixed, const Mesh& mobile, const SlideRequest& request);

}  // namespace condyle
