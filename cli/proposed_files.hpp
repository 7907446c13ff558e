#pragma once

#include <filesystem>

#include "condyle/io/joint_file.hpp"
#include "condyle/io/label_file.hpp"

/// Joint files that are proposed: what is said of them, and where they are written.

namespace condyle::cli {

/// Throws FileError if it is there, with why it is kept: "and may have been edited".
void refuse_existing(const std::filesystem::path& path, const char* why);

/// Notes what stands in a proposal as comments.
void note_to_fill_in(const io::JointProposal& proposal);

/// Writes a joint of label maps and the surfaces of its bones beside it, all or none of them, and says its notes. FileError.
void write_proposal(const io::LabelJoint& joint, const std::filesystem::path& joint_file);

}  // namespace condyle::cli
