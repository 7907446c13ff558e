#pragma once

#include "condyle/answer.hpp"
#include "contact_options.hpp"
#include "io/result/motion_result.hpp"
#include "notes.hpp"

/// A recorded motion as the commands ask about it.

namespace condyle::cli {

/// Contact as frames of a recorded motion are asked for it.
io::ContactEntry motion_contact_of(const io::ContactChanges& options, const io::JointFile& file,
                                   bool with_pressure);

/// answer_motion() of the question's surfaces, by depth or with pressure, with its progress on standard error; its notes begin with
/// those on the motion's numbers. The request takes names, casting and rays from the question. Throws as ElasticContact and
/// NormalDepth do, Interrupted on SIGINT or SIGTERM, and MeshError for notes that are errors and known before the frames.
MotionAnswer answered_motion(const io::MotionQuestion& question, MotionRequest request,
                             Strictness strictness);

}  // namespace condyle::cli
