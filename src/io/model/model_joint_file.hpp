#pragma once

#include "condyle/io/model_file.hpp"

namespace condyle::io {

/// The joint file that is proposed for a joint of a model, and what the model has and the file has not.
struct JointFileOfModel {
  JointFile file;
  std::vector<ModelNote> notes;
};

/// As it would be read beside the model; no mesh is. The notes stand in `processing` too, the digest is the model's. Throws as
/// propose_joint() does, and FileError if no mesh of a body is there.
JointFileOfModel joint_file_of(const Model& model, ModelJointRequest request);

}  // namespace condyle::io
