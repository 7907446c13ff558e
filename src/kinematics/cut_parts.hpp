#pragma once

#include <string>
#include <vector>

#include "condyle/joint.hpp"

namespace condyle::kinematics {

/// Parts that were cut from the meshes of a joint.
struct CutParts {
  /// The number before of each vertex of the mobile body, no_index of a new one. Empty if the body is whole.
  std::vector<Index> mobile_vertex_before = {};
  std::vector<std::string> processing = {};  ///< a line for each part that was cut
};

/// Cuts the parts that have planes from the first of their meshes, in their order: what lies behind all planes becomes a mesh that has the
/// part's name, after the mesh that it is cut from, which keeps the rest and its own name. Parts then name the meshes that they move.
///
/// Throws UsageError ("part fragment: ...") for a mesh that there is not, one that lies on both sides of the planes beside the one that is cut,
/// and what cut_by_planes() refuses; MeshError for a mesh without an inside.
CutParts cut_parts(std::vector<PosedPart>& parts, Body& fixed, Body& mobile);

/// The surface of a body without the flat faces in which parts were cut from it, with the numbers of its vertices: what spheres and rims are
/// searched for on. The mesh itself if nothing was cut. Kept with the mesh.
const Mesh& uncut_surface(const Body& body);

/// 1 for each vertex of a face in which a part was cut; empty if nothing was.
std::vector<char> cut_vertices(const Body& body);

}  // namespace condyle::kinematics
