#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include "condyle/error.hpp"
#include "condyle/range_of_motion.hpp"
#include "core/near_name.hpp"
#include "core/one_line.hpp"

namespace condyle::motion {
namespace {

constexpr auto flexion = JointAngle::flexion, adduction = JointAngle::adduction,
               rotation = JointAngle::internal_rotation;
constexpr auto positive = RotationSense::positive, negative = RotationSense::negative;

constexpr JointAngles at(double flexion_deg, double adduction_deg = 0, double rotation_deg = 0) {
  return {Angle::degrees(flexion_deg), Angle::degrees(adduction_deg), Angle::degrees(rotation_deg)};
}

/// Latin letters become small; blanks and hyphens as the names have them.
std::string in_small_letters(std::string_view name) {
  std::string small(name);
  for (char& c : small) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    if (c == ' ' || c == '-') c = '_';
  }
  return small;
}

/// How far an angle may turn either way, degrees.
struct Ranges {
  double positive, negative;
};

/// Every angle of a joint both ways from zero, by its names.
std::vector<Motion> both_senses(Anatomy joint, Ranges first, Ranges second, Ranges third) {
  const std::array ranges{first, second, third};
  std::vector<Motion> motions;
  for (const JointAngle angle : all_joint_angles) {
    const auto i = static_cast<std::size_t>(angle);
    const auto& [positive_name, negative_name] = coordinate_names(joint)[i];
    motions.push_back(
        {std::string(positive_name), angle, positive, at(0), Angle::degrees(ranges[i].positive)});
    motions.push_back(
        {std::string(negative_name), angle, negative, at(0), Angle::degrees(ranges[i].negative)});
  }
  return motions;
}

std::vector<Motion> with_rotations_at_90_flexion(std::vector<Motion> motions, Anatomy joint) {
  const std::size_t count = motions.size();
  for (std::size_t i = count - 2; i < count; ++i) {
    Motion bent = motions[i];
    bent.name += std::string("_at_90_") + std::string(coordinate_names(joint)[0].positive);
    bent.start = at(90);
    motions.push_back(std::move(bent));
  }
  return motions;
}

/// Angles are the plane of elevation, the elevation and rotation. An arm that is lifted in the plane p from where it hangs is
/// turned by -p about its own axis: R_y(p) R_x(-e) R_y(-p) is the identity at e = 0, and goes on as the rotation by e about
/// one axis across that plane, X for abduction, Z for flexion.
std::vector<Motion> shoulder_motions() {
  const auto plane = JointAngle::flexion, elevation = JointAngle::adduction;
  const auto half = Angle::degrees(180), quarter = Angle::degrees(90), third = Angle::degrees(120);
  return {
      {"abduction", elevation, positive, at(0), half},
      {"flexion", elevation, positive, at(90, 0, -90), half},
      {"extension", elevation, positive, at(-90, 0, 90), quarter},
      {"horizontal_flexion", plane, positive, at(0, 90), half},
      {"horizontal_extension", plane, negative, at(0, 90), quarter},
      {"internal_rotation", rotation, positive, at(0), third},
      {"external_rotation", rotation, negative, at(0), third},
      {"internal_rotation_at_90_abduction", rotation, positive, at(0, 90), third},
      {"external_rotation_at_90_abduction", rotation, negative, at(0, 90), third},
  };
}

}  // namespace

std::vector<Motion> hip_motions() {
  const auto half = Angle::degrees(180), quarter = Angle::degrees(90), third = Angle::degrees(120);
  return {
      {"flexion", flexion, positive, at(0), half},
      {"extension", flexion, negative, at(0), quarter},
      {"abduction", adduction, negative, at(0), quarter},
      {"adduction", adduction, positive, at(0), quarter},
      {"internal_rotation", rotation, positive, at(0), third},
      {"external_rotation", rotation, negative, at(0), third},
      {"abduction_at_90_flexion", adduction, negative, at(90), quarter},
      {"adduction_at_90_flexion", adduction, positive, at(90), quarter},
      {"internal_rotation_at_90_flexion", rotation, positive, at(90), third},
      {"external_rotation_at_90_flexion", rotation, negative, at(90), third},
      {"fadir", rotation, positive, at(90, 15), third},
      {"faber", rotation, negative, at(45, -45), third},
  };
}

