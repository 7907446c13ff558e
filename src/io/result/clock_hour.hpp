#pragma once

#include <optional>
#include <string>

#include "io/result/rom_result.hpp"

namespace condyle::io {

/// Direction of the limit's contact on the result's clock, in [0, 12): 12 (0) superior and 3 anterior on
/// either side. None for a hinge, without contact, and far from the rim.
std::optional<double> clock_hour(const RomResult& result, const motion::MotionLimit& limit);

/// "1:30" of 1.5: hours and minutes of the clock face, 12 for the first hour.
std::string clock_text(double hour);

}  // namespace condyle::io
