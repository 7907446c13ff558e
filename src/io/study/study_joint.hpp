#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "condyle/io/joint_file.hpp"
#include "io/study/study_table.hpp"

namespace condyle::io {

/// The joint of a row, and codes of what its label map or model must be read with.
struct StudyJoint {
  LoadedJoint loaded;
  /// Without those that check_joint() has too, and without what nearly every model has: `not_used`, `welded`.
  std::vector<std::string> codes = {};
};

/// The joint of a joint file, of two meshes, of two bones of a label map, or a sample hip of its measures; at the values in the column `parameters`. Throws what
/// read_joint() does; FileError if the row does not say which, or a field is not what it must be.
StudyJoint load_joint(const StudyTable& table, const StudyRow& row);

/// Start of messages about the joint: its joint file, else the row's line, "table.csv: line 7".
std::string place_of(const StudyTable& table, const StudyRow& row);

/// Whether the row's joint is made, not read.
bool is_sample(const StudyTable& table, const StudyRow& row);

/// The files that the row names, those too that its joint file names; as many as can be known where one of them cannot be read.
std::vector<std::filesystem::path> files_of(const StudyTable& table, const StudyRow& row);

/// The recorded motion that the row's translation is to follow: column `follow`. Empty: none.
std::filesystem::path followed_file(const StudyTable& table, const StudyRow& row);

}  // namespace condyle::io
