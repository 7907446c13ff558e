#include "condyle/tangential/profile.hpp"

#include <limits>

namespace condyle {
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
  // The axis pierces the figure unless two edges certainly turn about it in opposite senses. An edge whose
  // sense is within its rounding (96u M^2 for corners off by 24u M, 6u M^2 for the products) says nothing.
  const double uncertain = 128 * rounding_unit * largest * largest;
  bool left = false, right = false;
  for (int k = 0; k < polygon.count; ++k) {
    const Vec3 &p = polygon.corner[static_cast<std::size_t>(k)],
               &q = polygon.corner[static_cast<std::size_t>((k + 1) % polygon.count)];
    low = std::min(low, distance_to_edge(p, q));
    const double turn = p.x() * q.y() - p.y() * q.x();
    left |= turn > uncertain, right |= turn < -uncertain;
  }
  const double margin = 1024 * rounding_unit * largest;
  const bool pierced = polygon.count > 2 && left != right;
  return {pierced ? 0 : std::max(0.0, low - margin), high + margin};
}

namespace detail {

/// Let L be the longest edge seen along z. The nearest point to the axis is a corner, or the foot on an edge
/// whose nearer end is at most L/2 away, or the axis itself, at most L / sqrt(3) from the nearest corner:
/// squares fall short of the nearest corner's by L^2 / 3 at most, for the part of the triangle between two
/// heights too, cut points counting as corners.
///
/// A row holds the heights between two borders and, for rounding, up to 8u Z beyond (Z = |z_min| + |z_max|).
/// Corners within `band` = 2^-30 Z of a border are given to the rows on both sides. An edge with an end that
/// far off is more than half the band high, so that 8u Z of height move a cut by less than 2^-19 L; edges
/// without one lie with both ends in both rows. Added to the margin of `radius_interval`.
std::optional<SmallTriangle> SmallTriangle::of(const ProfileGrid& grid, const Vec3& a, const Vec3& b,
                                               const Vec3& c) noexcept {
  const auto corner = [](const Vec3& p) {
    return Corner{p.x(), p.y(), p.z(), p.x() * p.x() + p.y() * p.y()};
  };
  SmallTriangle out;
  out.low_ = corner(a), out.middle_ = corner(b), out.high_ = corner(c);
  if (out.middle_.z < out.low_.z) std::swap(out.low_, out.middle_);
  if (out.high_.z < out.middle_.z) std::swap(out.middle_, out.high_);
  if (out.middle_.z < out.low_.z) std::swap(out.low_, out.middle_);
  const auto squared_length = [](const Corner& p, const Corner& q) {
    return (q.x - p.x) * (q.x - p.x) + (q.y - p.y) * (q.y - p.y);
  };
  const double longest2 =
      std::max({squared_length(out.low_, out.middle_), squared_length(out.middle_, out.high_),
                squared_length(out.high_, out.low_)});
  const double nearest2 = std::min({out.low_.rho2, out.middle_.rho2, out.high_.rho2});
  const double farthest2 = std::max({out.low_.rho2, out.middle_.rho2, out.high_.rho2});
  const double height_scale = std::abs(grid.z_min) + std::abs(grid.z_max);
  out.band_ = 0x1p-30 * height_scale;
  const bool small = 16 * longest2 <= nearest2;
  out.sag_ = longest2 / 3;
  const bool within = out.low_.z >= grid.z_min && out.high_.z <= grid.z_max &&
                      nearest2 - out.sag_ >= grid.rho_min * grid.rho_min &&
                      farthest2 <= grid.rho_max * grid.rho_max;
  if (!small || !within) return std::nullopt;
  out.per_height_ = 1 / (out.high_.z - out.low_.z);
  out.per_lower_height_ = 1 / (out.middle_.z - out.low_.z);
  out.per_upper_height_ = 1 / (out.high_.z - out.middle_.z);
  out.margin_ = 1024 * rounding_unit * std::sqrt(farthest2) + 0x1p-19 * std::sqrt(longest2);
  return out;
}

}  // namespace detail

namespace {

/// As radius_interval; a little lower where the triangle is small against its distance from the axis.
RadiusInterval radii_of(const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
  const auto square = [](double x, double y) { return x * x + y * y; };
  const auto between = [&](const Vec3& p, const Vec3& q) { return square(q.x() - p.x(), q.y() - p.y()); };
  const double at_a = square(a.x(), a.y()), at_b = square(b.x(), b.y()), at_c = square(c.x(), c.y());
  const double nearest2 = std::min(at_a, std::min(at_b, at_c));
  const double longest2 = std::max(between(a, b), std::max(between(b, c), between(c, a)));
  if (16 * longest2 <= nearest2) {
    const double farthest = std::sqrt(std::max(at_a, std::max(at_b, at_c)));
    const double margin = 1024 * rounding_unit * farthest;
    return {std::sqrt(nearest2 - longest2 / 3) - margin, farthest + margin};
  }
  ProfilePolygon triangle;
  triangle.push_back(a), triangle.push_back(b), triangle.push_back(c);
  return radius_interval(triangle);
}

}  // namespace

ProfileGrid ProfileGrid::over(std::span<const Vec3> vertices, std::span<const Triangle> triangles,
                              std::size_t cells) {
  ProfileGrid grid;
  if (triangles.empty()) return grid;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  grid.rho_min = infinity, grid.z_min = infinity, grid.z_max = -infinity;
  for (const auto& [a, b, c] : triangles) {
    const RadiusInterval radii = radii_of(vertices[a], vertices[b], vertices[c]);
    grid.rho_min = std::min(grid.rho_min, radii.low), grid.rho_max = std::max(grid.rho_max, radii.high);
    for (const Index v : {a, b, c}) {
      const double z = vertices[v].z();
      grid.z_min = std::min(grid.z_min, z), grid.z_max = std::max(grid.z_max, z);
    }
  }
  const double width = grid.rho_max - grid.rho_min, height = grid.z_max - grid.z_min;
  const double target = static_cast<double>(std::max<std::size_t>(cells, 1));
  // Square cells of side s with width/s * height/s = target; a thin profile keeps one cell across.
  const double side =
      std::max({std::sqrt(width) * std::sqrt(height / target), width / target, height / target});
  if (side > 0) {
    const auto count = [&](double extent) {
      return static_cast<Index>(std::clamp(std::ceil(extent / side), 1.0, target));
    };
    grid.columns = count(width), grid.rows = count(height);
  }
  if (width > 0) grid.rho_cell = width / grid.columns, grid.columns_per_mm = 1 / grid.rho_cell;
  if (height > 0) grid.z_cell = height / grid.rows, grid.rows_per_mm = 1 / grid.z_cell;
  return grid;
}

}  // namespace condyle
