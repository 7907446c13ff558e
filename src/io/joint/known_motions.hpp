#pragma once

#include <vector>

#include "condyle/io/joint_file.hpp"
#include "condyle/range_of_motion.hpp"

namespace condyle::io {

/// The motions that a joint can be asked by name: the built-in ones of its kind and those of its file.
inline std::vector<motion::Motion> known_motions(const LoadedJoint& loaded) {
  return motion::with_own_motions(motion::built_in_motions(loaded.joint.kind, loaded.joint.anatomy),
                                  loaded.report.file.motions);
}

}  // namespace condyle::io
