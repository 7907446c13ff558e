#pragma once

#include <string>
#include <vector>

#include "condyle/overlap_options.hpp"

/// What OverlapOptions come to: the triangles that count, and words for people whose meshes overlap.

namespace condyle::motion {

/// A mesh without some of its triangles: the same vertices, and the numbers of the triangles that stayed.
struct PartOfMesh {
  TriMesh mesh;
  std::vector<Index> triangle_in_whole;

  std::size_t left_out(const TriMesh& whole) const noexcept {
    return whole.triangles.size() - mesh.triangles.size();
  }
};

struct PartsOfJoint {
  PartOfMesh fixed, mobile;
};

/// Both bodies without what the options leave out. Throws UsageError for a radius that is not above 0, a
/// cone without an axis or fewer than 0 rings, and MeshError where nothing of a body is left.
PartsOfJoint parts_that_count(const Joint& joint, const OverlapOptions& options);

/// One line for people whose meshes overlap: how much, where it is deepest, and what can be done.
std::string explain_overlap(const Joint& joint, const JointAngles& at);

}  // namespace condyle::motion
