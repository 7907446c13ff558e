#pragma once

#include "condyle/joint_checks.hpp"

namespace condyle::kinematics {

/// Whether a note means that no number of the joint holds, because it is set up wrongly. docs/checks.md marks these codes; the page has red for
/// them.
constexpr bool is_wrong_set_up(JointNoteCode code) noexcept {
  switch (code) {
    case JointNoteCode::same_mesh:
    case JointNoteCode::swapped_bodies:
    case JointNoteCode::axes_not_upright:
    case JointNoteCode::axes_turned:
    case JointNoteCode::wrong_side:
    case JointNoteCode::mirrored:
    case JointNoteCode::bodies_disagree:
      return true;
    default:
      return false;
  }
}

}  // namespace condyle::kinematics
