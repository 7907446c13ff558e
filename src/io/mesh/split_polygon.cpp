#include "io/mesh/split_polygon.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace condyle::io {
namespace {

/// Looking for a corner takes the square of their number.
constexpr std::size_t most_corners = 100;

/// Twice the area of a polygon times its normal, whatever its shape.
Vec3 area_vector(const std::vector<Vec3>& corners) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    sum += (corners[i] - corners[0]).cross(corners[i + 1] - corners[0]);
  return sum;
}

/// The least, over the triangles round a corner, of what they turn in the sense of the normal.
double least_turn(const std::vector<Vec3>& corners, std::size_t centre, const Vec3& normal) {
  const std::size_t n = corners.size();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const Vec3 a = corners[(centre + i) % n] - corners[centre],
               b = corners[(centre + i + 1) % n] - corners[centre];
    least = std::min(least, a.cross(b).dot(normal));
  }
  return least;
}

}  // namespace

void append_split(TriMesh& mesh, std::span<const std::int64_t> corners, std::size_t number,
                  const Source& source) {
  const std::size_t n = corners.size();
  if (n > most_corners)
    source.fail(fmt::format("face {} has {} corners: polygons of more than {} are not split", number, n,
                            most_corners));
  std::vector<Vec3> points;
  for (const std::int64_t corner : corners) {
    if (corner < 0 || std::cmp_greater_equal(corner, mesh.vertices.size()))
      source.fail(fmt::format("face {} uses vertex {} of {}", number, corner, mesh.vertices.size()));
    points.push_back(mesh.vertices[static_cast<std::size_t>(corner)]);
  }
  const Vec3 normal = area_vector(points);
  std::size_t centre = n;
  for (std::size_t c = 0; c < n && centre == n; ++c)
    if (least_turn(points, c, normal) > 0) centre = c;
  for (std::size_t c = 0; c < n && centre == n && !normal.isZero(); ++c)
    if (least_turn(points, c, normal) >= 0) centre = c;
  if (centre == n)
    source.fail(
        fmt::format("face {} of {} corners is convex from none of them: it cannot be split", number, n));
  const auto at = [&](std::size_t i) { return static_cast<Index>(corners[(centre + i) % n]); };
  for (std::size_t i = 1; i + 1 < n; ++i) mesh.triangles.push_back({at(0), at(i), at(i + 1)});
}

}  // namespace condyle::io
