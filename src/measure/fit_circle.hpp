#pragma once

#include <optional>
#include <vector>

#include "measure/axis_sections.hpp"

namespace condyle::measure {

struct Circle {
  Vec2 centre;
  double radius;
};

struct CircleFit {
  Circle circle;
  double rms_residual;  ///< mm, of the part that was kept
  double kept_length;   ///< mm of contour
};

/// The circle of least squares of the distances to it of these pieces, each counting with its length; again and again without
/// the farthest fifth, which a cam or the pit of a head's ligament is. Empty if the pieces leave it open.
std::optional<CircleFit> fit_circle(const Contour& pieces, double head_radius);

/// The circle of least squares through points, all kept.
std::optional<Circle> circle_through(const std::vector<Vec2>& points);

}  // namespace condyle::measure
