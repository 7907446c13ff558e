#pragma once

#include "baseline.hpp"
#include "questions.hpp"
#include "table.hpp"

namespace bench {

/// Joints that whole commands are timed on: the two real hips, and the sample where those are not there or the run is quick.
std::vector<std::string> command_joints(Effort effort);

/// Whole commands of the built `condyle` on one joint, in processor seconds of their process (user and system), and beside
/// `inspect` of the same two meshes, which reads and checks them. Adds rows, goals, and what did not answer. Returns the
/// ratios for the baseline, "command/joint/name": how many times longer `inspect` took.
Ratios ask_commands(const std::string& joint, Effort effort, Report& report);

}  // namespace bench
