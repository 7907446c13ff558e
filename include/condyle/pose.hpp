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

  [[nodiscard]] std::size_t size() const noexcept { return x.size(); }
  [[nodiscard]] Vec3 operator[](std::size_t i) const noexcept {
    assert(i < size());
    return {x[i], y[i], z[i]};
  }
  [[nodiscard]] PointsView subspan(std::size_t first, std::size_t count) const noexcept {
    return {x.subspan(first, count), y.subspan(first, count), z.subspan(first, count)};
  }
};

/// Points owned, one array per coordinate, so that loops over many of them run over plain arrays.
struct Points {
  std::vector<double> x, y, z;

  Points() = default;
  explicit Points(std::size_t count) : x(count), y(count), z(count) {}

  [[nodiscard]] std::size_t size() const noexcept { return x.size(); }
  [[nodiscard]] Vec3 operator[](std::size_t i) const noexcept {
    assert(i < size());
    return {x[i], y[i], z[i]};
  }
  void set(std::size_t i, const Vec3& p) noexcept {
    assert(i < size());
    x[i] = p.x(), y[i] = p.y(), z[i] = p.z();
  }
  void push_back(const Vec3& p) { x.push_back(p.x()), y.push_back(p.y()), z.push_back(p.z()); }
  void reserve(std::size_t count) { x.reserve(count), y.reserve(count), z.reserve(count); }
  [[nodiscard]] PointsView view() const noexcept { return {x, y, z}; }
  operator PointsView() const noexcept { return view(); }

  friend bool operator==(const Points&, const Points&) = default;
};

/// Where a point stands to a closed surface: decided by the winding number w, exactly. `inside` is strictly
/// inside, w > 0; `on_surface` is exactly on a triangle, an edge or a vertex.
enum class PointState : std::uint8_t { outside, on_surface, inside };

/// A rigid motion. X_FM is the pose of mobile M measured in fixed F: p_F = X_FM * p_M.
using Pose = Eigen::Isometry3d;

/// One point moved by a pose, its products and sums rounded in one fixed order, so that the same input
/// gives the same bits on every instruction set.
[[nodiscard]] inline Vec3 posed(const Pose& X, const Vec3& p) noexcept {
  const auto& m = X.matrix();
  const auto row = [&](int i) { return ((m(i, 0) * p.x() + m(i, 1) * p.y()) + m(i, 2) * p.z()) + m(i, 3); };
  return {row(0), row(1), row(2)};
}

/// The inverse pose, its sums in one fixed order too. The last coordinate's order differs from the others' as Eigen's
/// does when it vectorises: stored results keep their bits.
[[nodiscard]] inline Pose inverted(const Pose& X) noexcept {
  const auto& m = X.matrix();
  Pose out = Pose::Identity();
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) out.matrix()(i, k) = m(k, i);
    const double a = -m(0, i) * m(0, 3), b = -m(1, i) * m(1, 3), c = -m(2, i) * m(2, 3);
    out.matrix()(i, 3) = i < 2 ? (a + b) + c : a + (b + c);
  }
  return out;
}

/// How the mobile body moves relative to the fixed one, in F.
struct RelativeMotion {
  Vec3 velocity_mm_s = Vec3::Zero();  ///< of the origin of M
  Vec3 angular_velocity_rad_s = Vec3::Zero();
};

/// Many points moved by a pose; out may hold any size before.
void posed(const Pose& X, PointsView points, Points& out);
[[nodiscard]] Points posed(const Pose& X, PointsView points);
/// Each point plus `by`.
[[nodiscard]] Points shifted(Points points, const Vec3& by);

struct TriMesh;

/// Coordinates in which a joint axis is +z: the axis point becomes the origin, the axis direction +z, and a
/// positive angle about the axis is counter-clockwise seen from +z.
///
/// An axis through the origin along a coordinate axis (either sense) only permutes and negates coordinates:
/// nothing is rounded, and every exact decision made in the frame is exact for the points given. Any other
/// axis rounds each coordinate once on conversion into the frame (to about 4 * 2^-53 of the point's distance from the
/// axis point): decisions are then exact for the rounded points. One vertex always gets the same bits, so a closed
/// mesh stays closed.
class AxisFrame {
 public:
  /// The direction may have any length but zero. UsageError if it is zero, a value is not finite, or the point is beyond
  /// 1e30 mm.
  AxisFrame(const Vec3& point, const Vec3& direction);

  [[nodiscard]] const Vec3& point() const noexcept { return point_; }
  /// Unit length.
  [[nodiscard]] Vec3 direction() const noexcept { return rotation_.row(2).transpose(); }

  /// Rows: the frame's x, y and z.
  [[nodiscard]] const Eigen::Matrix3d& rotation() const noexcept { return rotation_; }

  /// From mesh coordinates to the frame's, and back; millimetres.
  [[nodiscard]] Vec3 to_axis(const Vec3& p) const noexcept {
    const double x = p.x() - point_.x(), y = p.y() - point_.y(), z = p.z() - point_.z();
    const auto row = [&](int i) { return (rotation_(i, 0) * x + rotation_(i, 1) * y) + rotation_(i, 2) * z; };
    return {row(0), row(1), row(2)};
  }
  [[nodiscard]] Vec3 from_axis(const Vec3& p) const noexcept { return rotation_.transpose() * p + point_; }

 private:
  Vec3 point_;
  Eigen::Matrix3d rotation_;
};

}  // namespace condyle
