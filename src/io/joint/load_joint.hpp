#pragma once

#include <filesystem>
#include <string_view>

#include "condyle/io/joint_file.hpp"

namespace condyle::io {

/// read_joint_file() of these bytes; files are found from the folder of `path`, which need not be there.
JointFile joint_file_of(std::string_view text, const std::filesystem::path& path);

/// The part of read_joint() after the joint file is read. Messages name `file.path`.
LoadedJoint load_joint(JointFile file);

}  // namespace condyle::io
