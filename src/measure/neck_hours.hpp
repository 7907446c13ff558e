#pragma once

#include <vector>

#include "measure/found_parts.hpp"

namespace condyle::measure {

/// Twelve hours in steps of five minutes.
inline constexpr std::size_t neck_steps = 144;
/// The place of an hour among them, for hours that are steps.
constexpr std::size_t neck_step(double hour) noexcept {
  return static_cast<std::size_t>(hour * (static_cast<double>(neck_steps) / 12) + 0.5);
}

/// 12 is `up` made square to the neck, 3 is anterior, on both sides. Empty if the two are parallel to within a degree.
std::optional<motion::ClockFace> clock_about(const Vec3& axis, const Vec3& up, const Vec3& anterior);

/// Alpha and offset around the neck. Faces whose vertices are marked in `ends` are no contour, and in planes in which the neck ends it has no offset.
std::vector<NeckHour> around_neck(const TriMesh& femur, const NeckGeometry& neck,
                                  const std::vector<char>& ends);

/// The measures that are read off them.
void set_alpha(const std::vector<NeckHour>& hours, double head_radius, FemurMeasures& out);

/// The alpha angles, and the other measures that need a clock.
std::vector<Measure*> alpha_measures(FemurMeasures& femur);
std::vector<Measure*> clock_measures(FemurMeasures& femur);

}  // namespace condyle::measure
