#pragma once

#include "scenes.hpp"
#include "table.hpp"

/// Questions to a scene beside the experiment: each adds its rows to the report.

namespace bench {

/// Quick: enough to see that the answers agree; its times mean little.
enum class Effort { full, quick };

/// How far the joint turns until bone meets bone: Condyle's limit in closed form against stepping and
/// bisecting the boolean query of FCL, from the same pose about the same axis.
void ask_first_contact(const Scene& scene, Effort effort, Report& report);

/// Both limits of internal rotation over a grid of flexion and adduction, on all threads.
void ask_motion_map(const Scene& scene, Effort effort, Report& report);

/// Bands of all motions of the hip, 200 samples, on all threads.
void ask_limit_bands(const Scene& scene, Effort effort, Report& report);

/// Six questions to Condyle and to all methods of others that answer them, with what each answered wrongly.
void ask_beside_others(const Scene& scene, Effort effort, Report& report);

/// Map, bands and a study on one thread, on two, and so on to all: how much of the threads is used.
void ask_threads(const Scene& scene, Effort effort, Report& report);

/// Costs of the radial table beside its queries at single poses: building it and following a deformation,
/// other instruction sets.
void ask_radial_table(const Scene& scene, Effort effort, Report& report);

/// Work that no method can avoid if it reports every vertex inside, with triangle and depth: beside what
/// Condyle and Embree take.
void ask_inside_limits(const Scene& scene, Effort effort, Report& report);

/// Costs of the ring table: building it, a pose, and all angles at once.
void ask_ring_table(const Scene& scene, Effort effort, Report& report);

/// Maps from directions to cells with one way of binning: cost of the map, length of lists, total.
void ask_direction_maps(const Scene& scene, Effort effort, Report& report);

/// How many tetrahedra fill the bodies, by the rule of the rows that hash them; nothing where CGAL is absent.
void ask_tetrahedra(const Scene& scene, Effort effort, Report& report);

/// A fixed body that deforms in each step: contacts that follow it, made anew, and the trees of others refitted.
void ask_deforming(const Scene& scene, Effort effort, Report& report);

// With a joint and a motion of their own; false where these are not there.

/// Pressure in both contacts of a knee over a recorded flexion.
bool ask_knee_pressure(Effort effort, Report& report);

/// The position in which a hip's cartilages carry a load: one pose, and a walk.
bool ask_hip_balance(Effort effort, Report& report);

/// Pairs, gap and depth of two bones in each frame of a walk.
bool ask_walking_bones(Effort effort, Report& report);

}  // namespace bench
