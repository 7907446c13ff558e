#pragma once

#include <cstdint>

/// Joints of mesh files that were dropped on the page: read by the command line's own readers, placed as `condyle init` proposes.

extern "C" {

struct CondyleJoint;
struct CondyleMesh;

/// The mesh of a file's bytes; the extension of its name gives the format. Null for a bad file, with the command
/// line's own line in condyle_error().
CondyleMesh* condyle_read_mesh(const char* name, const std::uint8_t* bytes, int count);
void condyle_free_mesh(CondyleMesh* mesh);

/// The joint that `condyle init` proposes for a hip: centre fitted to the head, unit, axes and side inferred from the
/// bones. `side`: 0 right, 1 left, -1 to infer it from the bones. Null if something cannot be inferred, or for no
/// hip.
CondyleJoint* condyle_propose(const CondyleMesh* fixed, const CondyleMesh* mobile, int side);
/// 0 right, 1 left.
int condyle_side(const CondyleJoint* joint);
/// Number of vertices or triangles of the fixed body or of the mobile one, and their values, in the joint frame.
int condyle_vertex_count(const CondyleJoint* joint, int of_fixed);
int condyle_triangle_count(const CondyleJoint* joint, int of_fixed);
void condyle_mesh(const CondyleJoint* joint, int of_fixed, double* vertices, std::uint32_t* triangles);

/// Description of a joint that was proposed, as JSON in the form of `condyle rom --json` with these of its keys: motions
/// (all of the joint's, with their ends), notes, caveats (lines of evidence for side, centre, unit and axes), clock_plane,
/// normal_range_source, scope, bearing and provenance.
const char* condyle_description(CondyleJoint* joint);
}
