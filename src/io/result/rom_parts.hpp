#pragma once

#include <optional>
#include <string>
#include <string_view>

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

/// Range in the living, behind the limit of a hip's motion; none if no source has a value.
inline std::optional<Angle> normal_range(const RomResult& result, const motion::MotionLimit& limit) noexcept {
  return result.joint.is_hip() ? normal_hip_range(limit.motion.name) : std::nullopt;
}

/// rom_json() before it is text.
Json rom_object(const RomResult& result);

}  // namespace condyle::io
