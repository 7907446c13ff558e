#include "radial/query/exact_query.hpp"

#include <algorithm>
#include <array>

#include "core/parallel.hpp"
#include "radial/exact/ray_scan.hpp"

namespace condyle::radial {
namespace {

/// Points per task: enough to outweigh starting one.
constexpr std::size_t points_per_chunk = 256;

/// tell(i, point, answer) for each point, on all threads.
template <class Tell>
void answer_each(const ExactView& table, PointsView points, const Tell& tell) {
  core::parallel_chunks(points.size(), points_per_chunk, [&](std::size_t first, std::size_t last) {
    RayScan scan(table.mesh, table.winding_at_centre);
    Candidates candidates(table.map, table.entries);
    std::array<Vec3, points_per_gathering> gathered;
    for (std::size_t i = first; i < last; i += points_per_gathering) {
      const std::size_t count = std::min(points_per_gathering, last - i);
      for (std::size_t k = 0; k < count; ++k) gathered[k] = points[i + k];
      candidates.gather({gathered.data(), count});
      for (std::size_t k = 0; k < count; ++k)
        tell(i + k, gathered[k], scan.answer(gathered[k], candidates.of(k)));
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
