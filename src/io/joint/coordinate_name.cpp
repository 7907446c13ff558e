#include "io/joint/coordinate_name.hpp"

#include "condyle/joint_coordinates.hpp"

namespace condyle::io {

std::vector<CoordinateName> coordinate_names_of(JointKind kind, Anatomy joint) {
  std::vector<CoordinateName> names;
  for (const AngleNames& angle : coordinate_names(joint)) {
    names.push_back({std::string(angle.positive), CoordinateKind::angle});
    if (kind == JointKind::hinge) return names;
  }
  if (kind == JointKind::free)
    for (const char* name : {"x", "y", "z"}) names.push_back({name, CoordinateKind::length});
  return names;
}

}  // namespace condyle::io
