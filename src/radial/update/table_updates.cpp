#include <string>

#include "condyle/error.hpp"
#include "core/coordinate_range.hpp"
#include "radial/direction_table.hpp"
#include "radial/update/slack_updates.hpp"

/// How a table follows its mesh: a refused update leaves it unchanged.

namespace condyle::radial {
namespace {

void require_in_range(PointsView positions) {
  if (const auto i = core::first_out_of_range(positions))
    throw MeshError("position " + std::to_string(*i) + " of an update is " +
                    (positions[*i].allFinite() ? "beyond 1e30 mm" : "not a finite number"));
}

}  // namespace

TriMesh& DirectionTable::deforming_mesh() {
  if (!deformed_) deformed_ = std::make_unique<TriMesh>(given_.arrays());
  return *deformed_;
}

void DirectionTable::update(PointsView vertices) {
  if (vertices.size() != mesh().vertices.size()) {
    throw UsageError("an update of " + std::to_string(mesh().vertices.size()) + " vertices gives " +
                     std::to_string(vertices.size()));
  }
  require_in_range(vertices);
  TriMesh& deforming = deforming_mesh();
  if (cube()) init_slack(deforming, table_);
  Points before;
  before.x.assign(vertices.x.begin(), vertices.x.end());
  before.y.assign(vertices.y.begin(), vertices.y.end());
  before.z.assign(vertices.z.begin(), vertices.z.end());
  std::swap(before, deforming.vertices);
  try {
    follow_all();
  } catch (...) {
    deforming.vertices = std::move(before);
    build_parts();
    throw;
  }
}

void DirectionTable::follow_all() {
  rejection_.make_out_of_date();
  if (!cube()) return build_parts();
  follow_vertices(mesh(), *cube(), table_);
  require_centre_off_surface();
  find_winding_at_centre();
}

void DirectionTable::update(std::span<const Index> moved, PointsView positions) {
  assert(moved.size() == positions.size());
  for (const Index v : moved) {
    if (v >= mesh().vertices.size())
      throw UsageError("an update moves vertex " + std::to_string(v) + " of " +
                       std::to_string(mesh().vertices.size()));
  }
  require_in_range(positions);
  TriMesh& deforming = deforming_mesh();
  if (cube()) init_slack(deforming, table_);
  Points before;
  for (const Index v : moved) before.push_back(deforming.vertices[v]);
  for (std::size_t i = 0; i < moved.size(); ++i) deforming.vertices.set(moved[i], positions[i]);
  try {
    follow_some(moved);
  } catch (...) {
    for (std::size_t i = 0; i < moved.size(); ++i) deforming.vertices.set(moved[i], before[i]);
    build_parts();
    throw;
  }
}

void DirectionTable::follow_some(std::span<const Index> moved) {
  if (!cube()) return build_parts();
  if (triangles_at_.empty()) triangles_at_ = mesh::VertexTriangles(mesh());
  const std::vector<Index> triangles = triangles_at_.of(moved);
  RejectionParts* parts = rejection_.current();
  const ChangedRadii changed =
      follow_vertices(mesh(), *cube(), moved, triangles, table_, parts ? &parts->radii : nullptr);
  for (const Index t : triangles) require_centre_off_triangle(t);
  find_winding_at_centre();
  if (!parts) return;
  if ((winding_at_centre_.value_or(0) > 0) != parts->radii.starts_at_centre) {
    rejection_.make_out_of_date();
  } else if (changed.may_be_all) {
    parts->pyramid.fill(cube()->cells_per_side(), parts->radii.of_cell);
  } else {
    parts->pyramid.refill(cube()->cells_per_side(), parts->radii.of_cell, changed.cells);
  }
}

}  // namespace condyle::radial
