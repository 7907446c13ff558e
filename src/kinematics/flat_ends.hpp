#pragma once

#include <vector>

#include "condyle/joint.hpp"

namespace condyle::kinematics {

/// Planes that a bone was cut by and closed in, which its file does not say: a flat face of some size with all of the bone on one side.
/// No bone has one by nature: what is flat on it is not so to a hundredth of a millimetre. Near linear, and kept with the mesh.
const std::vector<ImageCut>& flat_ends(const Mesh& bone);

/// Flat ends farther from the joint centre than this, in radii of the head, are harmless: of two real hips, each bone cut at distances from 1.5 to
/// 5 radii from six sides, cuts beyond 2.3 moved none of twelve limits by half a degree.
inline constexpr double farthest_flat_end = 2.7;

/// Those of a body of a hip that are as near as that to its centre, without the faces where its image ends, and that of a socket's rim. None of
/// an implant, and of a body of several meshes that end motions, whose planes may be meant.
std::vector<ImageCut> flat_ends_near_joint(const Joint& joint, BodyRole body);

/// Whether a bone is little wider behind a face in a plane than there, as where it was cut off: the uppermost step of a staircase of voxels, a
/// millimetre high, has a section of many times its area as far behind it.
bool goes_on_behind(const TriMesh& bone, const ImageCut& plane, double face_area);

/// The distance from the joint centre to the triangles of the mesh that lie in a plane, mm, and the area of them all.
struct FlatFace {
  double distance_mm, area_mm2;
};
FlatFace face_in(const TriMesh& bone, const ImageCut& plane);

}  // namespace condyle::kinematics
