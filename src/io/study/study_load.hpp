#pragma once

#include <string>
#include <vector>

#include "condyle/answer.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/io/study.hpp"
#include "condyle/motion_contact.hpp"
#include "io/study/study_columns.hpp"

namespace condyle::io {

std::vector<ResultColumn> load_columns();

/// The joint's surfaces and layers with these changes. FileError if it has no layers.
ContactEntry study_contact_of(const LoadedJoint& loaded, const ContactChanges& changes);

/// Components anterior, superior, lateral in the joint frame of either side.
Vec3 in_joint_frame(const Joint& joint, const Vec3& anterior_superior_lateral);

/// A load on this joint, and what was asked for. FileError if it has no layers.
struct StudyLoadAnswer {
  LoadRequest request;
  LoadAnswer answer;
};
StudyLoadAnswer study_load_answer(const LoadedJoint& loaded, const StudyLoad& load);

/// The columns of this joint. FileError if it has no layers.
struct LoadFields {
  std::vector<std::string> fields;
  std::vector<motion::ContactNote> notes;  ///< on layers, load and contact
};
LoadFields load_fields(const LoadedJoint& loaded, const StudyLoad& load);

}  // namespace condyle::io
