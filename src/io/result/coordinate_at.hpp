#pragma once

#include <cstddef>

#include "condyle/joint.hpp"

namespace condyle::io {

/// A coordinate of a pose, in degrees or mm: the one of this number among coordinate_names_of() of the joint.
double coordinate_at(const Joint& joint, const Pose& X_FM, std::size_t number);

}  // namespace condyle::io
