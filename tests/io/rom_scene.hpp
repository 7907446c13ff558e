#pragma once

#include "condyle/joint.hpp"
#include "io/result/rom_result.hpp"
#include "support/test_meshes.hpp"

namespace condyle::test {

/// An arm hanging from the joint centre, in neutral as stated, and a post in front of it that flexion ends at.
inline Joint arm_and_post() {
  Joint joint{"arm and post",
              JointKind::ball,
              Side::right,
              {"post", box({40, -120, -50}, {60, -80, 50})},
              {"arm", box({-1, -100, -2}, {1, -10, 2})}};
  joint.zero_from = ZeroFrom::stated;
  return joint;
}

/// What is shown of an answer, which outlives it.
inline io::RomResult shown(const RangeAnswer& answer) {
  return {answer.joint, answer};
}

}  // namespace condyle::test
