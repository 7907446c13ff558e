#pragma once

#include "condyle/joint.hpp"
#include "support/test.hpp"

namespace condyle::test {

/// The right hip of the shared data, about the centre of its head; nothing if that is missing.
inline std::optional<Joint> hip_vhf_right() {
  const auto data = shared_data();
  if (!data) return std::nullopt;
  return Joint{"vhf",
               JointKind::ball,
               Side::right,
               {"hip bone", read_ply(*data / "hip_vhf_right/hip_bone.ply")},
               {"femur", read_ply(*data / "hip_vhf_right/femur.ply")}};
}

}  // namespace condyle::test
