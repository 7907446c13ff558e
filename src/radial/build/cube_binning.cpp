#include "radial/build/cube_binning.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace condyle::radial {
namespace {

/// Triangles processed together: their results stay in the nearest cache.
constexpr std::size_t triangles_per_chunk = 1024;

/// See Binning.
constexpr std::size_t padding_cells = 4;

constexpr CellDop whole_cell{packed_range(0, 255, 0, 255), packed_range(0, 255, 0, 255)};

/// Rounding of a place on a face: 4 u, u = 2^-24, that of a division and of the floats divided; for vertices
/// that are given as they are placed.
constexpr double place_error = 0x1p-22;

/// Where a corner may be: within `slack` of its direction, on that one's face.
struct PlacedCorner {
  Vec3 direction;  ///< the face's coordinate is 1 or -1
  double slack;
};

PlacedCorner corner_at(const PlacedVertices& placed, Index vertex) {
  const FacePoint low = placed.lowest(vertex), high = placed.highest(vertex);
  const int face = placed.face[vertex], axis = face % 3;
  PlacedCorner corner;
  corner.direction[axis] = face < 3 ? 1 : -1;
  corner.direction[(axis + 1) % 3] = 0.5 * (double{low.u()} + double{high.u()});
  corner.direction[(axis + 2) % 3] = 0.5 * (double{low.w()} + double{high.w()});
  corner.slack =
      0.5 * std::max(double{high.u()} - double{low.u()}, double{high.w()} - double{low.w()}) + place_error;
  return corner;
}

/// A face takes those rays whose largest coordinate is its own: a triangle with all corners beyond one
/// side of that pyramid keeps off it.
bool keeps_off(const std::array<PlacedCorner, 3>& corner, int face) {
  const int axis = face % 3;
  const double widening = 1 + 2 * double{list_margin}, sign = (face < 3 ? 1 : -1) * widening;
  for (const int side : {(axis + 1) % 3, (axis + 2) % 3}) {
    const auto all = [&](double way) {
      return std::all_of(corner.begin(), corner.end(), [&](const PlacedCorner& c) {
        return sign * c.direction[axis] + (widening + 1) * c.slack < way * c.direction[side];
      });
    };
    if (all(1) || all(-1)) return true;
  }
  return false;
}

/// With all corners well in front of the other faces' planes, their places on this face are those of a plane
/// triangle, within four times its size.
bool is_in_front(const std::array<PlacedCorner, 3>& corner, int face) {
  return std::all_of(corner.begin(), corner.end(), [&](const PlacedCorner& c) {
    const double depth = face < 3 ? c.direction[face % 3] : -c.direction[face % 3];
    return 4 * (depth - c.slack) >= c.direction.cwiseAbs().maxCoeff();
  });
}

/// Where the triangle falls on a face that it is in front of. A corner (depth, u, w) that is displaced by
/// up to s in each is displaced by at most s (1 + |u / depth|) / (depth - s) on the face.
void project_on(const std::array<PlacedCorner, 3>& corner, int face, FaceCorners& at_u, FaceCorners& at_w) {
  const int axis = face % 3;
  at_u.slack = at_w.slack = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double depth = std::abs(corner[k].direction[axis]), inverse = 1 / depth;
    const double u = corner[k].direction[(axis + 1) % 3] * inverse;
    const double w = corner[k].direction[(axis + 2) % 3] * inverse;
    const double displaced = corner[k].slack / (depth - corner[k].slack);
    const auto slack = [&](double at) { return static_cast<float>(displaced * (1 + std::abs(at))); };
    at_u.at[k] = static_cast<float>(u), at_w.at[k] = static_cast<float>(w);
    at_u.slack = std::max(at_u.slack, slack(u));
    at_w.slack = std::max(at_w.slack, slack(w));
  }
}

}  // namespace

MeshView view_of(PointsView vertices, std::span<const Triangle> triangles) noexcept {
  return {.x = vertices.x.data(),
          .y = vertices.y.data(),
          .z = vertices.z.data(),
          .xyz = nullptr,
          .vertices = vertices.size(),
          .corner = triangles.empty() ? nullptr : triangles[0].data(),
          .triangles = triangles.size()};
}

CubeBinning::CubeBinning(PointsView vertices, std::span<const Triangle> triangles, const CubeMap& map,
                         const PlacedVertices& placed)
    : vertices_(vertices),
      triangles_(triangles),
      map_(map),
      placed_(placed),
      n_(map.cells_per_side()),
      length_(map.cell_count() + padding_cells, 0) {}

