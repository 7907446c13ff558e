#pragma once

#include <optional>
#include <vector>

#include "condyle/io/rom_result.hpp"
#include "io/result/plot_clock_face.hpp"

namespace condyle::io {

/// Direction of the limit's contact on the result's clock: 12 superior and 3 anterior on
/// either side. None for a hinge, without contact, and far from the rim.
std::optional<double> clock_hour(const RomResult& result, const MotionLimit& limit);

/// Where on that clock the motions end that end in contact.
std::vector<ClockContact> clock_contacts(const RomResult& result);

}  // namespace condyle::io
