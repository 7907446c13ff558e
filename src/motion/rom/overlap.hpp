#pragma once

#include <cstddef>
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

/// A part of either body, by its place in its list, and what contact of the two is; with ContactKind::unknown, kinds differ.
struct PairOfParts {
  std::size_t fixed, mobile;
  ContactKind kind;
};

/// The parts of a joint's bodies that are tested for contact with each other.
///
///     mobile \ fixed                           not soft   not soft, not bearing   bearing   soft
///     ends (the first part)                    ends
///     bearing_on_bearing                                  ends                    slides
///     bearing                                  slides
///     soft                                     noted
///     all                                                                                   noted
///
/// Parts without triangles have no place, nor have their pairs. If bearing contact counts, what is not soft is one part.
struct PartsOfJoint {
  std::vector<PartOfMesh> fixed, mobile;
  std::vector<PairOfParts> impinging;  ///< contact of these ends a motion; one at least
  std::vector<PairOfParts> earlier;    ///< contact of these does not
  LeftOut left_out;                    ///< by the overlap options
};

/// Both bodies without what the options leave out. Throws UsageError for fewer than 0 rings, and MeshError if nothing of a body is
/// left that could end a motion.
PartsOfJoint parts_that_count(const Joint& joint, const OverlapOptions& options,
                              const BearingFinding& bearing, BearingRule rule);

/// One line for people whose meshes overlap: how much, where it is deepest, and what can be done.
std::string explain_overlap(const Joint& joint, const JointAngles& at);

}  // namespace condyle::motion
