#pragma once

#include <string>
#include <vector>

#include "condyle/io/joint_file.hpp"
#include "condyle/io/study.hpp"
#include "condyle/motion_contact.hpp"
#include "io/study/study_columns.hpp"

namespace condyle::io {

std::vector<ResultColumn> load_columns();

/// Those columns of this joint. FileError if it has no layers.
struct LoadFields {
  std::vector<std::string> fields;
  std::vector<ContactNote> notes;  ///< on layers, load and contact
};
LoadFields load_fields(const LoadedJoint& loaded, const StudyLoad& load);

}  // namespace condyle::io
