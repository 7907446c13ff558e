#pragma once

#include <optional>

#include "condyle/fit.hpp"

namespace condyle::kinematics {

/// What two bones say of how a hip lies in the frame of its meshes, before any frame is known. Directions are unit, mm.
struct HipAnatomy {
  SphericalPatch head;
  std::optional<SphericalPatch> socket;
  Vec3 towards_femur;   ///< from the head's centre to the centroid of the femur's surface: down the shaft
  Vec3 towards_pelvis;  ///< to that of the hip bone's surface: up and to the midline
  std::optional<Vec3> opening;  ///< of the socket: to the side, down and forwards
};

/// Of a surface, by area; the origin where it has none.
Vec3 area_centroid(const TriMesh& mesh);

/// The socket around a head: the spherical part of the fixed body near it; empty where there is none.
std::optional<SphericalPatch> find_socket(const TriMesh& fixed, const Sphere& head);

/// Of a femur whose head lies near the hip bone; empty where no head is found there. Some milliseconds per 10,000
/// triangles.
std::optional<HipAnatomy> hip_anatomy(const TriMesh& hip_bone, const TriMesh& femur);

}  // namespace condyle::kinematics
