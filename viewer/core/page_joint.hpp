#pragma once

#include <cstdint>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "condyle/contact.hpp"
#include "condyle/range_of_motion.hpp"
#include "mesh/surface_distance.hpp"

/// A joint of the page, and what its last answers left.
struct CondyleJoint {
  condyle::Joint joint;
  condyle::JointContact bodies;
  std::optional<condyle::RangeOfMotion> range = {};
  condyle::Penetrations penetrations = {};
  std::vector<std::uint32_t> pair_triangles = {};
  std::vector<double> intervals = {};
  /// Of the pose that was last shown.
  condyle::Pose shown_at = condyle::Pose::Identity();
  std::optional<condyle::RadialContact> shown = {};
  std::optional<condyle::mesh::SurfaceDistance> to_fixed = {}, to_mobile = {};
};

/// Made ready for motions at the first call: bearing surfaces are looked for.
condyle::RangeOfMotion& range_of(CondyleJoint& joint);

/// The line that condyle_error() gives.
std::string& last_error();

/// What `answer` returns, or `failed` with the error's line kept.
template <class Result, class Answer>
Result guarded(Result failed, const Answer& answer) {
  try {
    return answer();
  } catch (const std::exception& error) {
    last_error() = error.what();
  }
  return failed;
}
