#pragma once

#include <optional>

#include "condyle/fit.hpp"

namespace condyle::kinematics {

/// Evidence of two bones on how a hip lies in the frame of its meshes, before any frame is known. Directions are
/// unit, mm.
struct HipAnatomy {
  SphericalPatch head;
  std::optional<SphericalPatch> socket;
  Vec3 towards_femur;   ///< from the head's centre to the centroid of the femur's surface: down the shaft
  Vec3 towards_pelvis;  ///< to that of the hip bone's surface: up and to the midline
  std::optional<Vec3> towards_neck;  ///< to the femur's surface just beyond the head: down and to the side
  Vec3 femur_end, hip_bone_end;      ///< their vertices farthest from the centre of the head, from it; mm
  std::optional<Vec3> opening;       ///< of the socket: to the side, down and forwards
};

/// Centroid of a surface, by area; the origin if it has none.
Vec3 area_centroid(const TriMesh& mesh);

/// The radius that a socket may have, in that of its head.
inline constexpr double largest_socket_in_heads = 1.4;

/// The sphere with most supporting area on the fixed body near a head; empty if there is none.
std::optional<SphericalPatch> sphere_around(const TriMesh& fixed, const Sphere& head,
                                            std::size_t resamples = 0);

/// The mean direction from the head's centre, by area, of the surface at the neck's distance; empty if there is none.
std::optional<Vec3> towards_neck(const TriMesh& femur, const Sphere& head);

/// Whether a head has room in a socket, but for the roughness of its surface and half a millimetre that cartilages give way.
bool fits_into(const Sphere& head, const SphericalPatch& socket);

/// The socket around a head: that sphere; empty if there is none, or if the head does not fit into it.
std::optional<SphericalPatch> find_socket(const TriMesh& fixed, const Sphere& head);

/// Whether a hip bone lies about a sphere as about a head: it is seen from the centre at 0.9 to 1.5 radii in a share of all directions.
/// Linear in the hip bone.
bool lies_about(const TriMesh& hip_bone, const Sphere& head);

/// The socket of most support that a hip bone has, of a fifth of a sphere at least, wherever its head is.
std::optional<SphericalPatch> full_socket(const TriMesh& hip_bone);

/// The head of a femur: the fullest spherical part that lies in a socket of the hip bone, or if no socket is about any, what fits the one that
/// the hip bone has. Of a hip bone without a socket, as of a coarse model, the fullest part near it. Empty if there is none: a condyle or a trochanter is
/// no head.
std::optional<SphericalPatch> head_in_socket(const TriMesh& hip_bone, const TriMesh& femur,
                                             std::size_t resamples = 0,
                                             std::optional<bool> femur_is_open = {});

/// Anatomy of a femur whose head lies near the hip bone; empty if no head is found there, and if the bones are exchanged: what is found has
/// no socket, and the hip bone has a fuller head in a socket of the femur. Some milliseconds per 10,000 triangles.
std::optional<HipAnatomy> hip_anatomy(const TriMesh& hip_bone, const TriMesh& femur);

}  // namespace condyle::kinematics
