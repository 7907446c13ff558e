#pragma once

#include <span>
#include <string>

#include "condyle/io/joint_file.hpp"
#include "condyle/io/provenance.hpp"
#include "condyle/joint_checks.hpp"
#include "io/motion/functional_frame.hpp"

/// Results of `condyle frame`: how a joint was made from its file. Keys of the JSON are listed in docs/joint-file.md.

namespace condyle::io {

/// For people, and for programs: whole documents that end with a newline. `by_motion`: where a recorded motion turns the joint, if that was asked.
std::string to_text(const LoadedJoint& joint, const FunctionalFrame* by_motion = nullptr);
std::string frame_json(const LoadedJoint& joint, std::span<const JointNote> notes,
                       const Provenance* from = nullptr, const FunctionalFrame* by_motion = nullptr);

}  // namespace condyle::io
