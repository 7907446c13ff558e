#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "answer/records/record.hpp"
#include "condyle/answer/range.hpp"

/// Limits for programs that hold each coordinate by itself: a box in the joint's angles, and how far it is from the coupled limits of a map.

namespace condyle {

/// A coordinate of another program that turns the joint by its own value: angle = sign * coordinate + offset.
struct TurningCoordinate {
  std::string name;
  JointAngle angle;
  double sign = 1;  ///< or -1
  double offset_deg = 0;
  /// Forces of the model that hold it too, by their names and where they begin to, if limits are written into its copy, where they stay.
  std::optional<std::string> other_stop = {};
};

/// Whose limit an end of a box is.
enum class LimitSource : std::uint8_t {
  bony,
  living,    ///< the end that is expected of a living hip with this bone: LivingLimit::expected
  ligament,  ///< the end that a ligament of the joint makes before bone does
  bearing,   ///< where bearing surfaces meet, such as cartilage
  cut,       ///< on a face that closes a bone where its image ends, which is no end of the joint
};
/// As in files: "bony".
constexpr std::string_view name_of(LimitSource source) noexcept {
  constexpr std::string_view names[] = {"bony", "living", "ligament", "bearing", "cut"};
  return names[static_cast<std::size_t>(source)];
}

/// An end of one coordinate with the others at zero angles, as values of the coordinate.
struct BoxEndRecord {
  double limit_deg;
  LimitSource source;
  motion::LimitReason reason;  ///< of contact; without any it is the end of what was searched
  double bony_deg;
};
struct BoxSideRecord {
  std::string coordinate;
  JointAngle angle;
  double sign, offset_deg;
  BoxEndRecord lower, upper;
  std::optional<std::string> other_stop;  ///< TurningCoordinate::other_stop
};

/// How far the box is from the coupled limits at the points of a map, of which each has the free interval that MotionMap draws. Points are values
/// of the coordinates in their order.
///
///     varied       ___________
///        |      .´           `.         free: below the arch
///        |  +--/---------------\--+  upper end of the box
///        |  | /        B       |\ |     b: beyond, above the arch and in the box
///        |  |/b                | b|     B: in both
///        |  '------------------+--'
///        +------------------------- held
struct BoxErrorRecord {
  std::size_t points, points_in_box;
  std::size_t points_without_free;  ///< of those in the box
  double beyond_deg;  ///< a value of the varied angle in the box lies past its free interval by at most this
  std::optional<std::vector<double>> beyond_at_deg;  ///< which; empty where nothing is beyond
  double
      forbidden_deg;  ///< of a free pose the angle that is farthest past its end of the box is past it by at most this
  std::optional<std::vector<double>> forbidden_at_deg;
};
/// Whose zero, axes and side the angles of a box have, if they differ: ZeroOfColumns.
enum class BoxZero : std::uint8_t { joint, columns };
constexpr std::string_view name_of(BoxZero zero) noexcept {
  return zero == BoxZero::joint ? "joint" : "columns";
}
struct LimitBoxRecord {
  std::vector<BoxSideRecord> coordinates;
  BoxZero zero = BoxZero::joint;
  std::optional<Vec3> held_translation_mm;
  std::optional<BoxErrorRecord> error;  ///< empty of a hinge, whose limits are not coupled
  /// The map that it was held against; null of a hinge.
  std::shared_ptr<const motion::MotionMap> map = {};
};

/// The box of a joint by the tables of an answer about it, and the map that the answer has, or one of 10-degree steps over the box. Each
/// coordinate ends where the motion from zero angles ends. Empty if it was stopped. Throws UsageError for an answer without tables of
/// exact limits, for coordinates that are not those of all angles of the joint, for a shoulder, whose angles turn about one axis at zero, and for
/// a coordinate that does not move because the bodies are in contact on either side of zero.
std::optional<LimitBoxRecord> limit_box_record(const Case& of, const RangeAnswer& answer,
                                               const RangeRequest& request,
                                               std::span<const TurningCoordinate> coordinates,
                                               LimitSource source, const Control& control = {});

template <>
inline constexpr auto table<BoxEndRecord> = record("BoxEnd", "An end of a coordinate.",
                                                   CONDYLE_KEYS(BoxEndRecord, limit_deg, source, reason,
                                                                bony_deg));
template <>
inline constexpr auto table<BoxSideRecord> = record("BoxSide", "The limits of a coordinate.",
                                                    CONDYLE_KEYS(BoxSideRecord, coordinate, angle, sign,
                                                                 offset_deg, lower, upper, other_stop));
template <>
inline constexpr auto table<BoxErrorRecord> =
    record("BoxError", "How far independent limits are from coupled ones.",
           CONDYLE_KEYS(BoxErrorRecord, points, points_in_box, points_without_free, beyond_deg, beyond_at_deg,
                        forbidden_deg, forbidden_at_deg));
template <>
inline constexpr auto table<LimitBoxRecord> = record("LimitBox",
                                                     "Limits that hold each coordinate by itself.",
                                                     CONDYLE_KEYS(LimitBoxRecord, coordinates, zero,
                                                                  held_translation_mm, error));

}  // namespace condyle
