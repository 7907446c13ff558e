#pragma once

#include <optional>
#include <string_view>

#include "condyle/angle.hpp"

namespace condyle::io {

/// How far a healthy adult hip is said to turn in the motion of this name; empty if the source has no value. American Academy
/// of Orthopaedic Surgeons, "Joint Motion: Method of Measuring and Recording", Chicago 1965: flexion 120, extension 30,
/// abduction 45, adduction 30, internal and external rotation 45 degrees. Measured on the living, where soft tissue stops
/// most motions before bone does: a bony limit past the range is usual, one well short of it is not. Of other joints no ranges
/// with a source are known here.
std::optional<Angle> normal_hip_range(std::string_view motion) noexcept;

/// The source as results and figures name it.
inline constexpr std::string_view normal_hip_range_source = "AAOS 1965";

}  // namespace condyle::io
