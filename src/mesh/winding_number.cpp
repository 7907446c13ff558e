#include "mesh/winding_number.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/parallel.hpp"
#include "core/predicates.hpp"
#include "mesh/edge_balance.hpp"
#include "mesh/vertical_ray.hpp"

namespace condyle::mesh {
namespace {

/// Points a thread takes at a time: some 100 us of work, far above the cost of handing it out.
constexpr std::size_t grain = 256;

using Corners = TriangleCorners;

/// Whether p lies within the closed triangle as seen along one axis; of a triangle seen edge on, whether it
/// may.
bool holds_seen_along(const Corners& t, const Vec3& p, int axis) noexcept {
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  bool left = false, right = false;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 &a = t[k], &b = t[(k + 1) % 3];
    const core::Sign side = core::orientation_2d(a[i], a[j], b[i], b[j], p[i], p[j]);
    left |= side == core::Sign::positive, right |= side == core::Sign::negative;
  }
  return !(left && right);
}

/// Whether p, known to be in the triangle's plane, lies in the closed triangle: it must as seen along every
/// axis, and along one of them at least the triangle is not seen edge on. A triangle without area holds
/// nothing: the edges it hangs on belong to its neighbours.
bool holds(const Corners& t, const Vec3& p) noexcept {
  bool has_area = false;
  for (int axis = 0; axis < 3; ++axis) {
    if (!holds_seen_along(t, p, axis)) return false;
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    has_area |=
        core::orientation_2d(t[0][i], t[0][j], t[1][i], t[1][j], t[2][i], t[2][j]) != core::Sign::zero;
  }
  return has_area;
}

}  // namespace

template <class Visit>
void WindingNumber::for_each_cell(std::size_t triangle, const Visit& visit) const {
  const Vec3 a = mesh_.corner(triangle, 0), b = mesh_.corner(triangle, 1), c = mesh_.corner(triangle, 2);
  const Vec3 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
  const Index first = column_at(low.x()), last = column_at(high.x()), top = row_at(high.y());
  for (Index row = row_at(low.y()); row <= top; ++row) {
    for (Index column = first; column <= last; ++column)
      visit(static_cast<std::size_t>(row) * columns_ + column);
  }
}

WindingNumber::WindingNumber(Mesh mesh) : mesh_(std::move(mesh)) {
  if (const auto& edge = mesh_.unbalanced_edge()) refuse_unbalanced(*edge);
  if (mesh_.triangles().empty()) {
    offset_.assign(2, 0);
    high_.setConstant(-std::numeric_limits<double>::infinity());
    return;
  }
  low_.setConstant(std::numeric_limits<double>::infinity());
  high_ = -low_;
  for (std::size_t t = 0; t < mesh_.triangles().size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const Vec3 p = mesh_.corner(t, k);
      low_ = low_.cwiseMin(p), high_ = high_.cwiseMax(p);
    }
  }
  // A surface covers the grid about twice or more, so with a cell per triangle a cell is about as wide as a
  // triangle: wider cells lengthen the lists, narrower ones repeat every triangle in many.
  const double width = high_.x() - low_.x(), height = high_.y() - low_.y();
  const double target = static_cast<double>(mesh_.triangles().size());
  const double side =
      std::max({std::sqrt(width) * std::sqrt(height / target), width / target, height / target});
  if (side > 0) {
    const auto count = [&](double extent) {
      return static_cast<Index>(std::clamp(std::ceil(extent / side), 1.0, target));
    };
    columns_ = count(width), rows_ = count(height);
  }
  if (width > 0) cell_.x() = width / columns_;
  if (height > 0) cell_.y() = height / rows_;

  offset_.assign(static_cast<std::size_t>(columns_) * rows_ + 1, 0);
  for (std::size_t t = 0; t < mesh_.triangles().size(); ++t) {
    for_each_cell(t, [&](std::size_t cell) { ++offset_[cell + 1]; });
  }
  for (std::size_t cell = 1; cell < offset_.size(); ++cell) offset_[cell] += offset_[cell - 1];
  triangle_.resize(offset_.back());
  std::vector<Index> next(offset_.begin(), offset_.end() - 1);
  for (std::size_t t = 0; t < mesh_.triangles().size(); ++t) {
    for_each_cell(t, [&](std::size_t cell) { triangle_[next[cell]++] = static_cast<Index>(t); });
  }
}

PointWinding WindingNumber::at(const Vec3& p) const noexcept {
  if (!(p.array() >= low_.array()).all() || !(p.array() <= high_.array()).all()) return {};
  const std::size_t cell = static_cast<std::size_t>(row_at(p.y())) * columns_ + column_at(p.x());
  int winding = 0;
  for (Index i = offset_[cell]; i < offset_[cell + 1]; ++i) {
    const Corners t = {mesh_.corner(triangle_[i], 0), mesh_.corner(triangle_[i], 1),
                       mesh_.corner(triangle_[i], 2)};
    const Vec3 low = t[0].cwiseMin(t[1]).cwiseMin(t[2]), high = t[0].cwiseMax(t[1]).cwiseMax(t[2]);
    // The ray goes up, and the shift moves the point by less than any distance: outside the closed rectangle
    // is outside.
    if (p.z() > high.z() || p.x() < low.x() || p.x() > high.x() || p.y() < low.y() || p.y() > high.y())
      continue;
    if (p.z() < low.z()) {
      winding += vertical_crossing(t, p);
      continue;
    }
    const core::Sign side = core::orientation(t[0], t[1], t[2], p);
    if (side == core::Sign::zero) {
      if (holds(t, p)) return {PointState::on_surface, 0, triangle_[i]};
      continue;
    }
    // Below a triangle that faces up, or above-behind one that faces down: the point is on the side the ray
    // comes from.
    const int sense = vertical_crossing(t, p);
    if (sense * static_cast<int>(side) < 0) winding += sense;
  }
  return {winding > 0 ? PointState::inside : PointState::outside, winding, no_index};
}

void WindingNumber::at(PointsView points, std::vector<PointWinding>& out) const {
  out.resize(points.size());
  core::parallel_chunks(points.size(), grain, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) out[i] = at(points[i]);
  });
}

std::vector<PointWinding> WindingNumber::at(PointsView points) const {
  std::vector<PointWinding> out;
  at(points, out);
  return out;
}

std::size_t WindingNumber::bytes() const noexcept {
  return (offset_.capacity() + triangle_.capacity()) * sizeof(Index) +
         mesh_.triangles().capacity() * sizeof(Triangle) + 3 * mesh_.vertices().size() * sizeof(double);
}

}  // namespace condyle::mesh
