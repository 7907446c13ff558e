#include "tangential/build/profile_raster.hpp"

#include <limits>

namespace condyle::tangential {
namespace {

/// Where the edge from a (on one side of the height) to b (on the other) has height h. From the lower end
/// upwards, whichever way the edge is walked: neighbours get the same bits.
Vec3 at_height(const Vec3& a, const Vec3& b, double h) noexcept {
  const Vec3 &lower = a.z() <= b.z() ? a : b, &upper = a.z() <= b.z() ? b : a;
  const double t = (h - lower.z()) / (upper.z() - lower.z());
  return {lower.x() + t * (upper.x() - lower.x()), lower.y() + t * (upper.y() - lower.y()), h};
}

enum class Keep { above, below };

ProfilePolygon clipped(const ProfilePolygon& in, double h, Keep side) noexcept {
  const auto kept = [&](const Vec3& p) { return side == Keep::above ? p.z() >= h : p.z() <= h; };
  ProfilePolygon out;
  for (int k = 0; k < in.count; ++k) {
    const Vec3 &p = in.corner[static_cast<std::size_t>(k)],
               &q = in.corner[static_cast<std::size_t>((k + 1) % in.count)];
    if (kept(p)) out.push_back(p);
    if (kept(p) != kept(q)) out.push_back(at_height(p, q, h));
  }
  return out;
}

/// Distance from the axis to the edge a b, seen along z.
double distance_to_edge(const Vec3& a, const Vec3& b) noexcept {
  const double dx = b.x() - a.x(), dy = b.y() - a.y(), squared_length = dx * dx + dy * dy;
  if (!(squared_length > 0)) return std::min(axis_radius(a.x(), a.y()), axis_radius(b.x(), b.y()));
  const double t = std::clamp(-(a.x() * dx + a.y() * dy) / squared_length, 0.0, 1.0);
  return axis_radius(a.x() + t * dx, a.y() + t * dy);
}

}  // namespace

ProfilePolygon clipped_to_heights(const ProfilePolygon& polygon, double low, double high) noexcept {
  return clipped(clipped(polygon, low, Keep::above), high, Keep::below);
}

RadiusInterval radius_interval(const ProfilePolygon& polygon) noexcept {
  double largest = 0, low = std::numeric_limits<double>::infinity(), high = 0;
  for (int k = 0; k < polygon.count; ++k) {
    const Vec3& p = polygon.corner[static_cast<std::size_t>(k)];
    largest = std::max({largest, std::abs(p.x()), std::abs(p.y())});
    high = std::max(high, axis_radius(p.x(), p.y()));
  }
  // The axis pierces the figure unless two edges certainly run round it in opposite senses. An edge whose
  // sense is within its rounding (96u M^2 for corners off by 24u M, 6u M^2 for the products) says nothing.
  const double uncertain = 128 * core::rounding_unit * largest * largest;
  bool left = false, right = false;
  for (int k = 0; k < polygon.count; ++k) {
    const Vec3 &p = polygon.corner[static_cast<std::size_t>(k)],
               &q = polygon.corner[static_cast<std::size_t>((k + 1) % polygon.count)];
    low = std::min(low, distance_to_edge(p, q));
    const double cross = p.x() * q.y() - p.y() * q.x();
    left |= cross > uncertain, right |= cross < -uncertain;
  }
  const double margin = 1024 * core::rounding_unit * largest;
  const bool pierced = polygon.count > 2 && left != right;
  return {pierced ? 0 : std::max(0.0, low - margin), high + margin};
}

}  // namespace condyle::tangential
