#pragma once

#include "condyle/io/model_file.hpp"

namespace condyle::io {

/// The joint file that is proposed for a joint of a model, as it would be read beside the model; no mesh is. Its notes stand in
/// `processing`, its digest is the model's. Throws as propose_joint() does, and FileError if no mesh of a body is there.
JointFile joint_file_of(const Model& model, ModelJointRequest request);

}  // namespace condyle::io
