#pragma once

#include <ostream>

#include "condyle/joint_coordinates.hpp"
#include "condyle/radial.hpp"
#include "simd/instruction_set.hpp"

/// Parameters of tests as GoogleTest prints them: by name, not as the bytes of the object.

namespace condyle {

inline const char* name_of(JointAngle angle) {
  switch (angle) {
    case JointAngle::flexion:
      return "flexion";
    case JointAngle::adduction:
      return "adduction";
    case JointAngle::internal_rotation:
      return "internal_rotation";
  }
  return "?";
}
inline void PrintTo(JointAngle angle, std::ostream* out) {
  *out << name_of(angle);
}
inline const char* name_of(Side side) {
  return side == Side::right ? "right" : "left";
}
inline void PrintTo(Side side, std::ostream* out) {
  *out << name_of(side);
}

inline void PrintTo(DirectionMapKind kind, std::ostream* out) {
  *out << (kind == DirectionMapKind::cube ? "cube" : "cartesian");
}

}  // namespace condyle

namespace condyle::simd {

inline void PrintTo(const InstructionSet& set, std::ostream* out) {
  *out << set.name;
}

}  // namespace condyle::simd
