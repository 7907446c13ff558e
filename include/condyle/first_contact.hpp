#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "condyle/angle.hpp"
#include "condyle/mesh.hpp"
#include "condyle/pose.hpp"

/// How far one mesh rotates about an axis, or slides along a direction, before it meets another: in closed form, complete, without
/// a step size (docs/mathematics/05-contact-under-rotation.md).

namespace condyle::motion {

enum class FeatureKind : std::uint8_t { vertex, edge, face };
/// As in files: "vertex".
[[nodiscard]] std::string_view name_of(FeatureKind kind) noexcept;

/// A vertex by its number, an edge by its two vertices (ascending), a face by its triangle's number: numbers
/// of the mesh.
struct Feature {
  FeatureKind kind = FeatureKind::vertex;
  Index id = no_index;
  Index other_end = no_index;  ///< edges only

  friend auto operator<=>(const Feature&, const Feature&) = default;
};

/// Kind of a joint's contact: see BearingSurface.
enum class ContactKind : std::uint8_t {
  unknown,      ///< No bearing surface is known.
  bearing,      ///< The bearing surfaces touch: the centre or the segmentation is off.
  impingement,  ///< Something else meets.
  cut,          ///< A face that closes a bone where its image ends meets something: no contact of bones.
  soft,         ///< A mesh called soft touches: PartContact.
};
/// As in files: "bearing".
[[nodiscard]] std::string_view name_of(ContactKind kind) noexcept;

/// A pair of features in contact, and the point on each body in its own frame. If several pairs are in contact at the
/// same reported angle, the first in the order of Feature, the rotating body's feature compared first.
struct ContactWitness {
  Feature fixed_feature, mobile_feature;
  Vec3 fixed_point, mobile_point;  ///< mm, each in its own body's frame
  ContactKind kind = ContactKind::unknown;
};

enum class LimitReason : std::uint8_t {
  contact,            ///< The surfaces meet at the angle, and not before.
  end_of_range,       ///< Nothing meets in the whole range.
  contact_at_start,   ///< The surfaces meet at the start already, or one body is inside the other.
  ligament,           ///< A ligament reaches the strain that it may have.
  strained_at_start,  ///< One has more than that at the start already.
};
/// As in files: "end_of_range".
[[nodiscard]] std::string_view name_of(LimitReason reason) noexcept;

/// Contact before a limit that does not end the motion: of bearing surfaces, or of a mesh called soft.
struct EarlierContact {
  Angle turned = {};  ///< from the start, >= 0; 0 if they are in contact there already
  /// Empty if one surface is inside the other body and they do not meet.
  std::optional<ContactWitness> contact = {};
  Angle error_bound = {};  ///< as a limit's
};

/// One end of a free rotation.
struct Limit {
  Angle turned = {};  ///< from the start, >= 0 in either sense; 0 for contact_at_start and strained_at_start
  LimitReason reason = LimitReason::end_of_range;
  /// For contact and contact_at_start; empty if one body is inside the other and their surfaces do not meet.
  std::optional<ContactWitness> contact = {};
  /// First contact is at `turned` or past it by at most this; never before.
  Angle error_bound = {};
  /// Set by RangeOfMotion if bearing contact does not count: the first one, if it comes before the limit.
  std::optional<EarlierContact> bearing_contact = {};
  /// Set by RangeOfMotion if a mesh is called soft: its first contact, if before the limit.
  std::optional<EarlierContact> soft_contact = {};

  /// Set by RangeOfMotion where a ligament ends the motion: its number in the joint.
  std::optional<std::size_t> ligament = {};

  [[nodiscard]] ContactKind kind() const noexcept { return contact ? contact->kind : ContactKind::unknown; }
};

/// Work counters of a search.
struct SearchWork {
  std::int64_t node_pairs = 0;       ///< pairs of regions compared
  std::int64_t leaf_pairs = 0;       ///< pairs of leaves whose features were compared
  std::int64_t events = 0;           ///< pairs of features whose angles were solved for
  std::int64_t exact_decisions = 0;  ///< roots that doubles could not decide
  std::int64_t triangle_tests = 0;   ///< pairs of triangles tested at the start

  SearchWork& operator+=(const SearchWork& more) noexcept;
};

/// Both ends of a free rotation. In contact at the start, both say so.
struct RotationLimits {
  Limit negative, positive;
  SearchWork work = {};

