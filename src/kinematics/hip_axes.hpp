#pragma once

#include <optional>
#include <string>
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

  const Vec3& superior() const { return axes->superior(); }
  Vec3 lateral() const { return side == Side::right ? axes->right() : Vec3(-axes->right()); }
};

/// Axes and side that the bones agree with, and each piece of evidence with its vote.
struct HipAxes {
  std::vector<AgreeingAxes> agreeing;  ///< inferred if there is one
  std::string why_none;                ///< empty if there is one
  std::vector<std::string> evidence;   ///< one line each
};

/// Infers axes and side from four directions and from two measures of handedness, which hold for hips within 30 degrees
/// of their axes:
///
///       up                       The femur lies down and outwards of the head's centre, the neck outwards and down, the
///        |   .-.                 hip bone up and to the midline; the socket opens outwards and down. The cosine to
///   hip bone(   )                each is its vote for up and outwards. In front is where they need a handedness: a right
///        . - o - . outwards      hip read in RAS is a left one in LPS.
///              \ neck
///               | femur
///
/// On the given side only if one is. Without enough evidence several or none agree. Linear in the hip bone.
HipAxes hip_axes(const TriMesh& hip_bone, const HipAnatomy& hip, const std::optional<Side>& given);

/// Votes of neck, socket and hip bone for this side, in their margins, without axes but for up: of a mirrored hip the other side's.
double shape_vote(Side side, const TriMesh& hip_bone, const HipAnatomy& hip, const Vec3& up);

/// The side of a hip whose axes are known, as those of an image are, and the evidence.
struct SideInAxes {
  std::optional<Side> side;  ///< empty if the bones do not speak for one
  std::vector<std::string> evidence;
};

/// The same four directions vote for outwards; bones that an image cuts short vote as whole ones do.
SideInAxes side_in(const FrameDirections& axes, const HipAnatomy& hip);

}  // namespace condyle::kinematics
