#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace condyle {

/// A point or direction; in millimetres if it is a length.
using Vec3 = Eigen::Vector3d;

/// Number of a vertex, triangle or cell.
using Index = std::uint32_t;

/// "None" for an Index in an array, where std::optional would double its size.
inline constexpr Index no_index = 0xffffffffu;

/// Points borrowed from somebody's arrays, one array per coordinate. All three have one length.
struct PointsView {
  std::span<const double> x, y, z;

  std::size_t size() const noexcept { return x.size(); }
  Vec3 operator[](std::size_t i) const noexcept {
    assert(i < size());
    return {x[i], y[i], z[i]};
  }
  PointsView subspan(std::size_t first, std::size_t count) const noexcept {
    return {x.subspan(first, count), y.subspan(first, count), z.subspan(first, count)};
  }
};

/// Points owned, one array per coordinate, so that loops over many of them run over plain arrays.
struct Points {
  std::vector<double> x, y, z;

  Points() = default;
  explicit Points(std::size_t count) : x(count), y(count), z(count) {}

  std::size_t size() const noexcept { return x.size(); }
  Vec3 operator[](std::size_t i) const noexcept {
    assert(i < size());
    return {x[i], y[i], z[i]};
  }
  void set(std::size_t i, const Vec3& p) noexcept {
    assert(i < size());
    x[i] = p.x(), y[i] = p.y(), z[i] = p.z();
  }
  void push_back(const Vec3& p) { x.push_back(p.x()), y.push_back(p.y()), z.push_back(p.z()); }
  void reserve(std::size_t count) { x.reserve(count), y.reserve(count), z.reserve(count); }
  PointsView view() const noexcept { return {x, y, z}; }
  operator PointsView() const noexcept { return view(); }

  friend bool operator==(const Points&, const Points&) = default;
};

/// Where a point stands to a closed surface: decided by the winding number w, exactly. `inside` is strictly
/// inside, w > 0; `on_surface` is exactly on a triangle, an edge or a vertex.
enum class PointState : std::uint8_t { outside, on_surface, inside };

}  // namespace condyle
