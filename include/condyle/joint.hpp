#pragma once

#include <string>

#include "condyle/joint_coordinates.hpp"
#include "condyle/mesh.hpp"

namespace condyle {

/// One bone (or cartilage) of a joint, by the name its user gave it.
struct Body {
  std::string name;
  Mesh mesh;
};

/// Two bodies and how one rotates in the other. Both meshes are in the joint frame of joint_coordinates.hpp:
/// millimetres, origin at the joint centre, X anterior, Y superior, Z to the subject's right. The mobile mesh
/// is the one of zero angles: pose_at(coordinates(), angles) brings it to any other.
struct Joint {
  std::string name;
  JointKind kind;
  Side side;
  Body fixed;
  Body mobile;
  Anatomy anatomy = Anatomy::hip;  ///< of a hinge: the hip stands for any joint that flexes forwards
  TranslationFrame translation_frame = TranslationFrame::fixed;  ///< of a free joint

  CoordinateSystem coordinates() const noexcept { return {anatomy, side}; }
  /// False of a hinge that flexes forwards and is no joint in particular.
  bool names_its_joint() const noexcept { return anatomy != Anatomy::hip || kind != JointKind::hinge; }
  /// With a head in a socket, for all that is told by those.
  bool is_hip() const noexcept { return anatomy == Anatomy::hip && names_its_joint(); }
};

}  // namespace condyle
