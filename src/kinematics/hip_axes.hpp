#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "condyle/make_joint.hpp"
#include "kinematics/hip_anatomy.hpp"

namespace condyle::kinematics {

/// Axes that segmentations and models come in, in the frame of the meshes.
struct KnownAxes {
  std::string_view name;
  FrameDirections directions;

  const Vec3& anterior() const { return directions.anterior; }
  const Vec3& superior() const { return directions.superior; }
  Vec3 right() const { return anterior().cross(superior()); }
};

struct AgreeingAxes {
  const KnownAxes* axes;
  Side side;
};

/// Frames and sides that agree with the bones, on the given side only where one is; without a socket's opening front and
/// back are not told apart.
std::vector<AgreeingAxes> agreeing_axes(const HipAnatomy& hip, const std::optional<Side>& given);

}  // namespace condyle::kinematics
