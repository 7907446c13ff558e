#pragma once

#include <vector>

#include "condyle/io/joint_file.hpp"
#include "condyle/range_of_motion.hpp"

namespace condyle {

/// The motions that a joint can be asked by name: the built-in ones of its kind and those of its file.
inline std::vector<Motion> known_motions(const LoadedJoint& loaded) {
  return with_own_motions(built_in_motions(loaded.joint.kind, loaded.joint.anatomy),
                          loaded.report.file.motions);
}

}  // namespace condyle
