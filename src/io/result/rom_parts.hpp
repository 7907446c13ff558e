#pragma once

#include <span>
#include <string>
#include <vector>

#include "answer/limit_facts.hpp"
#include "io/result/json.hpp"
#include "io/result/rom_result.hpp"

/// Common parts of the JSON and the lines of a range of motion.

namespace condyle::io {

/// Where the angles of a joint count from, and how its femur lies there: zero_pose().
Json zero_json(const Joint& joint);

/// Two motions that turn one angle from one start, to either side.
struct OppositeLimits {
  const motion::MotionLimit *one, *other;

  /// From one limit to the other, wherever zero is.
  Angle arc() const noexcept { return one->end.turned + other->end.turned; }
};

/// Those of which both end in contact, in the order of their first ones.
std::vector<OppositeLimits> opposite_limits(std::span<const motion::MotionLimit> limits);

/// The i-th limit as text quotes it: "131.9° (126–135)", "131.94" without bands, ">120" without contact in the range, "-" if none is known.
std::string limit_words(const RangeAnswer& answer, std::size_t i);

/// One limit of it, the i-th.
Json motion_json(const RomResult& result, std::size_t i);

/// rom_json() before it is text.
Json rom_object(const RomResult& result);

}  // namespace condyle::io
