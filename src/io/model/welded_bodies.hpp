#pragma once

#include <string>
#include <vector>

#include "condyle/io/model_file.hpp"

namespace condyle::io {

/// A body that moves with the parent's or the child's of a joint, and where it lies in that one.
struct WeldedBody {
  std::string name;
  Pose X = Pose::Identity();
};

/// The body itself, then all that chains of welds join to it, from either side. Throws FileError for a weld that cannot be read.
std::vector<WeldedBody> welded_bodies(const Model& model, const ModelJoint& joint, BodyRole role);

}  // namespace condyle::io
