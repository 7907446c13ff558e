#pragma once

#include "condyle/answer/depth.hpp"
#include "condyle/error.hpp"
#include "condyle/joint.hpp"
#include "condyle/motion_contact.hpp"

namespace condyle::answer {

/// A mesh that bounds no solid, for a method that needs one.
struct NoSolidError : MeshError {
  NoSolidError(const MeshError& error, bool normals) : MeshError(error), normals_would_do(normals) {}
  bool normals_would_do;  ///< DepthMethod::normal accepts it
};

/// Which meshes a method needs: solids, whose inside is sought along rays and arcs; surfaces with an outer side, along normals. Throws
/// NoSolidError and MeshError; `names` begin them.
void require_depth_meshes(const Joint& joint, DepthMethod method, const motion::BodyNames& names);

}  // namespace condyle::answer
