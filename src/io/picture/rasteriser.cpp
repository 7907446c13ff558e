#include "io/picture/rasteriser.hpp"

#include <algorithm>
#include <cmath>

namespace condyle::io {
namespace {

/// Twice the area of (a, b, p), a linear function of p.
struct EdgeFunction {
  double by_x, by_y, rest;

  EdgeFunction(const Points& v, Index a, Index b)
      : by_x(v.y[a] - v.y[b]), by_y(v.x[b] - v.x[a]), rest(-by_x * v.x[a] - by_y * v.y[a]) {}
  double operator()(double x, double y) const noexcept { return by_x * x + by_y * y + rest; }
};

/// Samples whose middles lie in [low, high], of `count`: first and one past the last.
std::array<std::size_t, 2> samples_between(double low, double high, std::size_t count) noexcept {
  // NaN, from positions beyond all numbers, is before the first.
  const auto clamped = [&](double value) {
    return value > 0 ? static_cast<std::size_t>(std::min(value, static_cast<double>(count))) : 0;
  };
  return {clamped(std::ceil(low - 0.5)), clamped(std::floor(high - 0.5) + 1)};
}

}  // namespace

std::array<double, 3> corner_shares(const FlatMesh& mesh, Index triangle, double x, double y) noexcept {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const double of_a = EdgeFunction(mesh.vertices, b, c)(x, y), of_b = EdgeFunction(mesh.vertices, c, a)(x, y),
               of_c = EdgeFunction(mesh.vertices, a, b)(x, y);
  const double all = of_a + of_b + of_c;
  return {of_a / all, of_b / all, of_c / all};
}

Rasteriser::Rasteriser(const FlatMesh& mesh, std::size_t columns, std::size_t rows, std::size_t strip_rows)
    : mesh_(mesh), columns_(columns), strip_rows_(strip_rows), strips_((rows + strip_rows - 1) / strip_rows) {
  const auto& y = mesh.vertices.y;
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const auto [low, high] = std::minmax({y[a], y[b], y[c]});
    const auto [first, end] = samples_between(low, high, rows);
    if (first == end) continue;
    for (std::size_t strip = first / strip_rows; strip <= (end - 1) / strip_rows; ++strip)
      strips_[strip].push_back(t);
  }
}

void Rasteriser::draw(std::size_t strip, std::span<Hit> hits) const {
  const Points& v = mesh_.vertices;
  const double top = static_cast<double>(strip * strip_rows_);
  for (const Index t : strips_[strip]) {
    const auto& [a, b, c] = mesh_.triangles[t];
    const EdgeFunction of_a(v, b, c), of_b(v, c, a), of_c(v, a, b);
    const double area = of_a.rest + of_b.rest + of_c.rest;
    if (area == 0) continue;
    const double sense = area < 0 ? -1 : 1;
    const auto [left, right] = std::minmax({v.x[a], v.x[b], v.x[c]});
    const auto [low, high] = std::minmax({v.y[a], v.y[b], v.y[c]});
    const auto [first_column, end_column] = samples_between(left, right, columns_);
    const auto [first_row, end_row] = samples_between(low - top, high - top, strip_rows_);
    for (std::size_t row = first_row; row < end_row; ++row) {
      const double y = top + static_cast<double>(row) + 0.5;
      for (std::size_t column = first_column; column < end_column; ++column) {
        const double x = static_cast<double>(column) + 0.5;
        const double share_a = sense * of_a(x, y), share_b = sense * of_b(x, y), share_c = sense * of_c(x, y);
        if (share_a < 0 || share_b < 0 || share_c < 0) continue;
        const double z = (share_a * v.z[a] + share_b * v.z[b] + share_c * v.z[c]) / (sense * area);
        Hit& hit = hits[row * columns_ + column];
        if (hit.triangle == no_index || z > hit.z) hit = {z, t};
      }
    }
  }
}

}  // namespace condyle::io
