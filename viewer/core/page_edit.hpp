#pragma once

#include <cstdint>

/// Changes of a joint by hand: strokes of a brush on its bones (condyle/brush.hpp), and its centre moved. After a stroke every query of
/// page_core.hpp answers for the bone as it is then.

extern "C" {

struct CondyleJoint;

/// Makes a bone ready for strokes: `of_fixed` 1 the fixed one, 0 the mobile one. `before`: x, y and z of each vertex where its surface was before
/// a cut, null if it is as it was. What contact of each triangle means stays as it is now. How many vertices are protected.
int condyle_brush(CondyleJoint* joint, int of_fixed, const double* before);
/// A stroke along these vertices; `action` 0 lowers, 1 restores. In `outcome` how many vertices moved, must stay, and are less deep
/// than asked for.
int condyle_stroke(CondyleJoint* joint, int of_fixed, int action, const std::uint32_t* along, int count,
                   double radius_mm, double depth_mm, std::uint32_t outcome[3]);
/// Takes the last stroke back; 0 if there is none. How many can still be taken back.
int condyle_undo_stroke(CondyleJoint* joint, int of_fixed);
int condyle_strokes(const CondyleJoint* joint, int of_fixed);
/// In `removed` the volume in mm^3, the deepest place in mm, its vertex or -1, and the mean length of edges in mm.
int condyle_removed(const CondyleJoint* joint, int of_fixed, double removed[4]);
/// x, y and z of each vertex as it is now, and its distance from the surface before, mm.
int condyle_brushed(const CondyleJoint* joint, int of_fixed, double* vertices, double* depths_mm);

/// The joint centre is moved by this much along the axes of F, mm, both bones standing as the pose of these angles has them. Queries of
/// page_core.hpp are answered about the centre as it was. Fails for a free joint.
int condyle_move_centre(CondyleJoint* joint, const double* centre_mm, const double* reference_deg);
/// As condyle_limit(), of rotations about the moved centre. The contact's point is seen from the centre as it was.
int condyle_limit_about(CondyleJoint* joint, int vary, int positive, const double* start_deg,
                        double range_deg, double limit[8]);
}
