#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "condyle/joint.hpp"

/// From where the angles of a joint count, and how the femur of a hip lies there.

namespace condyle {

/// As in files: "as_given".
std::string_view name_of(ZeroFrom from) noexcept;

/// A femur lies in neutral where its mechanical axis, from between its condyles to the head's centre, points superior, and the line behind both
/// condyles to the right: the axes of Wu et al. (2002) with the condyles' backs for the epicondyles, which lie 3 to 6 degrees
/// farther outwards. How far a scan may be from it unmentioned, in any angle: the axes of a pelvis, and condyles, are not known better.
inline constexpr double most_off_neutral_deg = 5;

/// What is known of the pose at which a joint's angles are zero.
struct ZeroPose {
  ZeroFrom from = ZeroFrom::as_given;
  /// The angles at which the femur of a hip lies there, by its condyles: all 0 in neutral. Empty without condyles, and for other joints.
  std::optional<JointAngles> femur = {};

  /// Whether the condyles say that zero is not neutral. Landmarks of both bodies are believed.
  bool is_turned() const noexcept;
  /// Whether zero is neutral as far as anybody can know: only then limits are compared with those of other people.
  bool is_neutral() const noexcept;
};

/// Some milliseconds per 100,000 triangles after the head is found; kept with the mesh.
ZeroPose zero_pose(const Joint& joint);

/// "the pose in which femur is given; it shows no condyles, so how the leg lay is not known": where zero is.
std::string zero_text(const Joint& joint, const ZeroPose& zero);

}  // namespace condyle
