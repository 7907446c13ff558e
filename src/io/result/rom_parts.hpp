#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/result/json.hpp"
#include "io/result/normal_range.hpp"
#include "io/result/rom_result.hpp"

/// Common parts of the JSON and the lines of a range of motion.

namespace condyle::io {

/// "vertex", "edge", "face".
std::string_view name_of(motion::FeatureKind kind) noexcept;

/// "vertex 12", "edge 3-7", "face 40".
std::string text_of(const motion::Feature& feature);

/// The part of a body that a feature of its mesh is of; null if the body is one mesh.
const BodyPart* part_of(const Body& body, const motion::Feature& feature) noexcept;

inline bool ends_in_contact(const motion::MotionLimit& limit) noexcept {
  return limit.end.reason != motion::LimitReason::end_of_range;
}

/// The two bedside tests, whose angles nobody has agreed on.
inline bool is_as_defined_here(const motion::Motion& motion) noexcept {
  return motion.name == "fadir" || motion.name == "faber";
}

/// Range in the living, behind the limit of a hip's motion; none if no source has a value, and if zero angles are not known to be neutral:
/// ranges count from there.
std::optional<Angle> normal_range(const Joint& joint, const motion::MotionLimit& limit);

/// Where the angles of a joint count from, and how its femur lies there: zero_pose().
Json zero_json(const Joint& joint);

/// Two motions that turn one angle from one start, to either side.
struct OppositeLimits {
  const motion::MotionLimit *one, *other;

  /// From one limit to the other, wherever zero is.
  Angle arc() const noexcept { return one->end.turned + other->end.turned; }
};

/// Those of which both end in contact, in the order of their first ones.
std::vector<OppositeLimits> opposite_limits(std::span<const motion::MotionLimit> limits);

/// One limit of it, the i-th.
Json motion_json(const RomResult& result, std::size_t i);

/// rom_json() before it is text.
Json rom_object(const RomResult& result);

}  // namespace condyle::io