void CubeBinning::bin() {
  const std::size_t triangles = triangles_.size();
  const MeshView view = view_of(vertices_, triangles_);
  // Capacity for more cells than meshes take that fit the map: what is not written costs nothing.
  entry_.resize(6 * triangles);
  std::array<std::uint32_t, triangles_per_chunk> larger;
  for (std::size_t first = 0; first < triangles; first += triangles_per_chunk) {
    const std::size_t last = std::min(first + triangles_per_chunk, triangles);
    reserve(4 * (last - first));
    Binning small = scratch();
    small.elsewhere = larger.data();
    bin_small_triangles(view, placed_, first, last, small);
    count_ = small.count;
    for (std::size_t i = 0; i < small.elsewhere_count; ++i) bin_larger(larger[i]);
    bin_projected();
  }
}

void CubeBinning::reserve(std::size_t entries) {
  const std::size_t needed = entries + binning_padding;
  if (entry_.size() >= count_ + needed) return;
  core::UninitialisedVector<CellEntry> next(std::max(needed, entry_.size()));
  entry_.resize(count_);
  full_.push_back(std::move(entry_));
  entry_ = std::move(next), count_ = 0;
}

void CubeBinning::bin_larger(Index triangle) {
  // It is projected on six faces at most.
  if (projected_count_ + 6 > most_projected) bin_projected();
  if (!project_on_one_face(triangle) && !project_on_faces(triangle)) bin_clipped(triangle);
}

/// False if it reaches over the face's edges.
bool CubeBinning::project_on_one_face(Index triangle) {
  const Triangle& vertex = triangles_[triangle];
  const int face = placed_.face[vertex[0]];
  if (placed_.face[vertex[1]] != face || placed_.face[vertex[2]] != face) return false;
  // In its place: what is copied right after it was written in parts is waited for.
  FaceCorners &u = projected_u_[projected_count_], &w = projected_w_[projected_count_];
  u.slack = w.slack = 0;
  float furthest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const FacePoint low = placed_.lowest(vertex[k]), high = placed_.highest(vertex[k]);
    furthest = std::max({furthest, -low.u(), -low.w(), high.u(), high.w()});
    u.at[k] = 0.5f * (low.u() + high.u()), w.at[k] = 0.5f * (low.w() + high.w());
    u.slack = std::max(u.slack, 0.5f * (high.u() - low.u()));
    w.slack = std::max(w.slack, 0.5f * (high.w() - low.w()));
  }
  if (furthest >= 1 - 2 * list_margin) return false;
  add_projected(triangle, face);
  return true;
}

/// False if it is too near to the plane between the centre and a face.
bool CubeBinning::project_on_faces(Index triangle) {
  const Triangle& at = triangles_[triangle];
  const std::array<PlacedCorner, 3> corner = {corner_at(placed_, at[0]), corner_at(placed_, at[1]),
                                              corner_at(placed_, at[2])};
  std::array<bool, 6> is_projected{};
  for (int face = 0; face < 6; ++face) {
    is_projected[static_cast<std::size_t>(face)] = !keeps_off(corner, face);
    if (is_projected[static_cast<std::size_t>(face)] && !is_in_front(corner, face)) return false;
  }
  for (int face = 0; face < 6; ++face) {
    if (!is_projected[static_cast<std::size_t>(face)]) continue;
    project_on(corner, face, projected_u_[projected_count_], projected_w_[projected_count_]);
    add_projected(triangle, face);
  }
  return true;
}

void CubeBinning::add_projected(Index triangle, int face) {
  projected_triangle_[projected_count_] = triangle, projected_face_[projected_count_] = face;
  ++projected_count_;
}

void CubeBinning::bin_projected() {
  const ProjectedTriangles projected{.u = projected_u_.data(),
                                     .w = projected_w_.data(),
                                     .triangle = projected_triangle_.data(),
                                     .face = projected_face_.data(),
                                     .count = projected_count_};
  for (std::size_t binned = 0; binned < projected_count_;) {
    Binning larger = scratch();
    binned = bin_projected_triangles(projected, binned, larger);
    count_ = larger.count;
    // A triangle is in all cells of a face at most.
    if (binned < projected_count_)
      reserve(static_cast<std::size_t>(n_) * static_cast<std::size_t>(n_) + binning_padding);
  }
  projected_count_ = 0;
}

void CubeBinning::bin_clipped(Index triangle) {
  has_clipped_ = true;
  const auto& [a, b, c] = triangles_[triangle];
  const Cone cone{vertices_[a], vertices_[b], vertices_[c]};
  map_.visit_cells(cone, [&](const CellOverlap& overlap) {
    reserve(1);
    entry_[count_++] = {overlap.cell, triangle, whole_cell};
    ++length_[overlap.cell];
  });
}

}  // namespace condyle::radial
