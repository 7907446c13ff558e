#include "condyle/io/pose_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "condyle/error.hpp"
#include "io/file/in_quotes.hpp"
#include "io/joint/pose_matrix.hpp"

namespace condyle::io {
namespace {

/// A word for an angle and the sign it gives.
struct AngleName {
  std::string_view name;
  JointAngle angle;
  double sign;
};

constexpr std::string_view separators = " \t\r\n,";

std::optional<AngleName> angle_name(std::string_view name, Anatomy joint) {
  for (const JointAngle angle : all_joint_angles) {
    const auto& [positive, negative] = coordinate_names(joint)[static_cast<std::size_t>(angle)];
    if (name == positive) return AngleName{positive, angle, 1};
    if (name == negative) return AngleName{negative, angle, -1};
  }
  return std::nullopt;
}

[[noreturn]] void fail_unknown(std::string_view name, JointKind kind, Anatomy joint) {
  const auto& names = coordinate_names(joint);
  throw UsageError(
      fmt::format("pose: unknown {} {}; there are {}, {} and {}, and {}, {} and {} with the opposite sign{}",
                  kind == JointKind::free ? "coordinate" : "angle", io::in_quotes(name), names[0].positive,
                  names[1].positive, names[2].positive, names[0].negative, names[1].negative,
                  names[2].negative, kind == JointKind::free ? ", and x, y and z" : ""));
}

std::optional<double> number_from(std::string_view text) noexcept {
  const std::string_view digits = text.starts_with('+') ? text.substr(1) : text;
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc{} || end != digits.data() + digits.size() ||
      digits.starts_with("-") != text.starts_with("-"))
    return std::nullopt;
  return value;
}

double finite_number(std::string_view text, std::string_view name, std::string_view unit) {
  const auto value = number_from(text);
  if (!value)
    throw UsageError(fmt::format("pose: {}={} is not a number of {}", name, io::in_quotes(text), unit));
  if (!std::isfinite(*value))
    throw UsageError(fmt::format("pose: {} must be finite, not {}", name, io::in_quotes(text)));
  return *value;
}

/// Calls back with each word between separators.
template <class Word>
void for_each_word(std::string_view text, const Word& word) {
  for (std::size_t at = 0; (at = text.find_first_not_of(separators, at)) != text.npos;) {
    const std::string_view next = text.substr(at, text.find_first_of(separators, at) - at);
    at += next.size();
    word(next);
  }
}

/// `in` names where they stand, as in "pose: X in the matrix is not a finite number".
std::vector<double> finite_numbers(std::string_view text, std::string_view of, std::string_view in) {
  std::vector<double> numbers;
  for_each_word(text, [&](std::string_view word) {
    const auto value = number_from(word);
    if (!value || !std::isfinite(*value))
      throw UsageError(fmt::format("{}: {} in the {} is not a finite number", of, io::in_quotes(word), in));
    numbers.push_back(*value);
  });
  return numbers;
}

PoseArgument pose_of_matrix(std::string_view text) {
  const std::vector<double> m = finite_numbers(text, "pose", "matrix");
  if (m.size() != 16)
    throw UsageError(fmt::format("pose: a matrix has 16 numbers, row by row, not {}", m.size()));
  std::array<double, 16> rows;
  std::copy(m.begin(), m.end(), rows.begin());
  try {
    const auto [X_FM, skew] = io::pose_of_rows(rows);
    PoseArgument given{{}, X_FM};
    if (skew > 0)
      given.notes.push_back(
          fmt::format("the rotation of the matrix was off by {:.2g}; the nearest one is used", skew));
    return given;
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("pose: {}", error.what()));
  }
}

std::string hinge_refusal(Anatomy joint, JointAngle angle) {
  return fmt::format("pose: a hinge rotates in {} only, not in {}", name_of(JointAngle::flexion, joint),
                     name_of(angle, joint));
}

}  // namespace

