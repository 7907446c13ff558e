#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/io/model_file.hpp"

namespace condyle::io {

/// A body that moves with the parent's or the child's of a joint, and where it lies in that one.
struct WeldedBody {
  std::string name;
  Pose X = Pose::Identity();
};

/// Welds and meshes of a model by the names of their bodies, so that those of one joint are found without a look at all. Borrows
/// the model.
class WeldedBodies {
 public:
  explicit WeldedBodies(const Model& model);

  /// The body itself, then all that chains of welds join to it, from either side. Throws FileError for a weld that cannot be read.
  std::vector<WeldedBody> of(const ModelJoint& joint, BodyRole role) const;

  /// Their meshes, with poses in the body. Throws as of() does, and for a mesh that cannot be read.
  std::vector<ModelMesh> meshes_of(const ModelJoint& joint, BodyRole role) const;

  /// What hangs together by welds, readable or not.
  struct Group {
    std::size_t number = 0;  ///< equal for bodies that hang together
    std::size_t size = 0;    ///< bodies, ends of welds and meshes
  };
  Group group_of(const ModelJoint& joint, BodyRole role) const;

 private:
  void find_groups();

  const Model& model_;
  std::map<std::string_view, std::vector<const ModelJoint*>> welds_;  ///< in the order of the model
  std::map<std::string_view, std::vector<const ModelMesh*>> meshes_;  ///< likewise
  std::map<std::string_view, std::size_t> group_;
  std::vector<std::size_t> group_size_;
};

}  // namespace condyle::io
