#include "condyle/io/pose_text.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "condyle/error.hpp"
#include "io/file/in_quotes.hpp"

namespace condyle {
namespace {

/// A word for an angle and the sign it gives.
struct AngleName {
  std::string_view name;
  JointAngle angle;
  double sign;
};
constexpr std::array angle_names{
    AngleName{"flexion", JointAngle::flexion, 1},
    AngleName{"adduction", JointAngle::adduction, 1},
    AngleName{"internal_rotation", JointAngle::internal_rotation, 1},
    AngleName{"extension", JointAngle::flexion, -1},
    AngleName{"abduction", JointAngle::adduction, -1},
    AngleName{"external_rotation", JointAngle::internal_rotation, -1},
};

constexpr std::string_view separators = " \t\r\n,";

const AngleName& angle_name(std::string_view name) {
  for (const AngleName& known : angle_names)
    if (known.name == name) return known;
  throw UsageError(
      fmt::format("pose: unknown angle {}; there are flexion, adduction and internal_rotation, and "
                  "extension, abduction and external_rotation with the opposite sign",
                  io::in_quotes(name)));
}

double degrees_from(std::string_view text, std::string_view name) {
  const std::string_view digits = text.starts_with('+') ? text.substr(1) : text;
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc{} || end != digits.data() + digits.size() ||
      digits.starts_with("-") != text.starts_with("-"))
    throw UsageError(fmt::format("pose: {}={} is not a number of degrees", name, io::in_quotes(text)));
  if (!std::isfinite(value))
    throw UsageError(fmt::format("pose: {} must be finite, not {}", name, io::in_quotes(text)));
  return value;
}

}  // namespace

PoseDegrees parse_pose(std::string_view text, JointKind kind) {
  std::array<std::optional<double>, 3> degrees;
  for (std::size_t at = 0; (at = text.find_first_not_of(separators, at)) != text.npos;) {
    const std::string_view word = text.substr(at, text.find_first_of(separators, at) - at);
    at += word.size();
    const std::size_t equals = word.find('=');
    if (equals == word.npos)
      throw UsageError(fmt::format("pose: {} is not of the form flexion=90", io::in_quotes(word)));
    const AngleName& known = angle_name(word.substr(0, equals));
    auto& value = degrees[static_cast<std::size_t>(known.angle)];
    if (value) throw UsageError(fmt::format("pose: {} is given twice", name_of(known.angle)));
    // Adding 0 makes 0 of -0, which extension=0 would be.
    value = known.sign * degrees_from(word.substr(equals + 1), known.name) + 0.0;
  }
  if (kind == JointKind::hinge)
    for (const JointAngle angle : {JointAngle::adduction, JointAngle::internal_rotation})
      if (degrees[static_cast<std::size_t>(angle)].value_or(0) != 0)
        throw UsageError(fmt::format("pose: a hinge rotates in flexion only, not in {}", name_of(angle)));
  const auto given = [&](JointAngle a) { return degrees[static_cast<std::size_t>(a)].value_or(0); };
  return {given(JointAngle::flexion), given(JointAngle::adduction), given(JointAngle::internal_rotation)};
}

std::string to_text(const PoseDegrees& pose) {
  return fmt::format("flexion={} adduction={} internal_rotation={}", pose.flexion, pose.adduction,
                     pose.internal_rotation);
}

std::string_view name_of(Side side) noexcept {
  return side == Side::right ? "right" : "left";
}

std::string_view name_of(JointKind kind) noexcept {
  return kind == JointKind::ball ? "ball" : "hinge";
}

std::string_view name_of(JointAngle angle) noexcept {
  return angle_names[static_cast<std::size_t>(angle)].name;
}

JointAngle joint_angle_named(std::string_view name) {
  for (const JointAngle angle : {JointAngle::flexion, JointAngle::adduction, JointAngle::internal_rotation})
    if (name_of(angle) == name) return angle;
  throw UsageError(fmt::format("unknown angle {}; there are flexion, adduction and internal_rotation",
                               io::in_quotes(name)));
}

}  // namespace condyle
