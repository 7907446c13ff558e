#include "radial/direction_table.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "condyle/error.hpp"
#include "core/parallel.hpp"
#include "mesh/edge_balance.hpp"
#include "radial/exact/ray_crossing.hpp"
#include "radial/query/penetration_passes.hpp"

namespace condyle::radial {
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
  // A few triangles to a cell: with finer ones each is listed more often, which costs time to build and
  // memory, and a query gains little. Sides that can be halved have deep pyramids.
  if (triangles < 6000) return triangles < 3000 ? 16 : 24;
  if (triangles < 12000) return 32;
  return triangles < 60000 ? 48 : triangles < 600000 ? 64 : 128;
}

std::variant<CartesianMap, CubeMap> make_map(const RadialOptions& options, std::size_t triangles) {
  const int side = cells_per_side(options, triangles);
  if (options.map == DirectionMapKind::cartesian) return CartesianMap(side);
  return CubeMap(side);
}

CellLists list_triangles(const TriMesh& mesh, const std::variant<CartesianMap, CubeMap>& map) {
  const auto* cube = std::get_if<CubeMap>(&map);
  if (!cube) return list_cells(mesh, std::get<CartesianMap>(map));
  CellLists lists;
  list_cells(mesh, *cube, lists);
  return lists;
}

}  // namespace

DirectionTable::DirectionTable(Mesh mesh, const RadialOptions& options)
    : mesh_(mesh.arrays()),
      map_(make_map(options, mesh_.triangles.size())),
      lists_(list_triangles(mesh_, map_)),
      boundary_edge_(mesh.unbalanced_edge()) {
  finish_lists();
}

void DirectionTable::update(PointsView vertices) {
  if (vertices.size() != mesh_.vertices.size()) {
    throw UsageError("an update of " + std::to_string(mesh_.vertices.size()) + " vertices gives " +
                     std::to_string(vertices.size()));
  }
  const auto* cube = std::get_if<CubeMap>(&map_);
  if (cube) make_rooms(mesh_, lists_);
  mesh_.vertices.x.assign(vertices.x.begin(), vertices.x.end());
  mesh_.vertices.y.assign(vertices.y.begin(), vertices.y.end());
  mesh_.vertices.z.assign(vertices.z.begin(), vertices.z.end());
  if (cube) {
    follow_vertices(mesh_, *cube, lists_);
  } else {
    lists_ = list_triangles(mesh_, map_);
  }
  finish_lists();
}

void DirectionTable::update(std::span<const Index> moved, PointsView positions) {
  const auto* cube = std::get_if<CubeMap>(&map_);
  if (cube) make_rooms(mesh_, lists_);
  for (std::size_t i = 0; i < moved.size(); ++i) mesh_.vertices.set(moved[i], positions[i]);
  if (!cube) {
    lists_ = list_triangles(mesh_, map_);
    return finish_lists();
  }
  if (triangles_at_.empty()) triangles_at_ = mesh::VertexTriangles(mesh_);
  const std::vector<Index> triangles = triangles_at_.of(moved);
  const ChangedRadii changed = follow_vertices(mesh_, *cube, moved, triangles, lists_);
  for (const Index t : triangles) require_centre_off_triangle(t);
  if (!boundary_edge_) winding_at_centre_ = find_winding_at_centre();
  if ((winding_at_centre_.value_or(0) > 0) != lists_.starts_at_centre) {
    find_all_radii();
  } else if (changed.may_be_all) {
    pyramid_.fill(cube->cells_per_side(), lists_.radii);
  } else {
    pyramid_.refill(cube->cells_per_side(), lists_.radii, changed.cells);
  }
}

/// What follows from lists, forms and vertices.
void DirectionTable::finish_lists() {
  require_centre_off_surface();
  if (!boundary_edge_) winding_at_centre_ = find_winding_at_centre();
  find_all_radii();
}

