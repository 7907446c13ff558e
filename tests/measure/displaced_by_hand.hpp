#pragma once

#include "condyle/joint.hpp"

namespace condyle::test {

/// A joint that is not quite the one given.
struct HandDisplacement {
  Vec3 centre;                           ///< of the joint, mm
  Vec3 axes;                             ///< rotation vector of its frame, rad
  double fixed_surface, mobile_surface;  ///< mm along the normals
};

/// Both surfaces moved along their normals and brought to the displaced frame, in arithmetic of its own. With `head`, the head's sphere,
/// stated: its centre as far from the joint's as it was, its radius with the surface. Without, it is left to be found.
Joint displaced_by_hand(const Joint& joint, const HandDisplacement& by, const std::optional<Sphere>& head);

}  // namespace condyle::test
