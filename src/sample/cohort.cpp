
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>

#include "condyle/sample/hip.hpp"
#include "core/exponential.hpp"
#include "sample/femur_shape.hpp"

namespace condyle::sample {
namespace {

constexpr std::string_view head_radii = "head radii";

constexpr MeasureDistribution distributions[] = {
    {"head_radius_mm", "mm", 24, 2, 19, 29},
    {"joint_space_mm", "mm", 3.5, 0.4, 2.7, 4.3},
    {"neck_shaft_angle_deg", "deg", 127, 5, 113, 141},
    {"femoral_anteversion_deg", "deg", 15, 8, -10, 38},
    {"neck_radius_mm", head_radii, 0.54, 0.03, 0.46, 0.62},
    {"neck_length_mm", head_radii, 2.1, 0.1, 1.85, 2.35},
    {"alpha_angle_deg", "deg", 57, 11, 40, 85},
    {"acetabular_inclination_deg", "deg", 50, 4, 40, 60},
    {"acetabular_version_deg", "deg", 18, 6, 0, 34},
    {"lateral_centre_edge_angle_deg", "deg", 33, 6, 18, 44},
};

/// Bounds of a neck's length, whatever the head; HipParameters.
constexpr double shortest_neck_mm = 40, longest_neck_mm = 65;
/// The least alpha angle of a cam, degrees; HipParameters.
constexpr double least_cam_deg = 50;

/// Mixes all bits of a counter (the finaliser of SplitMix64, Steele, Lea, Flood 2014): draws are independent without a
/// generator's state, so that a hip does not depend on those before it.
std::uint64_t mixed(std::uint64_t x) noexcept {
  x += 0x9e3779b97f4a7c15;
  x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9;
  x = (x ^ x >> 27) * 0x94d049bb133111eb;
  return x ^ x >> 31;
}

/// In (0, 1), of 53 bits.
double uniform(std::uint64_t seed, std::uint64_t k, std::uint64_t draw) noexcept {
  return (static_cast<double>(mixed(mixed(mixed(seed) ^ k) ^ draw) >> 11) + 0.5) * 0x1p-53;
}

/// Its last bit is the C library's: what is made of it has one decimal.
double share_below(double z) noexcept {
  return std::erfc(-z / std::numbers::sqrt2) / 2;
}

/// The value below which this share of the distribution lies.
double quantile(const MeasureDistribution& d, double share) {
  const double first = share_below((d.low - d.mean) / d.standard_deviation);
  const double last = share_below((d.high - d.mean) / d.standard_deviation);
  const double z = core::normal_quantile(first + (last - first) * share);
  return std::clamp(d.mean + d.standard_deviation * z, d.low, d.high);
}

/// The double nearest to a number with one decimal: what a table says and what is made are one value.
double to_a_tenth(double value) noexcept {
  return std::round(value * 10) / 10;
}

}  // namespace

std::span<const MeasureDistribution> cohort_distributions() noexcept {
  return distributions;
}

CohortHip cohort_hip(std::uint64_t seed, std::uint64_t k) {
  CohortHip hip{{}, uniform(seed, k, 0) < 0.5, {}};
  for (std::size_t i = 0; i < std::size(distributions); ++i) {
    const MeasureDistribution& d = distributions[i];
    double value = quantile(d, uniform(seed, k, i + 1));
    if (d.unit == head_radii) value *= hip.measures.head_radius_mm;
    hip_measure_named(d.measure)->set(hip.measures, to_a_tenth(value));
  }
  double& neck = hip.measures.neck_length_mm;
  neck = std::clamp(neck, shortest_neck_mm, longest_neck_mm);
  const Angle native = sample::native_alpha_angle(hip.measures);
  if (*hip.measures.alpha_angle < std::max(native, Angle::degrees(least_cam_deg)))
    hip.measures.alpha_angle.reset();
  hip.alpha_angle = hip.measures.alpha_angle.value_or(native);
  return hip;
}

}  // namespace condyle::sample
