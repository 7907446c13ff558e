#pragma once

#include <optional>

#include "condyle/bearing.hpp"
#include "condyle/impingement_zone.hpp"

namespace condyle::motion {

/// Hour of a point of F on the socket's clock; none far from the rim. Where no head is known nothing says how far a rim
/// is, and every point has one.
std::optional<double> socket_hour(const ClockFace& clock, const std::optional<BearingSurface>& bearing,
                                  const Vec3& point_F) noexcept;

}  // namespace condyle::motion
