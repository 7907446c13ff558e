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

constexpr std::string_view separators = " \t\r\n,";

AngleName angle_name(std::string_view name, Anatomy joint) {
  const auto& names = coordinate_names(joint);
  for (const JointAngle angle : all_joint_angles) {
    const auto& [positive, negative] = names[static_cast<std::size_t>(angle)];
    if (name == positive) return {positive, angle, 1};
    if (name == negative) return {negative, angle, -1};
  }
  throw UsageError(
      fmt::format("pose: unknown angle {}; there are {}, {} and {}, and {}, {} and {} with the opposite sign",
                  io::in_quotes(name), names[0].positive, names[1].positive, names[2].positive,
                  names[0].negative, names[1].negative, names[2].negative));
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

PoseDegrees parse_pose(std::string_view text, JointKind kind, Anatomy joint) {
  std::array<std::optional<double>, 3> degrees;
  for (std::size_t at = 0; (at = text.find_first_not_of(separators, at)) != text.npos;) {
    const std::string_view word = text.substr(at, text.find_first_of(separators, at) - at);
    at += word.size();
    const std::size_t equals = word.find('=');
    if (equals == word.npos)
      throw UsageError(fmt::format("pose: {} is not of the form {}=90", io::in_quotes(word),
                                   name_of(JointAngle::flexion, joint)));
    const AngleName known = angle_name(word.substr(0, equals), joint);
    auto& value = degrees[static_cast<std::size_t>(known.angle)];
    if (value) throw UsageError(fmt::format("pose: {} is given twice", name_of(known.angle, joint)));
    // Adding 0 makes 0 of -0, which extension=0 would be.
    value = known.sign * degrees_from(word.substr(equals + 1), known.name) + 0.0;
  }
  const auto given = [&](JointAngle a) { return degrees[static_cast<std::size_t>(a)].value_or(0); };
  if (kind == JointKind::hinge)
    for (const JointAngle angle : {JointAngle::adduction, JointAngle::internal_rotation})
      if (given(angle) != 0)
        throw UsageError(fmt::format("pose: a hinge rotates in {} only, not in {}",
                                     name_of(JointAngle::flexion, joint), name_of(angle, joint)));
  return {given(JointAngle::flexion), given(JointAngle::adduction), given(JointAngle::internal_rotation),
          Vec3::Zero()};
}

std::string to_text(const PoseDegrees& pose, Anatomy joint) {
  std::string text;
  for (const JointAngle angle : all_joint_angles)
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", name_of(angle, joint), pose[angle]);
  if (pose.translation_mm != Vec3::Zero())
    text += fmt::format(" x={} y={} z={}", pose.translation_mm.x(), pose.translation_mm.y(),
                        pose.translation_mm.z());
  return text;
}

std::string_view name_of(Side side) noexcept {
  return side == Side::right ? "right" : "left";
}

std::string_view name_of(JointKind kind) noexcept {
  switch (kind) {
    case JointKind::ball:
      return "ball";
    case JointKind::hinge:
      return "hinge";
    case JointKind::free:
      break;
  }
  return "free";
}

std::string_view name_of(Anatomy joint) noexcept {
  switch (joint) {
    case Anatomy::hip:
      return "hip";
    case Anatomy::knee:
      return "knee";
    case Anatomy::ankle:
      return "ankle";
    case Anatomy::elbow:
      return "elbow";
    case Anatomy::shoulder:
      break;
  }
  return "shoulder";
}

std::string_view name_of(TranslationFrame frame) noexcept {
  return frame == TranslationFrame::fixed ? "fixed" : "joint_axes";
}

std::string_view name_of(JointAngle angle, Anatomy joint) noexcept {
  return coordinate_names(joint)[static_cast<std::size_t>(angle)].positive;
}

JointAngle joint_angle_named(std::string_view name, Anatomy joint) {
  for (const JointAngle angle : all_joint_angles)
    if (name_of(angle, joint) == name) return angle;
  throw UsageError(fmt::format("unknown angle {}; there are {}, {} and {}", io::in_quotes(name),
                               name_of(JointAngle::flexion, joint), name_of(JointAngle::adduction, joint),
                               name_of(JointAngle::internal_rotation, joint)));
}

}  // namespace condyle
