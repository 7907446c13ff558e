#pragma once

#include <span>
#include <string>
#include <vector>

#include "condyle/mesh.hpp"

namespace condyle::mesh {

/// Cuts a closed mesh by planes into what lies behind all of them and the rest, two closed meshes:
///
///        ___________________
///       |         ^ n       |        inner: behind all planes, closed by a flat face in each
///       |    _____|____     |        outer: the rest, closed by the same faces turned round: no walls in it
///       |   |          |->n |
///       |___|__________|____|
///
/// Vertices of the mesh keep every bit, and both sides share those of the faces: volumes add up but for the rounding of points on edges. A
/// vertex nearer to a plane than on_plane_mm counts as on it. Triangles that lie in a plane belong to the side that their solid is on. If a
/// hollow only touches a plane, in a vertex or an edge, the outer side touches its own face there.

/// A side of triangles cut nearer than this to a vertex would be narrower than what points on edges are rounded to allows: mm.
inline constexpr double on_plane_mm = 1e-6;

/// The inner side is where the unit normal points away from.
struct CuttingPlane {
  Vec3 point = Vec3::Zero(), normal = Vec3::UnitX();
};

struct CutSide {
  TriMesh mesh;                   ///< vertices in the order of the mesh that was cut, then those of the cuts
  std::size_t cut_triangles = 0;  ///< the last ones: those of the flat faces
  std::vector<Index> vertex_before =
      {};  ///< of each vertex its number in the mesh that was cut; no_index of a new one
};

struct CutMesh {
  CutSide inner, outer;
  std::vector<double>
      face_mm2;  ///< of the inner side, of each plane; 0 of one that cuts off nothing that the others leave
  double inner_mm3 = 0, outer_mm3 = 0;
  std::size_t pieces_behind =
      1;  ///< behind all planes. The largest is the inner side, the others stay with the rest.
  std::size_t outer_pieces = 1;
};

/// Throws UsageError if a plane misses the mesh, if nothing lies behind all of them, and if an outline cannot be closed because the surface
/// crosses itself: "plane 2 misses it: ...". MeshError as require_solid() for a mesh without an inside.
///
/// Linear in the mesh for each plane, and square in the edges of an outline.
CutMesh cut_by_planes(const Mesh& mesh, const std::string& name, std::span<const CuttingPlane> planes);

}  // namespace condyle::mesh
