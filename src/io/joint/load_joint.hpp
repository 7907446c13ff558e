#pragma once

#include "condyle/io/joint_file.hpp"

namespace condyle::io {

/// What read_joint() does once the joint file is read. `file.path` is what messages name.
LoadedJoint load_joint(JointFile file);

}  // namespace condyle::io
