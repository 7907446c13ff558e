#pragma once

#include <optional>

#include "condyle/fit.hpp"
#include "condyle/pose.hpp"

namespace condyle::kinematics {

/// The part of a bone's surface that lies nearest to another bone: where their joint is, before any frame is known.
struct FacingPart {
  Vec3 centre;  ///< centroid, by area, of the vertices within facing_depth_mm of the nearest
  double
      apart_mm;  ///< of the nearest vertices; the other bone's are thinned out, so it may be some mm too much
};

/// Curved joint surfaces leave each other by so much over a part that stands for all of them.
inline constexpr double facing_depth_mm = 10;

/// Empty if either bone has no surface, or coordinates that overflow. Linear in the bone, and in the other.
std::optional<FacingPart> facing_part(const TriMesh& bone, const TriMesh& other);

/// The same of some 1000 vertices of each, the other bone posed in the frame of this one: the centre is off by a few mm.
std::optional<FacingPart> facing_part_roughly(const TriMesh& bone, const TriMesh& other,
                                              const Pose& X_bone_other);

}  // namespace condyle::kinematics
