#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/control.hpp"
#include "condyle/joint.hpp"
#include "condyle/make_joint.hpp"
#include "condyle/range_of_motion.hpp"

/// Inverse resection: the bone that must go so that motions reach what is asked of them. docs/mathematics/12-resection.md.

namespace condyle::plan {

/// A motion, and how far it shall turn from its start.
struct ReachTarget {
  motion::Motion motion = {};
  Angle reach = {};
  bool is_gain = false;  ///< `reach` counts from where the motion ends now
};

/// For people: 120, where the angle in radians has 119.99999999999999.
[[nodiscard]] inline double asked_degrees(Angle angle) noexcept {
  return std::round(angle.degrees() * 1e9) / 1e9;
}

/// Why bone stays.
enum class KeptBy : std::uint8_t {
  bearing,  ///< It belongs to the bearing surface.
  depth,    ///< It lies deeper than may be removed.
  zone,     ///< It lies farther from the bearing surface than may be removed.
  marked,   ///< The request names it.
};

/// As in files: "bearing".
[[nodiscard]] std::string_view name_of(KeptBy by) noexcept;

/// Parts of a bone that must stay, beside its bearing surface.
struct KeptBone {
  std::optional<double> deepest_mm = {};  ///< no vertex is lowered by more
  /// Bone stays if it is farther than this outside the ball of the bearing surface (the head's radius and margin about its centre).
  std::optional<double> within_mm = {};
  std::vector<std::uint8_t> vertices = {};  ///< 1 for those that stay, one per vertex of the mesh; or none
};

struct ResectionOptions {
  std::vector<ReachTarget> targets = {};
  /// Share of the depth for which the fixed body is cut in place of the mobile one: 0 cuts the mobile body only, 1 the fixed body only.
  double fixed_share = 0;
  KeptBone mobile = {}, fixed = {};
  /// The bone that is left stays clear of the other one with its surface moved outwards by this, mm, along the way to the target.
  double margin_mm = 0;
  /// Diameter of a burr's ball, mm: the surface left is one that a ball of this size can make, and no groove is narrower. Without it the
  /// cut has any shape.
  std::optional<double> burr_mm = {};
  /// Triangles around the cut become so small. CutBone has the edge that was used: a larger one if there would be too many, a smaller one if
  /// the cut would turn triangles over.
  double edge_mm = 0.5;
  motion::RangeOptions range = {};
};

/// Why the triangles around a cut have the edges that they have.
enum class EdgeReason : std::uint8_t {
  requested,
  too_many,     ///< With shorter ones more than most_triangles_added would be made.
  turned_over,  ///< With longer ones the cut turns triangles over or runs through itself.
};

/// Smaller triangles around a cut add no more than so many to those of a bone: a fifth of a GB, and minutes. Slender triangles in which a cut
/// lies are split along their length only, and still count one by one.
inline constexpr std::size_t most_triangles_added = 150'000;

/// A bone after its cut.
struct CutBone {
  Body body;                     ///< with triangles made smaller around the cut, and lowered
  TriMesh before;                ///< the same triangles where the surface was
  std::vector<double> depth_mm;  ///< of each vertex: below the surface before, its distance from it
  std::vector<int> needed_by;    ///< the target that needs it, of each vertex; -1 where nothing goes
  std::vector<double>
      needed_from_deg;  ///< the angle of its motion from which on it is in the way; 0 where nothing goes
  double volume_mm3 = 0;
  /// The part of what was removed that the other bone sweeps over: no cut could do with less.
  double least_volume_mm3 = 0;
  double burr_volume_mm3 = 0;  ///< the part of what was removed that goes only because a burr is no smaller
  /// By how much the burr's ball would have to enter bone that stays, at the most; 0 where it need not.
  double burr_in_kept_mm = 0;
  /// Area of the surface before, where the cut is deeper than a per cent of its deepest place.
  double area_mm2 = 0;
  double deepest_mm = 0;
  Vec3 deepest_at = Vec3::Zero();  ///< on the surface before
  double edge_mm = 0;              ///< that triangles around the cut have at the most
  EdgeReason edge_reason = EdgeReason::requested;
};

/// Kept bone that stops a motion short of its target.
struct Blocked {
  KeptBy by;
  BodyRole body;
  Vec3 point_mm;  ///< in the bone's frame
};

struct ReachOutcome {
  ReachTarget target;
  Angle planned;  ///< the reach, or as far as kept bone lets the motion go
  motion::MotionLimit before, after;
  std::optional<Blocked> blocked = {};
};

struct Resection {
  Joint joint;                           ///< with the cut bones
  std::vector<ReachOutcome> targets;     ///< in the order of the request
  std::optional<CutBone> mobile, fixed;  ///< those that were cut
  /// On the way to a target the other bone sweeps over bearing surface of the mobile body, whose contact counts for nothing.
  bool sweeps_bearing = false;

  [[nodiscard]] double volume_mm3() const noexcept {
    return (mobile ? mobile->volume_mm3 : 0) + (fixed ? fixed->volume_mm3 : 0);
  }
};

/// The joint with another mesh in the mobile body's place, in its frame M: the same bone after something was done to it. Head, socket and
/// margin stay those that the bearing surface of this joint has: a fit to a mesh with smaller triangles in places would move them.
[[nodiscard]] Joint with_mobile_mesh(const Joint& joint, Mesh mesh);

/// The request with every target counted from its motion's start. Throws UsageError as check_resection(), and for a gain that leads beyond
/// the motion's range; MeshError for a gain of a motion that nothing ends; and as RangeOfMotion does.
[[nodiscard]] ResectionOptions with_gains_resolved(const Joint& joint, const ResectionOptions& request);

/// Throws UsageError for a request without targets, two of one motion, reaches that are not within the motion's range, and values outside
/// theirs.
void check_resection(const Joint& joint, const ResectionOptions& request);

/// The bone that must go so that each motion reaches its target, and the joint without it. What is removed holds everything that
/// the other bone sweeps over, and little more; the limits are exact ones of the joint with the cut bones.
///
/// Throws UsageError as check_resection(), MeshError if a body is not closed or a cut surface would run through itself, and
/// ReferenceContactError. A second or so for a hip of 20,000 triangles and one motion.
[[nodiscard]] Resection resect(const Joint& joint, const ResectionOptions& request);
/// The same; empty if it was stopped.
[[nodiscard]] std::optional<Resection> resect(const Joint& joint, const ResectionOptions& request,
                                              const Control& control);

}  // namespace condyle::plan
