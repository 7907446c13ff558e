#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "condyle/fit.hpp"
#include "condyle/joint.hpp"
#include "kinematics/shallow_socket.hpp"
#include "kinematics/socket_rim.hpp"

/// Head, socket and rim of a hip or shoulder, each found when it is first needed and kept with the mesh it is on, as a mesh keeps its
/// edges: checks, bearing surfaces, zones and clocks share them. All look at surface that faces the outside only. From any thread.

namespace condyle::kinematics {

/// The head about the joint centre, which is the origin of M, which decides the bearing surface; empty if there is none.
const std::optional<SphericalPatch>& head_near_centre(const Mesh& mobile);
/// The fullest sphere anywhere on the body.
const std::optional<SphericalPatch>& head_anywhere(const Mesh& mobile);
/// Keeps the head that these vertices are, which a search of the whole surface found before the mesh was placed. Does
/// nothing if the head near the centre is known.
void keep_head(const Mesh& mobile, const std::vector<Index>& vertices);
/// Keeps the head that this sphere is, which is known: that of a bone before it was cut. Does nothing if the head near the centre is
/// known.
void keep_head(const Mesh& mobile, const Sphere& head);
/// The head that was kept so by its vertices; empty if none was.
const std::optional<SphericalPatch>& fitted_head(const Mesh& mobile);

/// sphere_around(), into which the head may not fit, and socket_rim(); for the latest few heads.
std::shared_ptr<const std::optional<SphericalPatch>> socket_around(const Mesh& fixed, const Sphere& head);
/// The socket of a body: the one that is stated, with what lies on it, or socket_around() the head. A stated one on which nothing lies has
/// no vertices.
std::shared_ptr<const std::optional<SphericalPatch>> socket_of(const Body& fixed, const Sphere& head);
std::shared_ptr<const std::optional<SocketRim>> rim_around(const Mesh& fixed, const Sphere& head);
/// find_shallow_socket(), likewise.
std::shared_ptr<const std::optional<ShallowSocket>> shallow_socket_around(const Mesh& fixed,
                                                                          const Sphere& head);

}  // namespace condyle::kinematics