std::vector<Motion> built_in_motions(JointKind kind, Anatomy joint) {
  if (kind == JointKind::hinge) {
    const auto& [positive_name, negative_name] = coordinate_names(joint)[0];
    return {{std::string(positive_name), flexion, positive, at(0), Angle::degrees(180)},
            {std::string(negative_name), flexion, negative, at(0), Angle::degrees(180)}};
  }
  switch (joint) {
    case Anatomy::knee:
      return with_rotations_at_90_flexion(both_senses(joint, {180, 90}, {90, 90}, {120, 120}), joint);
    case Anatomy::ankle:
      return both_senses(joint, {90, 90}, {90, 90}, {120, 120});
    case Anatomy::elbow:
      return with_rotations_at_90_flexion(both_senses(joint, {180, 90}, {90, 90}, {180, 180}), joint);
    case Anatomy::shoulder:
      return shoulder_motions();
    case Anatomy::hip:
      break;
  }
  return hip_motions();
}

std::vector<Motion> with_own_motions(std::vector<Motion> built_in, std::span<const Motion> own) {
  std::map<std::string, std::size_t> places;
  for (std::size_t i = 0; i < built_in.size(); ++i) places.emplace(built_in[i].name, i);
  for (const Motion& motion : own) {
    const auto [known, is_new] = places.emplace(motion.name, built_in.size());
    if (is_new)
      built_in.push_back(motion);
    else
      built_in[known->second] = motion;
  }
  return built_in;
}

const Motion& motion_named(std::span<const Motion> motions, std::string_view name) {
  const auto is_named = [&](const auto& form) {
    return std::find_if(motions.begin(), motions.end(),
                        [&](const Motion& motion) { return form(motion.name) == form(name); });
  };
  auto found = is_named([](std::string_view as_written) { return std::string(as_written); });
  if (found == motions.end()) found = is_named(in_small_letters);
  if (found != motions.end()) return *found;
  std::vector<std::string> names;
  std::string list;
  for (const Motion& motion : motions) {
    names.push_back(motion.name);
    list += (list.empty() ? "" : ", ") + motion.name;
  }
  throw UsageError("unknown motion \"" + core::one_line(name, 40) + "\"" +
                   core::did_you_mean(in_small_letters(name), names) + "; there are " +
                   core::one_line(list, 2000));
}

void check_motion(const Motion& motion, JointKind kind) {
  const auto fail = [&](const char* what) { throw UsageError("motion \"" + motion.name + "\": " + what); };
  const double range = motion.range.radians();
  if (motion.sense == RotationSense::none) fail("it has no sense of rotation");
  if (!(range > 0)) fail("the range is empty");
  if (!(range <= two_pi)) fail("the range is more than a full turn");
  for (const JointAngle angle : all_joint_angles) {
    const double start = angle_of(motion.start, angle).radians();
    if (!std::isfinite(start)) fail("an angle is not finite");
    if (kind == JointKind::hinge && angle != JointAngle::flexion && (start != 0 || motion.vary == angle))
      fail("a hinge turns only in flexion");
  }
}

JointAngles turned_by(JointAngles from, JointAngle angle, Angle by) noexcept {
  Angle& changed = angle == JointAngle::flexion     ? from.flexion
                   : angle == JointAngle::adduction ? from.adduction
                                                    : from.internal_rotation;
  changed = changed + by;
  return from;
}

JointAngles MotionLimit::angles_at_limit() const noexcept {
  return turned_by(motion.start, motion.vary, end.turned * sign_of(motion.sense));
}

}  // namespace condyle::motion
