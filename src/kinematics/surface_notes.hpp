#pragma once

#include <optional>
#include <string>
#include <vector>

#include "condyle/joint_checks.hpp"

/// What a surface says against having an inside, for joints and for two meshes without one.

namespace condyle::kinematics {

/// Notes on a mesh that is open, of mixed orientation, two-sided or inside out, on pieces that are, and on triangles that are there twice. Linear
/// for most meshes. Pieces are looked for only if they are many, or not known to be one.
std::vector<JointNote> surface_notes(const std::string& name, const Mesh& mesh, bool is_one_piece = false);

/// A mesh that crosses itself on more than the smallest share of its surface. Kept with the mesh.
std::optional<JointNote> self_crossing_note(const std::string& name, const Mesh& mesh);

/// Whether a mesh has an inside that means one: closed, its normals outwards, not two-sided.
bool is_solid(const Mesh& mesh);

}  // namespace condyle::kinematics
