#pragma once

#include "condyle/answer.hpp"
#include "contact_options.hpp"
#include "io/result/motion_result.hpp"

/// A recorded motion as the commands ask about it.

namespace condyle::cli {

/// Contact as frames of a recorded motion are asked for it.
ContactEntry motion_contact_of(const ContactChanges& options, const JointFile& file, bool with_pressure);

/// answer_motion() of the question's surfaces, by depth or with pressure, with its progress on standard error and the notes of
/// the motion's numbers first. Names and casting of the request are the question's. Throws what ElasticContact and NormalDepth
/// throw, and Interrupted on SIGINT or SIGTERM.
MotionAnswer answered_motion(const MotionQuestion& question, MotionRequest request);

}  // namespace condyle::cli
