#pragma once

#include <string>
#include <string_view>

#include "condyle/io/joint_file.hpp"

namespace condyle::python {

/// All of a joint as bytes, every number to the last bit, for pickle. They are read by the same version only.
std::string state_of(const io::LoadedJoint& joint);

/// The joint of such bytes. UsageError where they are of another version, or cut off.
io::LoadedJoint joint_of_state(std::string_view state);

}  // namespace condyle::python