  [[nodiscard]] bool free_at_start() const noexcept {
    return positive.reason != LimitReason::contact_at_start &&
           positive.reason != LimitReason::strained_at_start;
  }
};

/// From `negative` <= 0 to `positive` >= 0, at most a full turn in each sense.
struct RotationRange {
  Angle negative = Angle::radians(-two_pi);
  Angle positive = Angle::radians(two_pi);
};

/// Two bodies made ready for rotations of the mobile one about one axis that stays in the fixed one.
///
///         fixed            The axis is given in the frame of the fixed body F. The mobile body M starts at
///        +-----+           X_FM and turns about the axis in either sense, until the surfaces meet or the range
///        |     |  M        ends.
///     o  +-----+ /
///    axis  . - ~ '
///
/// Guarantee, for the meshes as placed in the frame of the axis (where placing rounds, each coordinate by some
/// 2^-52 of its size): no contact is missed, so a limit is never past one; and it is short of one by at most
/// `error_bound`, itself below 4e-12 rad. Every decision of the search is exact.
///
/// A body inside the other whose surfaces do not meet counts as contact at the start if the outer one is
/// closed; an open mesh has no inside.
///
/// Building costs a few microseconds per triangle of the fixed body, a query some hundred microseconds. Each
/// thread that queries keeps one copy of the mobile body's placed features.
class FirstContact {
 public:
  FirstContact(const Mesh& fixed, const Mesh& mobile, const AxisFrame& axis_F);
  ~FirstContact();
  FirstContact(FirstContact&&) noexcept;
  FirstContact& operator=(FirstContact&&) noexcept;

  /// Both limits from the start pose. Throws UsageError if the range does not hold 0, is more than a full
  /// turn in either sense, or is not finite, and for a pose that is not finite or translates beyond 1e30 mm. May be called from any thread; the same bits on each.
  [[nodiscard]] RotationLimits limits(const Pose& X_FM = Pose::Identity(),
                                      const RotationRange& range = {}) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Angles between which nothing meets.
struct FreeInterval {
  Angle low, high;  ///< of the varied angle less its start: low <= high, both in the range
  /// `turned` of either is measured from `start` in its sense if the start is in the interval, else from the
  /// interval's middle. Either ends by contact or at the end of the range.
  Limit at_low, at_high;

  [[nodiscard]] bool holds_start() const noexcept { return low <= Angle() && high >= Angle(); }
};

/// All angles of one joint angle that are free.
struct FreeAngles {
  RotationLimits from_start;
  std::vector<FreeInterval> intervals;  ///< ascending

  /// The one that holds the start, else the nearest to it, the lower of two as near; null if nothing is free.
  [[nodiscard]] const FreeInterval* nearest_to_start() const noexcept;
};

/// All angles of a whole turn about an axis of F, from a pose, at which the bodies are free; guarantee as of FirstContact. The interval
/// that holds the start has the limits from there, others lie between 0 and a full turn; a body that meets nothing is free from -180 to
/// 180 degrees. Intervals below 1e-9 rad are none. Throws UsageError as FirstContact::limits().
[[nodiscard]] FreeAngles free_turns(const Mesh& fixed, const Mesh& mobile, const AxisFrame& axis_F,
                                    const Pose& X_FM = Pose::Identity());

/// How far a slide may go from its start, below 0 and above it.
struct SlideRange {
  double negative_mm = -std::numeric_limits<double>::infinity();
  double positive_mm = std::numeric_limits<double>::infinity();
};

/// One end of a free slide.
struct SlideEnd {
  std::optional<double> at_mm = {};  ///< along the direction, from the start; empty if nothing ends it
  /// Contact is at `at_mm` or beyond it by at most this; never before.
  double error_bound_mm = 0;
  /// The two faces that meet there, and where; empty at the end of a range.
  std::optional<ContactWitness> contact = {};
};

/// Positions along a direction between which nothing meets.
struct FreeSlide {
  SlideEnd low, high;
};

/// All positions along a direction at which two bodies are free.
struct FreeSlides {
  bool free_at_start;
  /// First contact from the start against and along the direction; 0 if they are in contact there.
  SlideEnd negative, positive;
  std::vector<FreeSlide> intervals;  ///< ascending
};

/// The mobile body slides along a direction of F, of any length but zero, from X_FM. Guarantee for the vertices as placed in the frame of
/// the direction: no contact is missed, and touching counts. A body inside the other whose surfaces do not meet is in contact if the outer
/// one is closed. Throws UsageError for a direction or a pose that is none.
[[nodiscard]] FreeSlides free_slides(const Mesh& fixed, const Mesh& mobile, const Vec3& direction_F,
                                     const Pose& X_FM = Pose::Identity());

}  // namespace condyle::motion
