#include "support/voxelised.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "condyle/label_surface.hpp"

namespace condyle::test {
namespace {

std::vector<Vec3> in_index_space(const TriMesh& mesh, const Eigen::Affine3d& X_WI) {
  const Eigen::Affine3d X_IW = X_WI.inverse();
  std::vector<Vec3> points;
  points.reserve(mesh.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) points.push_back(X_IW * mesh.vertices[v]);
  return points;
}

/// Where an edge meets the plane of a slice, as (i, j): the same bits for both triangles of the edge.
struct SlicePoint {
  double i, j;
};

SlicePoint cut_of_edge(const std::vector<Vec3>& points, Index from, Index to, double k) {
  const Vec3 &a = points[std::min(from, to)], &b = points[std::max(from, to)];
  const double t = (k - a.z()) / (b.z() - a.z());
  return {a.x() + t * (b.x() - a.x()), a.y() + t * (b.y() - a.y())};
}

/// Adds `turns` to the winding number of all voxels of a row from the crossing on.
class Rows {
 public:
  Rows(std::int64_t columns, std::int64_t rows)
      : columns_(columns), begins_(static_cast<std::size_t>(columns * rows)) {}

  void cross(std::int64_t row, double at, int turns) {
    const double first = std::max(0.0, std::ceil(at));
    if (first >= static_cast<double>(columns_)) return;
    begins_[static_cast<std::size_t>(row * columns_ + static_cast<std::int64_t>(first))] += turns;
  }
  /// Writes 1 where the winding number is not 0, and starts anew.
  void take(std::uint8_t* inside) {
    const auto columns = static_cast<std::size_t>(columns_);
    int winding = 0;
    for (std::size_t v = 0; v < begins_.size(); ++v) {
      if (v % columns == 0) winding = 0;
      winding += begins_[v];
      inside[v] = winding != 0;
      begins_[v] = 0;
    }
  }

 private:
  std::int64_t columns_;
  std::vector<int> begins_;
};

/// The slice of one triangle: a segment that passes the rows between its ends, upwards in j or downwards.
void cross_rows(SlicePoint from, SlicePoint to, const VoxelMask& mask, Rows& rows) {
  if (from.j == to.j) return;
  const int turns = from.j < to.j ? 1 : -1;
  if (turns < 0) std::swap(from, to);
  const auto low = static_cast<double>(mask.first[1]), high = low + static_cast<double>(mask.size[1]);
  // Rows j with from.j < j <= to.j.
  const double begin = std::max(low, std::floor(from.j) + 1), end = std::min(high, std::floor(to.j) + 1);
  for (double j = begin; j < end; ++j) {
    const double i = from.i + (j - from.j) / (to.j - from.j) * (to.i - from.i);
    rows.cross(static_cast<std::int64_t>(j - low), i - static_cast<double>(mask.first[0]), turns);
  }
}

}  // namespace

VoxelMask voxelised(const TriMesh& mesh, const VoxelGrid& grid) {
  VoxelMask mask{grid, {}, {}, {}};
  const std::vector<Vec3> points = in_index_space(mesh, grid.X_WI);
  if (points.empty()) return mask;
  Vec3 low = points[0], high = points[0];
  for (const Vec3& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  for (std::size_t a = 0; a < 3; ++a) {
    const auto axis = static_cast<Eigen::Index>(a);
    const auto last = static_cast<double>(grid.size[a] - 1);
    mask.first[a] = static_cast<std::int64_t>(std::clamp(std::ceil(low[axis]), 0.0, last));
    mask.size[a] =
        static_cast<std::int64_t>(std::clamp(std::floor(high[axis]), 0.0, last)) - mask.first[a] + 1;
    if (mask.size[a] <= 0 || high[axis] < 0 || low[axis] > last) return {grid, {}, {}, {}};
  }
  const auto slice = static_cast<std::size_t>(mask.size[0] * mask.size[1]);
  mask.inside.resize(slice * static_cast<std::size_t>(mask.size[2]));

  // A vertex on a slice counts as above it: a triangle passes slices k with least < k <= most.
  std::vector<std::vector<std::size_t>> passing(static_cast<std::size_t>(mask.size[2]));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    const auto [least, most] = std::minmax({points[a].z(), points[b].z(), points[c].z()});
    const auto begin =
        std::max(std::int64_t{0}, static_cast<std::int64_t>(std::floor(least)) + 1 - mask.first[2]);
    const auto end = std::min(mask.size[2], static_cast<std::int64_t>(std::floor(most)) + 1 - mask.first[2]);
    for (std::int64_t s = begin; s < end; ++s) passing[static_cast<std::size_t>(s)].push_back(t);
  }
  Rows rows(mask.size[0], mask.size[1]);
  for (std::size_t s = 0; s < passing.size(); ++s) {
    const auto k = static_cast<double>(mask.first[2] + static_cast<std::int64_t>(s));
    for (const std::size_t t : passing[s]) {
      const Triangle& corners = mesh.triangles[t];
      // Up through one side of the triangle and down through another: its segment goes from one to the other.
      SlicePoint up{}, down{};
      for (std::size_t c = 0; c < 3; ++c) {
        const Index from = corners[c], to = corners[(c + 1) % 3];
        const bool starts_below = points[from].z() < k, ends_below = points[to].z() < k;
        if (starts_below == ends_below) continue;
        (starts_below ? up : down) = cut_of_edge(points, from, to, k);
      }
      cross_rows(up, down, mask, rows);
    }
    rows.take(mask.inside.data() + s * slice);
  }
  return mask;
}

VoxelGrid grid_around(const TriMesh& a, const TriMesh& b, const Eigen::Matrix3d& steps, const Vec3& through,
                      int margin) {
  const Eigen::Matrix3d to_index = steps.inverse();
  Vec3 low = Vec3::Constant(HUGE_VAL), high = -low;
  for (const TriMesh* mesh : {&a, &b})
    for (std::size_t v = 0; v < mesh->vertices.size(); ++v) {
      const Vec3 p = to_index * (mesh->vertices[v] - through);
      low = low.cwiseMin(p), high = high.cwiseMax(p);
    }
  VoxelGrid grid;
  Vec3 first;
  for (int axis = 0; axis < 3; ++axis) {
    first[axis] = std::floor(low[axis]) - margin;
    grid.size[static_cast<std::size_t>(axis)] =
        static_cast<std::int64_t>(std::ceil(high[axis]) + margin - first[axis]) + 1;
  }
  grid.X_WI.linear() = steps;
  grid.X_WI.translation() = through + steps * first;
  return grid;
}

Body body_of(std::string name, const VoxelMask& mask) {
  LabelSurface surface = surface_of(mask);
  BodyImage image{mask.image.X_WI.linear(), {}};
  for (const CapPlane& cap : surface.caps) image.cuts.push_back({cap.normal, cap.offset});
  return {.name = std::move(name), .mesh = std::move(surface.mesh), .image = std::move(image)};
}

}  // namespace condyle::test
