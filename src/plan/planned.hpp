#pragma once

#include <string>

#include "condyle/joint.hpp"
#include "core/formatted.hpp"

namespace condyle::plan {

/// Adds what a plan did to the bones of a joint to what earlier plans did.
inline void add_planned(Joint& joint, const std::string& done) {
  joint.planned += (joint.planned.empty() ? "" : ", ") + done;
}

/// "without 164.1 mm3 of femur"
inline std::string without_bone(double volume_mm3, const std::string& bone) {
  return core::formatted("without %.1f mm3 of ", volume_mm3) + bone;
}

}  // namespace condyle::plan