PoseDegrees parse_pose(std::string_view text, JointKind kind, Anatomy joint) {
  std::array<std::optional<double>, 3> degrees, mm;
  for_each_word(text, [&](std::string_view word) {
    const std::size_t equals = word.find('=');
    if (equals == word.npos)
      throw UsageError(fmt::format("pose: {} is not of the form {}=90", io::in_quotes(word),
                                   name_of(JointAngle::flexion, joint)));
    const std::string_view name = word.substr(0, equals), value = word.substr(equals + 1);
    const auto set = [](std::optional<double>& to, std::string_view as, double number) {
      if (to) throw UsageError(fmt::format("pose: {} is given twice", as));
      to = number + 0.0;  // 0 of -0, which extension=0 would be
    };
    if (const auto known = angle_name(name, joint))
      set(degrees[static_cast<std::size_t>(known->angle)], name_of(known->angle, joint),
          known->sign * finite_number(value, known->name, "degrees"));
    else if (const auto axis = std::string_view("xyz").find(name);
             kind == JointKind::free && name.size() == 1 && axis != name.npos)
      set(mm[axis], name, finite_number(value, name, "mm"));
    else
      fail_unknown(name, kind, joint);
  });
  const auto given = [&](JointAngle a) { return degrees[static_cast<std::size_t>(a)].value_or(0); };
  if (kind == JointKind::hinge)
    for (const JointAngle angle : {JointAngle::adduction, JointAngle::internal_rotation})
      if (given(angle) != 0) throw UsageError(hinge_refusal(joint, angle));
  return {given(JointAngle::flexion),
          given(JointAngle::adduction),
          given(JointAngle::internal_rotation),
          {mm[0].value_or(0), mm[1].value_or(0), mm[2].value_or(0)}};
}

bool is_matrix(std::string_view text) noexcept {
  const std::size_t first = text.find_first_not_of(separators);
  return first != text.npos && std::string_view("0123456789+-.").find(text[first]) != text.npos;
}

PoseArgument matrix_pose(std::string_view text) {
  if (!is_matrix(text)) throw UsageError("pose: a matrix begins with a number");
  return pose_of_matrix(text);
}

PoseArgument given_pose(std::string_view text, const Joint& joint) {
  const CoordinateSystem system = joint.coordinates();
  if (!is_matrix(text)) {
    const PoseDegrees pose = parse_pose(text, joint.kind, joint.anatomy);
    return {pose, pose_at(system, pose.coordinates(), joint.translation_frame)};
  }
  PoseArgument given = pose_of_matrix(text);
  const auto [angles, translation] = coordinates_at(system, given.X_FM, joint.translation_frame);
  given.pose = {angles.flexion.degrees(), angles.adduction.degrees(), angles.internal_rotation.degrees(),
                translation};
  if (joint.kind != JointKind::free && given.X_FM.translation() != Vec3::Zero())
    throw UsageError(fmt::format("pose: a {} does not translate, and the matrix has ({}, {}, {}) mm",
                                 name_of(joint.kind), translation.x(), translation.y(), translation.z()));
  if (joint.kind == JointKind::hinge) {
    for (const JointAngle angle : {JointAngle::adduction, JointAngle::internal_rotation})
      if (std::abs(Angle::degrees(given.pose[angle]).radians()) > io::largest_skew)
        throw UsageError(hinge_refusal(joint.anatomy, angle));
    given.pose = {given.pose.flexion, 0, 0, Vec3::Zero()};
    given.X_FM = pose_at(system, given.pose.angles());
  }
  return given;
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

contact::ArcsAbout arcs_about(std::string_view text, Anatomy joint) {
  if (!is_matrix(text)) return joint_angle_named(text, joint);
  const std::vector<double> n = finite_numbers(text, "about", "axis");
  if (n.size() != 3 && n.size() != 6)
    throw UsageError(
        fmt::format("about: an axis has 3 numbers, or 6 with a point of it in mm, not {}", n.size()));
  return contact::AxisLine{{n[0], n[1], n[2]}, n.size() == 3 ? Vec3(Vec3::Zero()) : Vec3(n[3], n[4], n[5])};
}

JointAngle joint_angle_named(std::string_view name, Anatomy joint) {
  for (const JointAngle angle : all_joint_angles)
    if (name_of(angle, joint) == name) return angle;
  throw UsageError(fmt::format("unknown angle {}; there are {}, {} and {}", io::in_quotes(name),
                               name_of(JointAngle::flexion, joint), name_of(JointAngle::adduction, joint),
                               name_of(JointAngle::internal_rotation, joint)));
}

}  // namespace condyle::io
