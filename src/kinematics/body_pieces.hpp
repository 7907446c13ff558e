#pragma once

#include <optional>
#include <string>
#include <vector>

#include "condyle/fit.hpp"
#include "condyle/joint.hpp"
#include "condyle/joint_checks.hpp"

/// The connected pieces of a body, where an anatomist means one bone: specks that a segmentation left, a second bone or leg, walls within.

namespace condyle::kinematics {

/// Notes on the pieces of one mesh, which is called `name`: those inside others, unless they are small cavities, and those beside the largest, unless
/// planes cut the mesh in parts.
std::vector<JointNote> piece_notes(const std::string& name, const Mesh& mesh, bool is_cut);

/// A piece in words: "4 triangles, 0.6 mm across, near (1.0, 2.0, 3.0)". `piece` is its number among those of the mesh.
std::string piece_text(const Mesh& mesh, std::size_t piece);

/// The outer surface of a mesh without pieces that come nowhere near a head: nowhere within twice its radius of its centre.
TriMesh pieces_about(const Mesh& mesh, const Sphere& head);

/// Vertices of the socket and of the head of a joint; none if they are not known.
struct OwnVertices {
  std::vector<Index> fixed = {}, mobile = {};
};
OwnVertices own_vertices(const Joint& joint, const std::optional<Sphere>& head);

/// The number of the piece on which a vertex lies, if it holds neither `own`, vertices of the head or socket, nor most of its mesh. If
/// there are no such vertices, the largest piece of a mesh counts as most of it.
std::optional<std::size_t> stray_piece(const Body& body, Index vertex, const std::vector<Index>& own);

}  // namespace condyle::kinematics
