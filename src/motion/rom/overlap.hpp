#pragma once

#include <optional>
#include <string>
#include <vector>

#include "condyle/bearing.hpp"
#include "condyle/range_of_motion.hpp"

/// Effects of OverlapOptions: the triangles that count, and texts for users whose meshes overlap.

namespace condyle::motion {

/// A mesh without some of its triangles: the same vertices, and the numbers of the triangles that stayed.
struct PartOfMesh {
  Mesh mesh;
  std::vector<Index> triangle_in_whole;
};

/// The parts of a joint's bodies that are tested for contact.
struct PartsOfJoint {
  PartOfMesh fixed;
  PartOfMesh mobile;                  ///< what ends motions
  std::optional<PartOfMesh> bearing;  ///< of the mobile body, where it does not count
  LeftOut left_out;                   ///< by the overlap options
};

/// Both bodies without what the options leave out; where bearing contact is not to count, the mobile one without its
/// bearing surface. Throws UsageError for fewer than 0 rings, and MeshError if nothing of a body is left.
PartsOfJoint parts_that_count(const Joint& joint, const OverlapOptions& options,
                              const std::optional<BearingSurface>& bearing, BearingRule rule);

/// One line for people whose meshes overlap: how much, where it is deepest, and what can be done.
std::string explain_overlap(const Joint& joint, const JointAngles& at);

}  // namespace condyle::motion
