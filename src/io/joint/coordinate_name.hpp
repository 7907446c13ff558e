#pragma once

#include <string>
#include <vector>

#include "condyle/io/recorded_motion.hpp"
#include "condyle/joint.hpp"

namespace condyle::io {

/// A coordinate that a joint has, and so one that a table of it may name.
struct CoordinateName {
  std::string name;
  CoordinateKind kind = CoordinateKind::angle;
};

/// Names of a joint's coordinates: angles by their positive names, and for a free joint x, y and z.
std::vector<CoordinateName> coordinate_names_of(JointKind kind, Anatomy joint);

}  // namespace condyle::io
