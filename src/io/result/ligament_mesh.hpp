#pragma once

#include <span>
#include <vector>

#include "condyle/io/mesh_file.hpp"
#include "condyle/io/picture.hpp"
#include "condyle/joint.hpp"

namespace condyle::io {

/// Ligaments as thin tubes in F, to look at, and of each triangle the number of its ligament in the joint, its strain and its tension in N; NaN
/// where its length is not known.
struct LigamentMesh {
  TriMesh mesh;
  std::vector<MeshArray> arrays;
};
LigamentMesh ligament_mesh(std::span<const Ligament> ligaments, const Pose& X_FM);

/// The same as marks of a picture: grey while slack, green when taut, vermilion at the strain that ends motions, purple where the length is
/// not known.
std::vector<PictureMark> ligament_marks(std::span<const Ligament> ligaments, const Pose& X_FM);

}  // namespace condyle::io
