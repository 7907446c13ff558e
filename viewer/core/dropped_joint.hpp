#pragma once

#include <cstdint>

/// Joints of mesh files that were dropped on the page: read by the command line's own readers, placed as `condyle init` proposes.

extern "C" {

struct CondyleJoint;
struct CondyleMesh;

/// The mesh of a file's bytes; the ending of its name tells the format. Null for a bad file, with the command line's own line in
/// condyle_error().
CondyleMesh* condyle_read_mesh(const char* name, const std::uint8_t* bytes, int count);
void condyle_free_mesh(CondyleMesh* mesh);

/// The joint that `condyle init` proposes for a hip: centre fitted to the head, unit, axes and side told by the bones. `side`: 0
/// right, 1 left, -1 to be told by the bones. Null where something cannot be told, or for no hip.
CondyleJoint* condyle_propose(const CondyleMesh* fixed, const CondyleMesh* mobile, int side);
/// 0 right, 1 left.
int condyle_side(const CondyleJoint* joint);
/// Of the fixed body or of the mobile one: how many vertices and triangles, and what they are, in the joint frame.
int condyle_vertex_count(const CondyleJoint* joint, int of_fixed);
int condyle_triangle_count(const CondyleJoint* joint, int of_fixed);
void condyle_mesh(const CondyleJoint* joint, int of_fixed, double* vertices, std::uint32_t* triangles);

/// Of a joint that was proposed: what told its side, centre, unit and axes, and what looks wrong with it; and the ends of all its
/// motions. As JSON: {"told": [line, ...], "notes": [{"code", "text"}, ...], "motions": [as in `condyle rom --json`, ...]}.
const char* condyle_description(CondyleJoint* joint);
}
