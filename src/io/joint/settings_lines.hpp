#pragma once

#include <string>

#include "condyle/io/joint_file.hpp"
#include "io/joint/proposal_lines.hpp"

namespace condyle::io {

/// The table [person] of a joint file behind an empty line, empty if nothing is known of it.
std::string person_text(const Person& person);

/// What a joint file that is made from another one keeps of it: its motions, standard deviations, the seed, and columns of a recorded motion.
/// `joint` is the one that is written, in mm and in its own frame: whose it is, and its ligaments. `sigma` are the deviations of the joint that is written. A recorded motion that has poses of the meshes as they were given is left out,
/// since the written meshes have other frames: a comment says so.
void add_settings(ProposalLines& lines, const JointFile& file, const Joint& joint,
                  const motion::Uncertainty& sigma);

}  // namespace condyle::io
