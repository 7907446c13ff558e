#include "io/mesh/split_polygon.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "io/mesh/ear_clipping.hpp"

namespace condyle::io {
namespace {

/// Looking for a corner takes the square of their number. A bone that was cut by a plane may end in a face of some hundreds.
constexpr std::size_t most_corners = 1000;

/// A polygon whose corners are off one plane by less than this part of its size is flat: however it is cut, its surface lies there.
constexpr double flatness = 1e-3;
/// What rounding to six digits does to the largest coordinate, at most.
constexpr double rounding = 1e-5;

using Corners = std::vector<std::array<std::size_t, 3>>;

/// Twice the area of a polygon times its normal, whatever its shape.
Vec3 area_vector(const std::vector<Vec3>& corners) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    sum += (corners[i] - corners[0]).cross(corners[i + 1] - corners[0]);
  return sum;
}

/// Whether all triangles round a corner turn in the sense of the normal, or, with `straight`, none against it.
bool sees_all(const std::vector<Vec3>& corners, std::size_t centre, const Vec3& normal, bool straight) {
  const std::size_t n = corners.size();
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const Vec3 a = corners[(centre + i) % n] - corners[centre],
               b = corners[(centre + i + 1) % n] - corners[centre];
    const double turn = a.cross(b).dot(normal);
    if (!(straight ? turn >= 0 : turn > 0)) return false;
  }
  return true;
}

/// The corner from which a polygon can be split into a fan; their number if there is none.
std::size_t centre_of_fan(const std::vector<Vec3>& corners, const Vec3& normal) {
  for (const bool straight : {false, true})
    for (std::size_t c = 0; c < corners.size() && !(straight && normal.isZero()); ++c)
      if (sees_all(corners, c, normal, straight)) return c;
  return corners.size();
}

Corners fan(std::size_t corners, std::size_t centre) {
  Corners triangles;
  for (std::size_t i = 1; i + 1 < corners; ++i)
    triangles.push_back({centre, (centre + i) % corners, (centre + i + 1) % corners});
  return triangles;
}

double rounded_off(const std::vector<Vec3>& corners) {
  double largest = 0;
  for (const Vec3& p : corners) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  return rounding * largest;
}

/// Whether all corners are on one line.
bool has_no_area(const std::vector<Vec3>& corners) {
  const auto from_first = [&](const Vec3& p) { return (p - corners[0]).norm(); };
  const Vec3 far = *std::max_element(corners.begin(), corners.end(), [&](const Vec3& p, const Vec3& q) {
    return from_first(p) < from_first(q);
  });
  const double length = from_first(far);
  if (length == 0) return true;
  const Vec3 along = (far - corners[0]) / length;
  const double most = rounded_off(corners);
  return std::all_of(corners.begin(), corners.end(),
                     [&](const Vec3& p) { return (p - corners[0]).cross(along).norm() <= most; });
}

/// The normal of a polygon; of one whose parts cancel, that of its largest corner.
Vec3 direction(const std::vector<Vec3>& corners, const Vec3& area) {
  if (!area.isZero()) return area.normalized();
  Vec3 largest = Vec3::Zero();
  const std::size_t n = corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3& p = corners[(i + 1) % n];
    const Vec3 here = (corners[i] - p).cross(corners[(i + 2) % n] - p);
    if (here.squaredNorm() > largest.squaredNorm()) largest = here;
  }
  return largest.isZero() ? Vec3::UnitZ() : largest.normalized();
}

/// The largest distance of a corner from the plane through the middle of all.
double off_plane(const std::vector<Vec3>& corners, const Vec3& normal) {
  Vec3 middle = Vec3::Zero();
  for (const Vec3& p : corners) middle += p / static_cast<double>(corners.size());
  double largest = 0;
  for (const Vec3& p : corners) largest = std::max(largest, std::abs((p - middle).dot(normal)));
  return largest;
}

double size_of(const std::vector<Vec3>& corners) {
  Vec3 low = corners[0], high = corners[0];
  for (const Vec3& p : corners) low = low.cwiseMin(p), high = high.cwiseMax(p);
  return (high - low).norm();
}

}  // namespace

std::optional<double> append_split(TriMesh& mesh, std::span<const std::int64_t> corners, std::size_t number,
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
  const auto append = [&](const Corners& triangles) {
    const auto at = [&](std::size_t i) { return static_cast<Index>(corners[i]); };
    for (const auto& [a, b, c] : triangles) mesh.triangles.push_back({at(a), at(b), at(c)});
    return std::nullopt;
  };
  const Vec3 area = area_vector(points);
  if (const std::size_t centre = centre_of_fan(points, area); centre < n) return append(fan(n, centre));
  if (has_no_area(points)) return append(fan(n, 0));

  const Vec3 normal = direction(points, area);
  const double off = off_plane(points, normal);
  const bool is_flat = off <= flatness * size_of(points) + rounded_off(points);
  const bool is_guess = source.polygons == PolygonRule::guess;
  const Corners ears = is_flat || is_guess ? clipped_ears(points, normal) : Corners();
  if (!ears.empty() && is_flat) return append(ears);
  if (!is_guess)
    source.fail(fmt::format("face {} of {} corners {}: it can only be split by a guess (polygons: guess)",
                            number, n,
                            is_flat ? "crosses itself" : "is twisted, and convex from none of them"));
  append(ears.empty() ? fan(n, 0) : ears);
  return off;
}

}  // namespace condyle::io
