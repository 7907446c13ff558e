#include <algorithm>
#include <cmath>
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

/// The drift of a surface by up to so many mm, which was no nearer to the centre than that; empty where the finest tiles of the
/// pyramid have no slack for it.
///
/// A point that moves by d from a distance of at least r is seen to move by at most asin(d / r), a chord of 1.04 d / r up to
/// r / 4, and on a face by at most sqrt(6) times that over 1 - sqrt(3) times that: see are_near() in penetration_passes.cpp.
std::optional<Drift> drift_of(double moved_mm, double nearest_mm, int cells_per_side) {
  const double mm = moved_mm * (1 + 0x1p-20) + 0x1p-60;
  if (!(mm < nearest_mm / 4) || !std::isfinite(nearest_mm)) return {};
  const double sine = 1.04 * mm / nearest_mm, opening = std::sqrt(3.0) * sine;
  if (opening > 0.5) return {};
  const double cells = 0.5 * cells_per_side * std::sqrt(6.0) * sine / (1 - opening) * (1 + 0x1p-10) + 0.01;
  const int level = cells <= 1 ? 0 : cells <= 2 ? 1 : 2;
  if (cells > 3 || level >= DirectionPyramid::level_count(cells_per_side)) return {};
  return Drift{static_cast<float>(mm * (1 + 0x1p-20)), static_cast<float>(sine * (1 + 0x1p-20)), level};
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
  spare_.x.assign(vertices.x.begin(), vertices.x.end());
  spare_.y.assign(vertices.y.begin(), vertices.y.end());
  spare_.z.assign(vertices.z.begin(), vertices.z.end());
  std::swap(spare_, deforming.vertices);
  try {
    follow_all(spare_);
  } catch (...) {
    std::swap(spare_, deforming.vertices);
    build_parts();
    throw;
  }
}

void DirectionTable::follow_all(const Points& before) {
  if (!cube()) return follow_on_paper_map();
  keep_rejection_parts(before);
  if (follow_rows(mesh(), *cube(), table_)) earlier_.forget_nearest(table_.entries);
  forms_measured_.make_out_of_date();
  measured_on_demand_ = 0;
  settle_drift(move_corners());
}

/// What the earlier rejection parts are good for, now that the furthest vertex is so far from where it was then.
void DirectionTable::settle_drift(double furthest_mm) {
  earlier_.drift =
      drift_of(furthest_mm, std::sqrt(double{earlier_.parts.radii.least_squared}), cube()->cells_per_side());
  if (!earlier_.drift) {
    measure_forms();
    require_centre_off_surface();
  }
  find_winding_at_centre();
}

void DirectionTable::follow_on_paper_map() {
  require_no_corner_at_centre();
  follow_vertices(mesh(), std::get<CartesianMap>(map_), cartesian_);
  require_centre_off_surface();
  find_winding_at_centre();
}

/// Those of the vertices as they were just before.
void DirectionTable::keep_rejection_parts(const Points& before) {
  RejectionParts* const current = rejection_.current();
  if (!current) return;
  std::swap(earlier_.parts, *current);
  earlier_.vertices = before;
  rejection_.make_out_of_date();
}

/// Some more vertices of a surface that has drifted have moved.
void DirectionTable::drift_on(std::span<const Index> moved, std::span<const Index> triangles) {
  if (follow_rows(mesh(), *cube(), moved, triangles, table_)) earlier_.forget_nearest(table_.entries);
  forms_measured_.make_out_of_date();
  double furthest = earlier_.drift->mm;
  for (const Index v : moved)
    furthest = std::max(furthest, (mesh().vertices[v] - earlier_.vertices[v]).norm());
  settle_drift(furthest);
}

/// How far vertices have moved since the earlier rejection parts were made. A point of a triangle moves no further than its
/// corners; a surface that keeps off the centre all the way winds as it did.
double DirectionTable::move_corners() {
  const Points& now = mesh().vertices;
  place_corners(mesh(), table_.forms);
  const auto& corner = table_.forms.corner;
  const Points& then = earlier_.vertices;
  if (then.size() == 0) return HUGE_VAL;
  double furthest_squared = 0;
  for (std::size_t i = 0; i < now.size(); ++i)
    furthest_squared = std::max(furthest_squared, (corner[i] - then[i]).squaredNorm());
  return std::sqrt(furthest_squared);
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
  if (!cube()) return follow_on_paper_map();
  if (triangles_at_.empty()) triangles_at_ = mesh::VertexTriangles(mesh());
  const std::vector<Index> triangles = triangles_at_.of(moved);
  if (earlier_.drift && !rejection_.is_current()) return drift_on(moved, triangles);
  earlier_.drift.reset();
  earlier_.vertices = {};
  RejectionParts* parts = rejection_.current();
  const ChangedRadii changed =
      follow_vertices(mesh(), *cube(), moved, triangles, table_, parts ? &parts->radii : nullptr);
  for (const Index t : triangles) require_centre_off_triangle(t);
  find_winding_at_centre();
  if (!parts) return;
  parts->scale = table_.forms.scale;
  if ((winding_at_centre_.value_or(0) > 0) != parts->radii.starts_at_centre) {
    rejection_.make_out_of_date();
  } else if (changed.may_be_all) {
    parts->pyramid.fill(cube()->cells_per_side(), parts->radii.of_cell);
  } else {
    parts->pyramid.refill(cube()->cells_per_side(), parts->radii.of_cell, changed.cells);
  }
}

}  // namespace condyle::radial
