#pragma once

#include <vector>

#include "condyle/first_contact.hpp"

namespace condyle::motion {

/// Narrower intervals may be what rounding leaves between two contacts, and are none.
inline constexpr Angle narrowest_free_turn = Angle::radians(1e-9);

/// Adds the interval about `middle` with these limits from there, unless it overlaps one that holds the start or is as wide; narrower ones that it
/// overlaps go. Two overlap where a touch parts them that is found at the one's poses and, as those are rounded anew, not at the other's. One
/// that nothing ends is a turn wide.
void add_free_interval(std::vector<FreeInterval>& intervals, Angle middle, const RotationLimits& both);

}  // namespace condyle::motion
