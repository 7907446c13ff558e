#include "depth_raster.hpp"

#include <cmath>

namespace bench {
namespace {

using condyle::Index;
using condyle::Vec3;

/// One edge of a triangle on its way round, as a point of the image sees it.
struct SeenEdge {
  Vec3 from, to;
  bool is_reversed;  ///< `from` has the larger number.

  /// Twice the signed area with the point, computed from the end with the smaller number, so that it changes
  /// its sign with the edge's direction, bit for bit.
  double side(double x, double y) const noexcept {
    const Vec3 &a = is_reversed ? to : from, &b = is_reversed ? from : to;
    const double area = (b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x());
    return is_reversed ? -area : area;
  }
  /// Decides for the point shifted by (e, e^2) where `side` is zero.
  bool has_left(double side) const noexcept { return is_left(side, {from.y() - to.y(), to.x() - from.x()}); }
};

struct PixelRange {
  int first, last;
  bool is_empty() const noexcept { return first > last; }
};

/// Pixels whose middle lies between the smallest and the largest of three coordinates, of `size` pixels.
PixelRange middles_between(double a, double b, double c, int size) noexcept {
  const double low = std::min({a, b, c}), high = std::max({a, b, c});
  if (high < 0.5 || low > size - 0.5) return {0, -1};
  return {std::max(0, static_cast<int>(std::ceil(low - 0.5))),
          std::min(size - 1, static_cast<int>(std::floor(high - 0.5)))};
}

}  // namespace

void DepthRaster::draw(condyle::PointsView vertices, std::span<const condyle::Triangle> triangles,
                       const ImagePlane& plane, double far, LayeredImage& out) {
  out.clear(static_cast<std::size_t>(plane.size[0]) * plane.size[1]);
  const std::span<const double> coordinate[3] = {vertices.x, vertices.y, vertices.z};
  seen_.x.resize(vertices.size()), seen_.y.resize(vertices.size()), seen_.z.resize(vertices.size());
  const auto across = [&](int k, int axis, std::vector<double>& to) {
    const double per_mm = 1 / plane.pixel[k];
    for (std::size_t v = 0; v < to.size(); ++v) to[v] = (coordinate[axis][v] - plane.low[k]) * per_mm;
  };
  across(0, plane.column_axis(), seen_.x);
  across(1, plane.row_axis(), seen_.y);
  std::copy(coordinate[plane.axis].begin(), coordinate[plane.axis].end(), seen_.z.begin());

  for (Index t = 0; t < triangles.size(); ++t) {
    const auto [i, j, k] = triangles[t];
    const PixelRange rows = middles_between(seen_.y[i], seen_.y[j], seen_.y[k], plane.size[1]);
    if (rows.is_empty()) continue;
    const PixelRange columns = middles_between(seen_.x[i], seen_.x[j], seen_.x[k], plane.size[0]);
    if (columns.is_empty() || std::min({seen_.z[i], seen_.z[j], seen_.z[k]}) > far) continue;
    const Vec3 a = seen_[i], b = seen_[j], c = seen_[k];
    const SeenEdge edges[3] = {{a, b, j < i}, {b, c, k < j}, {c, a, i < k}};
    for (int row = rows.first; row <= rows.last; ++row) {
      for (int column = columns.first; column <= columns.last; ++column) {
        const double x = column + 0.5, y = row + 0.5;
        const double sides[3] = {edges[0].side(x, y), edges[1].side(x, y), edges[2].side(x, y)};
        const bool left = edges[0].has_left(sides[0]);
        if (edges[1].has_left(sides[1]) != left || edges[2].has_left(sides[2]) != left) continue;
        const double area = sides[0] + sides[1] + sides[2];
        const double weighted = sides[1] * a.z() + sides[2] * b.z() + sides[0] * c.z();
        const double depth = area != 0 ? weighted / area : a.z();
        // Counter-clockwise seen from outside: turning left here, the normal points along the axis, out.
        out.add(plane.cell(column, row), {static_cast<float>(depth), left ? -1 : 1, t});
      }
    }
  }
  out.sort();
}

}  // namespace bench
