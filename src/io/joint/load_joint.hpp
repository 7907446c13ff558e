#pragma once

#include "condyle/io/joint_file.hpp"

namespace condyle::io {

/// The part of read_joint() after the joint file is read. Messages name `file.path`.
LoadedJoint load_joint(JointFile file);

}  // namespace condyle::io
