#pragma once

#include "condyle/kinematics/joint.hpp"
#include "table.hpp"

/// What is asked of a joint beside the experiment: each adds its rows to the report.

namespace bench {

/// Quick: enough to see that the answers agree; its times mean little.
enum class Effort { full, quick };

/// How far the joint turns until bone meets bone: Condyle's limit in closed form against stepping and
/// bisecting the boolean query of FCL, from the same pose about the same axis.
void ask_first_contact(const condyle::Joint& joint, Effort effort, Report& report);

/// Both limits of internal rotation over a grid of flexion and adduction, on all threads.
void ask_motion_map(const condyle::Joint& joint, Effort effort, Report& report);

/// Every mobile vertex against the fixed body at a list of poses: the tables of both methods, one thread.
void ask_vertex_tables(const condyle::Joint& joint, Effort effort, Report& report);

}  // namespace bench
