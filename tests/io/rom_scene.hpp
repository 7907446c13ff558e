#pragma once

#include "condyle/joint.hpp"
#include "support/test_meshes.hpp"

namespace condyle::test {

/// An arm hanging from the joint centre, and a post in front of it that flexion ends at.
inline Joint arm_and_post() {
  return {"arm and post",
          JointKind::ball,
          Side::right,
          {"post", box({40, -120, -50}, {60, -80, 50})},
          {"arm", box({-1, -100, -2}, {1, -10, 2})}};
}

}  // namespace condyle::test