void DirectionTable::find_all_radii() {
  // Points nearer to the centre than the surface are inside and to be found where the centre is.
  lists_.starts_at_centre = winding_at_centre_.value_or(0) > 0;
  if (const auto* cube = std::get_if<CubeMap>(&map_)) {
    find_radii(*cube, lists_);
    pyramid_.fill(cube->cells_per_side(), lists_.radii);
  } else if (lists_.starts_at_centre) {
    for (RadiusWord& word : lists_.radii) word = union_of(word, radius_word(0, 0));
  }
}

void DirectionTable::require_centre_off_surface() const {
  // A form that is a number has a plane that is certainly off the centre.
  if (std::holds_alternative<CubeMap>(map_)) {
    for (const Index t : lists_.unknown) require_centre_off_triangle(t);
  } else {
    for (Index t = 0; t < mesh_.triangles.size(); ++t) require_centre_off_triangle(t);
  }
}

void DirectionTable::require_centre_off_triangle(Index t) const {
  if (!lists_.forms.empty() && !std::isnan(lists_.forms[t].x[3])) return;
  const Cone cone = cone_of(mesh_, t);
  if (core::orientation(cone.a, cone.b, cone.c) == core::Sign::zero &&
      mesh::contains_coplanar({cone.a, cone.b, cone.c}, Vec3::Zero())) {
    throw MeshError("the joint centre lies on the surface, in triangle " + std::to_string(t));
  }
}

int DirectionTable::find_winding_at_centre() const {
  // Far out the winding number is zero; every skin crossed on the way in adds what it is wound.
  const Vec3 any_direction(0, 0, 1);
  int winding = 0;
  for (const Index t : lists_.of(cell_of(any_direction))) {
    const Cone cone = cone_of(mesh_, t);
    winding += static_cast<int>(ray_crossing(any_direction, cone.a, cone.b, cone.c).outwards);
  }
  return winding;
}

CubeView DirectionTable::view_of(const CubeMap& map) const {
  return {map.cells_per_side(),
          DirectionPyramid::step_count(map.cells_per_side()),
          lists_.radii.data(),
          pyramid_.data(),
          pyramid_.all(),
          lists_.row.data(),
          lists_.triangle.data(),
          lists_.box.data(),
          lists_.slant.data(),
          lists_.nearest.data(),
          lists_.forms.data(),
          lists_.scale,
          winding_at_centre_.value_or(0),
          lists_.least_squared};
}

std::span<const Index> DirectionTable::candidates(const Vec3& v, std::vector<Index>& room) const {
  if (v == Vec3::Zero()) return {};
  const Index cell = cell_of(v);
  const auto* map = std::get_if<CubeMap>(&map_);
  if (!map) return lists_.of(cell);
  room.resize(std::max(room.size(), lists_.of(cell).size() + vector_room));
  return {room.data(), triangles_holding(view_of(*map), cell, map->box_of(v), room.data())};
}

void DirectionTable::require_closed() const {
  if (boundary_edge_) mesh::refuse_unbalanced({boundary_edge_->from, boundary_edge_->to});
}

void DirectionTable::query(PointsView points, RadialResults& out) const {
  require_closed();
  out.resize(points.size());
  core::parallel_chunks(points.size(), points_per_chunk, [&](std::size_t first, std::size_t last) {
    RayScan scan(mesh_, *winding_at_centre_);
    std::vector<Index> room;
    for (std::size_t i = first; i < last; ++i) {
      const Vec3 v = points[i];
      const RayAnswer answer = scan.answer(v, candidates(v, room));
      out.state[i] = answer.state;
      out.winding[i] = answer.winding;
      out.radial_gap_mm[i] = answer.gap;
      out.triangle[i] = answer.triangle;
      out.direction[i] = answer.direction;
      out.ray_to_normal[i] =
          answer.triangle == no_index ? Angle() : angle_to_normal(v, cone_of(mesh_, answer.triangle));
    }
  });
}

RadialTableSize DirectionTable::table_size() const noexcept {
  Index longest = 0;
  for (const CellRow& row : lists_.row) longest = std::max(longest, row.last - row.first);
  return {lists_.row.size(), lists_.entry_count(),
          lists_.bytes() + pyramid_.size() * sizeof(RadiusWord) + triangles_at_.bytes(), longest};
}

}  // namespace condyle::radial
