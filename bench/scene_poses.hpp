#pragma once

#include <vector>

#include "scenes.hpp"

namespace bench {

inline constexpr int poses_per_scene = 128;

/// Poses of two bones that are apart in the neutral pose: turned about axes spread evenly over the sphere, to
/// a part of the way to their first contact, to just past it, and on into the bone by 5 to 25 degrees. The
/// way is the exact one (`first_contact`) of the meshes given, at most 180 degrees.
std::vector<ScenePose> poses_to_contact(const condyle::TriMesh& fixed, const condyle::TriMesh& mobile);

/// Poses of two surfaces that match as ball and socket do with this clearance in mm: turned by up to
/// `largest_turn` about axes spread evenly, and moved within 40 degrees of the direction in which the socket
/// is deepest: 0.3 mm out of it or not at all (free), in by the clearance (grazing), in by 0.5 mm more
/// (deep).
std::vector<ScenePose> poses_in_socket(double clearance_mm, const condyle::Vec3& into_socket,
                                       condyle::Angle largest_turn);

}  // namespace bench
