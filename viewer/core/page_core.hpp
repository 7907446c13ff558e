#pragma once

#include <cstdint>

/// The core's queries for the page, as functions that JavaScript can call: numbers and arrays in, numbers and arrays
/// out. The same source is compiled to WebAssembly for the page and natively for the test that compares the two.
///
/// Lengths in mm, angles in degrees, poses as the 16 numbers of X_FM row by row. A function that fails returns -1 or
/// null and leaves its line in condyle_error(). Returned arrays belong to the joint and last until its next query.

extern "C" {

struct CondyleJoint;

/// One line about the last call that failed.
const char* condyle_error();

/// A joint of two closed surfaces in the joint frame. `kind`: 0 ball, 1 hinge, 2 free; `anatomy`: 0 hip, 1 knee, 2 ankle, 3 elbow,
/// 4 shoulder; `side`: 0 right, 1 left; `translation_frame`: 0 fixed, 1 joint_axes. Vertices are x, y, z each; triangles three
/// vertices each. Tables are made when a question first needs them.
CondyleJoint* condyle_joint(int kind, int anatomy, int side, int translation_frame,
                            const double* fixed_vertices, int fixed_vertex_count,
                            const std::uint32_t* fixed_triangles, int fixed_triangle_count,
                            const double* mobile_vertices, int mobile_vertex_count,
                            const std::uint32_t* mobile_triangles, int mobile_triangle_count);
void condyle_free(CondyleJoint* joint);

/// The role of each triangle of either body in contact, as found before, in numbers of ContactRole; null where each ends a
/// motion. `count_bearing` 1: bearing contact does too. Without this call a bearing surface is looked for at the first question
/// about motions.
int condyle_set_roles(CondyleJoint* joint, int count_bearing, const std::uint8_t* fixed,
                      const std::uint8_t* mobile);

/// The pose of three angles and a translation, in `pose`.
int condyle_pose(const CondyleJoint* joint, const double* angles_deg, const double* translation_mm,
                 double* pose);

/// Whether vertices of the mobile body (`of_fixed` 0) or of the fixed one (1) can be in the other one: 0 where its mesh is open.
int condyle_can_penetrate(const CondyleJoint* joint, int of_fixed);
/// How many vertices of the mobile body are in the fixed one (`of_fixed` 0), or the other way (1); fails where none can be.
int condyle_penetrations(CondyleJoint* joint, const double* pose, int of_fixed);
/// Vertices of the last answer, by number, and their radial depths.
const std::uint32_t* condyle_penetrating_vertices(const CondyleJoint* joint);
const double* condyle_depths(const CondyleJoint* joint);

/// The answer of `condyle depth` at a pose, which these angles made: in `answer` 1 if the bodies are in contact, else
/// 0; the kind of the deepest vertex's depth (0 no vertex has one, 1 the ray, 2 to 4 the arcs about the joint's
/// axes); its depth in mm; its body (0 mobile, 1 fixed), number and place in F; the distance to its nearest surface;
/// the arc's angle in degrees; how many vertices inside have no depth; the areas of the mobile and of the fixed body
/// in contact, mm^2; the volume, mm^3, a bound on its error, and how much of the overlap's surroundings a body covers
/// more than once. NaN for values that do not exist. Takes far longer than the vertices inside.
int condyle_depth(CondyleJoint* joint, const double* pose, const double* angles_deg, double answer[16]);

/// The movement from one pose to another as one screw motion, as `condyle motion --screws` has it: in `answer` 1 if it is a slide, else 0;
/// direction and a point of its axis, in F; and how far the mobile body must turn about that in the second pose to be free, degrees and mm of
/// the arc, as `condyle depth --about` has both. NaN for an axis that does not exist, and for depths if no rotation about it frees the bodies.
int condyle_screw(const CondyleJoint* joint, const double* before, const double* pose, double answer[9]);

/// Values of every vertex of the mobile body (`of_fixed` 0) or of the fixed one (1) at a pose, for colours: in
/// `values` mm, in `marks` 0 for nothing, 1 for the value, 2 for a value that is only a bound. `quantity`: 0 the gap
/// along its ray, negative inside; 1 for vertices inside the depth to read without rotations, their nearest distance
/// marked 2 if the ray's is none; 2 the distance to the nearest point of the other body, negative inside: for an open
/// one only that. Both arrays have an element per vertex.
int condyle_shown(CondyleJoint* joint, const double* pose, int quantity, int of_fixed, float* values,
                  std::uint8_t* marks);

/// Where the surfaces are nearest to each other at a pose, or with `counted` those parts of them whose contact ends motions: in `answer` the
/// distance, 0 if they meet; the triangles of the fixed and of the mobile body; 1 if contact of these two is bearing contact, else 0; and
/// the point of the fixed body, in F.
int condyle_nearest(CondyleJoint* joint, const double* pose, int counted, double answer[7]);

/// 1 where the bodies share a point, else 0.
int condyle_in_contact(CondyleJoint* joint, const double* pose);
/// How many pairs of triangles meet, and which: fixed, mobile each.
int condyle_pairs(CondyleJoint* joint, const double* pose);
const std::uint32_t* condyle_pair_triangles(const CondyleJoint* joint);

/// How far an angle turns from a pose until contact or the end of a ligament: `vary` 0 to 2 in the joint's order, `positive` 1 or 0, up to `range_deg`;
/// the mobile body keeps the translation `held_mm`, in F.
/// In `limit`: the angle turned, the reason (0 contact, 1 end of range, 2 in contact at the start, 3 a ligament, 4 one strained at the
/// start), the kind of contact (0 unknown, 1 bearing, 2 impingement, 3 cut), where bearing surfaces touch before (or -1), the contact's point
/// in F (or NaN), and the ligament's number (or -1).
int condyle_limit(CondyleJoint* joint, int vary, int positive, const double* start_deg, const double* held_mm,
                  double range_deg, double limit[8]);
/// How many intervals of an angle are free, from its start less `back_deg` to its start and `forth_deg`, half a turn at most
/// either way; and of each its ends, and what makes them (0 the range, 1 contact, 2 a ligament): low, high, at low, at high.
int condyle_free_angles(CondyleJoint* joint, int vary, const double* start_deg, const double* held_mm,
                        double back_deg, double forth_deg);
const double* condyle_intervals(const CondyleJoint* joint);
/// What a pose of these angles is to the limits of the body that keeps the translation `held_mm`, in F, as condyle::pose_standing() has it: in
/// `answer` the number of its PoseState; the angle by which it is at a limit (or -1), 1 if at its positive end, and 1 if a ligament ends it.
int condyle_standing(CondyleJoint* joint, const double* angles_deg, const double* held_mm, double answer[4]);
/// How many triangles of the mobile body are its bearing surface, each marked 1 in `triangles`; 0 if none was found.
int condyle_bearing(CondyleJoint* joint, std::uint8_t* triangles);
}
