#include "depth_raster.hpp"

#include <cmath>

namespace bench {
namespace {

using condyle::Index;
using condyle::Vec3;

/// Twice the signed area of (a, b, p), computed from the end with the smaller number, so that it changes its
/// sign with the edge's direction, bit for bit.
double turn(const Vec3& a, const Vec3& b, double x, double y, bool is_reversed) noexcept {
  const Vec3 &from = is_reversed ? b : a, &to = is_reversed ? a : b;
  const double area = (to.x() - from.x()) * (y - from.y()) - (to.y() - from.y()) * (x - from.x());
  return is_reversed ? -area : area;
}

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
    for (int row = rows.first; row <= rows.last; ++row) {
      for (int column = columns.first; column <= columns.last; ++column) {
        const double x = column + 0.5, y = row + 0.5;
        const double ab = turn(a, b, x, y, j < i), bc = turn(b, c, x, y, k < j), ca = turn(c, a, x, y, i < k);
        const bool left = is_left(ab, i, j);
        if (is_left(bc, j, k) != left || is_left(ca, k, i) != left) continue;
        const double area = ab + bc + ca;
        const double depth = area != 0 ? (bc * a.z() + ca * b.z() + ab * c.z()) / area : a.z();
        // Counter-clockwise seen from outside: turning left here, the normal points along the axis, out.
        out.add(plane.cell(column, row), {static_cast<float>(depth), left ? -1 : 1, t});
      }
    }
  }
  out.sort();
}

}  // namespace bench
