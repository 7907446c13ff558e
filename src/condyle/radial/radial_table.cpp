#include "condyle/radial/radial_table.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "condyle/core/error.hpp"
#include "condyle/core/parallel.hpp"
#include "condyle/mesh/edge_balance.hpp"
#include "condyle/radial/penetration_passes.hpp"
#include "condyle/radial/ray_crossing.hpp"

namespace condyle {
namespace {

/// Points per task: enough to outweigh starting one.
constexpr std::size_t points_per_chunk = 256;

/// Cells along a side for a mesh of so many triangles.
int cells_per_side(const RadialOptions& options, std::size_t triangles) {
  // 2048^2 cells a face is 25 million cells: past that the table outgrows any mesh it could serve.
  if (options.cells_per_side && (*options.cells_per_side < 1 || *options.cells_per_side > 2048)) {
    throw UsageError("cells_per_side is " + std::to_string(*options.cells_per_side) +
                     ", not within 1 to 2048");
  }
  if (options.cells_per_side) return *options.cells_per_side;
  if (options.map == DirectionMapKind::cartesian) return 64;
  // A few triangles to a cell: finer cells hardly shorten a query, and each doubles the time to build, since
  // a triangle is then listed in more of them. Powers of two have the deepest pyramids.
  if (triangles < 6000) return triangles < 3000 ? 16 : 24;
  return triangles < 60000 ? 32 : triangles < 600000 ? 64 : 128;
}

std::variant<CartesianMap, CubeMap> make_map(const RadialOptions& options, std::size_t triangles) {
  const int side = cells_per_side(options, triangles);
  if (options.map == DirectionMapKind::cartesian) return CartesianMap(side);
  return CubeMap(side);
}

/// Some triangles of a mesh, each with corners of its own.
TriMesh parts_of(const TriMesh& mesh, std::span<const Index> triangles) {
  TriMesh parts;
  parts.vertices.reserve(3 * triangles.size());
  for (const Index t : triangles) {
    for (int k = 0; k < 3; ++k) parts.vertices.push_back(mesh.corner(t, k));
    const auto first = static_cast<Index>(3 * parts.triangles.size());
    parts.triangles.push_back({first, first + 1, first + 2});
  }
  return parts;
}

}  // namespace

void RadialHits::resize(std::size_t count) {
  state.resize(count), winding.resize(count), radial_gap.resize(count);
  triangle.resize(count), direction.resize(count), ray_to_normal.resize(count);
}

RadialTable::RadialTable(TriMesh mesh, RadialOptions options)
    : mesh_(std::move(mesh)),
      map_(make_map(options, mesh_.triangles.size())),
      lists_(std::visit([&](const auto& map) { return list_cells(mesh_, map); }, map_)) {
  for (Index t = 0; t < mesh_.triangles.size(); ++t) require_centre_off_triangle(t);
  boundary_edge_ = unbalanced_edge(mesh_);
  prepare_radii();
}

void RadialTable::update(PointsView vertices) {
  if (vertices.size() != mesh_.vertices.size()) {
    throw UsageError("an update of " + std::to_string(mesh_.vertices.size()) + " vertices gives " +
                     std::to_string(vertices.size()));
  }
  mesh_.vertices.x.assign(vertices.x.begin(), vertices.x.end());
  mesh_.vertices.y.assign(vertices.y.begin(), vertices.y.end());
  mesh_.vertices.z.assign(vertices.z.begin(), vertices.z.end());
  list_again();
}

void RadialTable::list_again() {
  if (const auto* cube = std::get_if<CubeMap>(&map_)) {
    list_cells(mesh_, *cube, lists_);
  } else {
    lists_ = list_cells(mesh_, std::get<CartesianMap>(map_));
  }
  for (Index t = 0; t < mesh_.triangles.size(); ++t) require_centre_off_triangle(t);
  prepare_radii();
}

void RadialTable::update(std::span<const Index> moved, PointsView positions) {
  std::vector<unsigned char> is_moved(mesh_.vertices.size());
  for (const Index v : moved) is_moved[v] = 1;
  std::vector<Index> triangles;
  for (Index t = 0; t < mesh_.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh_.triangles[t];
    if ((is_moved[a] | is_moved[b] | is_moved[c]) != 0) triangles.push_back(t);
  }
  const TriMesh before = parts_of(mesh_, triangles);
  for (std::size_t i = 0; i < moved.size(); ++i) mesh_.vertices.set(moved[i], positions[i]);
  const auto* cube = std::get_if<CubeMap>(&map_);
  if (!cube) return list_again();

  for (std::size_t i = 0; i < moved.size(); ++i) lists_.corner[moved[i]] = positions[i];
  const bool grown = move_triangles(*cube, triangles, before, parts_of(mesh_, triangles), lists_);
  for (const Index t : triangles) require_centre_off_triangle(t);
  if (!boundary_edge_) {
    // Radii count from the centre, or not, as it is inside or outside: they are not told apart afterwards.
    const bool was_inside = *winding_at_centre_ > 0;
    winding_at_centre_ = find_winding_at_centre();
    if (was_inside != (*winding_at_centre_ > 0)) return list_again();
  }
  if (grown) prepare_radii();
}

void RadialTable::prepare_radii() {
  if (!boundary_edge_) winding_at_centre_ = find_winding_at_centre();
  if (winding_at_centre_.value_or(0) > 0) {
    // Points nearer to the centre than the surface are inside and to be found: no radius is too small.
    for (RadiusWord& word : lists_.radii) word = union_of(word, radius_word(0, 0));
  }
  if (const auto* cube = std::get_if<CubeMap>(&map_)) pyramid_.fill(cube->cells_per_side(), lists_.radii);
}

void RadialTable::require_centre_off_triangle(Index t) const {
  // A form that is a number has a plane that is certainly off the centre.
  if (!lists_.forms.empty() && !std::isnan(lists_.forms[t].x[3])) return;
  const Cone cone = cone_of(mesh_, t);
  if (orientation(cone.a, cone.b, cone.c) == Sign::zero &&
      contains_coplanar({cone.a, cone.b, cone.c}, Vec3::Zero())) {
    throw MeshError("the joint centre lies on the surface, in triangle " + std::to_string(t));
  }
}

int RadialTable::find_winding_at_centre() const {
  // Far out the winding number is zero; every skin crossed on the way in adds what it is wound.
  const Vec3 any_direction(0, 0, 1);
  int winding = 0;
  for (const Index t : lists_.of(cell_of(any_direction))) {
    const Cone cone = cone_of(mesh_, t);
    winding += static_cast<int>(ray_crossing(any_direction, cone.a, cone.b, cone.c).outwards);
  }
  return winding;
}

CubeView RadialTable::view_of(const CubeMap& map) const {
  return {map.cells_per_side(),  DirectionPyramid::step_count(map.cells_per_side()),
          lists_.radii.data(),   pyramid_.data(),
          lists_.row.data(),     lists_.triangle.data(),
          lists_.box.data(),     lists_.slant.data(),
          lists_.nearest.data(), lists_.forms.data(),
          lists_.scale,          winding_at_centre_.value_or(0),
          lists_.least_squared};
}

std::span<const Index> RadialTable::candidates(const Vec3& v, std::vector<Index>& room) const {
  if (v == Vec3::Zero()) return {};
  const Index cell = cell_of(v);
  const auto* map = std::get_if<CubeMap>(&map_);
  if (!map) return lists_.of(cell);
  room.resize(std::max(room.size(), lists_.of(cell).size() + vector_room));
  return {room.data(), triangles_holding(view_of(*map), cell, map->box_of(v), room.data())};
}

void RadialTable::require_closed() const {
  if (boundary_edge_) refuse_unbalanced(*boundary_edge_);
}

void RadialTable::query(PointsView points, RadialHits& out) const {
  require_closed();
  out.resize(points.size());
  parallel_chunks(points.size(), points_per_chunk, [&](std::size_t first, std::size_t last) {
    RayScan scan(mesh_, *winding_at_centre_);
    std::vector<Index> room;
    for (std::size_t i = first; i < last; ++i) {
      const Vec3 v = points[i];
      const RayAnswer answer = scan.answer(v, candidates(v, room));
      out.state[i] = answer.state;
      out.winding[i] = answer.winding;
      out.radial_gap[i] = answer.gap;
      out.triangle[i] = answer.triangle;
      out.direction[i] = answer.direction;
      out.ray_to_normal[i] =
          answer.triangle == no_index ? 0 : angle_to_normal(v, cone_of(mesh_, answer.triangle));
    }
  });
}

RadialHits RadialTable::query(PointsView points) const {
  RadialHits out;
  query(points, out);
  return out;
}

void RadialTable::query_states(PointsView points, std::vector<PointState>& out) const {
  require_closed();
  out.resize(points.size());
  const PointState state_at_centre = *winding_at_centre_ > 0 ? PointState::inside : PointState::outside;
  parallel_chunks(points.size(), points_per_chunk, [&](std::size_t first, std::size_t last) {
    RayScan scan(mesh_, *winding_at_centre_);
    std::vector<Index> room;
    for (std::size_t i = first; i < last; ++i) {
      const Vec3 v = points[i];
      if (v == Vec3::Zero()) {
        out[i] = state_at_centre;
        continue;
      }
      const Index cell = cell_of(v);
      const SquaredRadii radii = radii_of(cell);
      const double squared_radius = v.squaredNorm();
      if (squared_radius < radii.least) {
        out[i] = state_at_centre;
      } else if (squared_radius > radii.greatest) {
        out[i] = PointState::outside;
      } else {
        out[i] = scan.state(v, candidates(v, room));
      }
    }
  });
}

RadialTableSize RadialTable::table_size() const noexcept {
  Index longest = 0;
  for (const CellRow& row : lists_.row) longest = std::max(longest, row.last - row.first);
  return {lists_.row.size(), lists_.entry_count(), lists_.bytes() + pyramid_.size() * sizeof(RadiusWord),
          longest};
}

}  // namespace condyle
