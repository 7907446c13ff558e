#pragma once

#include <span>

#include "condyle/io/joint_file.hpp"
#include "condyle/io/provenance.hpp"
#include "condyle/joint_checks.hpp"

namespace condyle::io {

/// An answer about a joint, with what is said beside it. All that it refers to outlives it.
template <class Answer>
struct ResultOf {
  const Joint& joint;  ///< that was asked about
  const Answer& answer;
  std::span<const JointNote> notes = {};  ///< on the joint's set-up
  /// Where the answer comes from and in which frame it is given; null: not known, and the joint frame.
  const Provenance* provenance = nullptr;
  /// Files of a changed joint keep the motions and the uncertainty of this one.
  const JointFile* file = nullptr;
};

}  // namespace condyle::io
