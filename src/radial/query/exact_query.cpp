#include "radial/query/exact_query.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "core/parallel.hpp"
#include "radial/build/edge_functions.hpp"
#include "radial/exact/ray_scan.hpp"
#include "radial/exact/triangle_plane.hpp"

namespace condyle::radial {
namespace {

/// Points per task: enough to outweigh starting one.
constexpr std::size_t points_per_chunk = 256;

/// Facts that floats establish for certain about the ray through one point, equal to those of the exact method.
class RoughRay {
 public:
  /// Decides nothing if `edge_functions` is null.
  RoughRay(const Vec3& v, const EdgeFunctions* edge_functions)
      : v_{static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())} {
    const double largest = v.cwiseAbs().maxCoeff();
    if (largest > least_length && largest < greatest_length) functions_ = edge_functions;
    bound_ = form_error * std::max(std::max(std::abs(v_[0]), std::abs(v_[1])), std::abs(v_[2]));
  }

  /// Whether, and how, the ray crosses a triangle, or nothing.
  std::optional<RayCrossing> crossing_of(Index triangle) const noexcept {
    if (!functions_) return std::nullopt;
    const EdgeFunctions& f = functions_[triangle];
    float value[4], error[4];
    for (int k = 0; k < 4; ++k) {
      value[k] = v_[0] * f.x[k] + (v_[1] * f.y[k] + v_[2] * f.z[k]);
      error[k] = bound_ * (std::abs(f.x[k]) + (std::abs(f.y[k]) + std::abs(f.z[k])));
    }
    // Comparisons of all four at once: bits of positive floats are in the order of the floats, those of negative ones are below
    // 0, and a difference has the sign of what is compared, however it is rounded.
    std::int32_t beyond_range[4], outside[4], inside[4];
    for (int k = 0; k < 4; ++k) {
      const auto bits = std::bit_cast<std::int32_t>(error[k]);
      beyond_range[k] = (bits - least_error_bits) | (greatest_error_bits - bits);
      outside[k] = std::bit_cast<std::int32_t>(value[k] + error[k]);
      inside[k] = std::bit_cast<std::int32_t>(error[k] - value[k]);
    }
    // Elsewhere products may overflow, or be too small to be rounded as the bound has it.
    if (((beyond_range[0] | beyond_range[1]) | (beyond_range[2] | beyond_range[3])) < 0) return std::nullopt;
    if ((outside[0] | outside[1] | outside[2]) < 0) return RayCrossing();
    const float beyond = std::abs(value[3]) - 1;
    if ((inside[0] & inside[1] & inside[2]) >= 0 || !(std::abs(beyond) > error[3] + rounding_of_beyond))
      return std::nullopt;
    return RayCrossing{value[3] > 0 ? core::Sign::positive : core::Sign::negative, beyond > 0, false};
  }

  /// The normal of a triangle as gap_to_plane() wants it; NaN if it is not kept.
  Vec3 scaled_normal(Index triangle) const noexcept {
    if (!functions_) return Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
    return functions_[triangle].scaled_normal();
  }

 private:
  static constexpr auto least_error_bits = std::bit_cast<std::int32_t>(0x1p-90f),
                        greatest_error_bits = std::bit_cast<std::int32_t>(0x1p90f);
  /// Taking 1 from what is near 1 is exact, and from the rest rounds by less than half of what is left.
  static constexpr float rounding_of_beyond = 0x1p-23f;

  std::array<float, 3> v_;
  float bound_;
  const EdgeFunctions* functions_ = nullptr;
};

RayAnswer answer_of(RayScan& scan, const ExactView& table, const Vec3& v, std::span<const Index> triangles) {
  const RoughRay rough(v, table.edge_functions);
  return scan.answer(
      v, triangles,
      [&](Index t) {
        if (const auto certain = rough.crossing_of(t)) return *certain;
        const Cone cone = cone_of(table.mesh, t);
        return ray_crossing(v, cone.a, cone.b, cone.c);
      },
      [&](Index t) {
        const double gap = gap_to_plane(v, rough.scaled_normal(t));
        return std::isnan(gap) ? distance_along_ray(v, cone_of(table.mesh, t)) : gap;
      });
}

/// report(i, point, answer) for each point, on all threads.
template <class Report>
void answer_each(const ExactView& table, PointsView points, const Report& report) {
  core::parallel_chunks(points.size(), points_per_chunk, [&](std::size_t first, std::size_t last) {
    RayScan scan(table.mesh, table.winding_at_centre);
    Candidates candidates(table.map, table.entries);
    std::array<Vec3, points_per_gathering> gathered;
    for (std::size_t i = first; i < last; i += points_per_gathering) {
      const std::size_t count = std::min(points_per_gathering, last - i);
      for (std::size_t k = 0; k < count; ++k) gathered[k] = points[i + k];
      candidates.gather({gathered.data(), count});
      for (std::size_t k = 0; k < count; ++k)
        report(i + k, gathered[k], answer_of(scan, table, gathered[k], candidates.of(k)));
    }
  });
}

}  // namespace

void query(const ExactView& table, PointsView points, RadialResults& out) {
  out.resize(points.size());
  answer_each(table, points, [&](std::size_t i, const Vec3& v, const RayAnswer& answer) {
    out.state[i] = answer.state;
    out.winding[i] = answer.winding;
    out.radial_gap_mm[i] = answer.gap;
    out.triangle[i] = answer.triangle;
    out.direction[i] = answer.direction;
    out.ray_to_normal[i] =
        answer.triangle == no_index ? Angle() : angle_to_normal(v, cone_of(table.mesh, answer.triangle));
  });
}

std::vector<double> radial_gaps(const ExactView& table, PointsView points) {
  std::vector<double> gaps(points.size());
  answer_each(table, points,
              [&](std::size_t i, const Vec3&, const RayAnswer& answer) { gaps[i] = answer.gap; });
  return gaps;
}

}  // namespace condyle::radial
