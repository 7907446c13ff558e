#include "radial/direction_table.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "condyle/error.hpp"
#include "core/coordinate_range.hpp"
#include "core/parallel.hpp"
#include "mesh/edge_balance.hpp"
#include "radial/exact/ray_crossing.hpp"
#include "radial/exact/ray_scan.hpp"

namespace condyle::radial {
namespace {

/// Whether triangles, seen from the centre, are longer than four cells of the finest map, on average of some.
bool are_slender(const TriMesh& mesh) {
  constexpr std::size_t step = 64;
  constexpr double longest = 4 * 2.0 / 128;
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += step) {
    const Vec3 a = mesh.corner(t, 0).stableNormalized(), b = mesh.corner(t, 1).stableNormalized(),
               c = mesh.corner(t, 2).stableNormalized();
    sum += std::max({(a - b).norm(), (b - c).norm(), (c - a).norm()});
  }
  return sum * static_cast<double>(step) > longest * static_cast<double>(mesh.triangles.size());
}

/// Cells along a side for a mesh.
int cells_per_side(const RadialOptions& options, const TriMesh& mesh) {
  // 2048^2 cells a face is 25 million cells: past that the table outgrows any mesh it could serve.
  if (options.cells_per_side && (*options.cells_per_side < 1 || *options.cells_per_side > 2048)) {
    throw UsageError("cells_per_side is " + std::to_string(*options.cells_per_side) +
                     ", not within 1 to 2048");
  }
  if (options.cells_per_side) return *options.cells_per_side;
  if (options.map == DirectionMapKind::cartesian) return 64;
  // A few triangles to a cell: with finer ones each has more entries, which costs time to build and
  // memory, and a query gains little. Sides that can be halved have deep pyramids.
  const std::size_t triangles = mesh.triangles.size();
  if (triangles < 6000) return triangles < 3000 ? 16 : 24;
  if (triangles < 12000) return 32;
  if (triangles < 60000) return 48;
  // With 700,000 meridian triangles 64 cells have 12 entries each, 128 have 25.
  return triangles < 600000 || are_slender(mesh) ? 64 : 128;
}

DirectionMap make_map(const RadialOptions& options, const TriMesh& mesh) {
  const int side = cells_per_side(options, mesh);
  if (options.map == DirectionMapKind::cartesian) return CartesianMap(side);
  return CubeMap(side);
}

void refuse_centre_on(std::size_t triangle) {
  throw MeshError("the joint centre lies on the surface, in triangle " + std::to_string(triangle));
}

}  // namespace

// ---- Build

/// Before a table is made: triangles round a centre that is a vertex have directions without end.
void DirectionTable::require_no_corner_at_centre() const {
  for (std::size_t t = 0; t < mesh().triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      if (mesh().corner(t, k) == Vec3::Zero()) refuse_centre_on(t);
}

DirectionTable::DirectionTable(Mesh mesh, const RadialOptions& options)
    : given_(std::move(mesh)), map_(make_map(options, given_.arrays())) {
  build_parts();
}

DirectionTable::DirectionTable(const DirectionTable& other)
    : given_(other.given_),
      deformed_(other.deformed_ ? std::make_unique<TriMesh>(*other.deformed_) : nullptr),
      map_(other.map_),
      table_(other.table_),
      cartesian_(other.cartesian_),
      forms_measured_(other.forms_measured_),
      winding_at_centre_(other.winding_at_centre_),
      triangles_at_(other.triangles_at_),
      rejection_(other.rejection_),
      earlier_(other.earlier_) {}

void DirectionTable::build_parts() {
  require_no_corner_at_centre();
  if (cube()) {
    build(mesh(), *cube(), table_);
  } else {
    build(mesh(), std::get<CartesianMap>(map_), cartesian_);
  }
  forms_measured_.get([](std::monostate&) {});
  require_centre_off_surface();
  find_winding_at_centre();
  rejection_.make_out_of_date();
  earlier_ = {};
}

/// Far out the winding number is zero; every boundary crossed on the way in adds its sense.
void DirectionTable::find_winding_at_centre() {
  if (!is_closed()) return;
  const Vec3 any_direction(0, 0, 1);
  const Index cell = std::visit([&](const auto& map) { return map.cell_of(any_direction); }, map_);
  int winding = 0;
  for (const Index t : entries().of(cell)) {
    const Cone cone = cone_of(mesh(), t);
    winding += static_cast<int>(ray_crossing(any_direction, cone.a, cone.b, cone.c).outwards);
  }
  winding_at_centre_ = winding;
}

/// Edge functions that are numbers have a plane that is certainly off the centre. Of a vertex too near single precision knows no
/// direction.
void DirectionTable::require_centre_off_surface() const {
  const Points& vertices = mesh().vertices;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const double reach =
        std::max({std::abs(vertices.x[v]), std::abs(vertices.y[v]), std::abs(vertices.z[v])});
    if (reach < core::least_distance && reach > 0)
      throw MeshError("the joint centre is nearer than 1e-36 mm to vertex " + std::to_string(v));
  }
  if (cube()) {
    for (const Index t : table_.forms.uncertain) require_centre_off_triangle(t);
  } else {
    for (Index t = 0; t < mesh().triangles.size(); ++t) require_centre_off_triangle(t);
  }
}

void DirectionTable::require_centre_off_triangle(Index t) const {
  const auto& functions = table_.forms.edge_functions;
  if (!functions.empty() && !std::isnan(functions[t].x[3])) return;
  const Cone cone = cone_of(mesh(), t);
  if (core::orientation(cone.a, cone.b, cone.c) == core::Sign::zero &&
      mesh::contains_coplanar({cone.a, cone.b, cone.c}, Vec3::Zero()))
    refuse_centre_on(t);
}

// ---- Query

void DirectionTable::require_closed() const {
  if (const auto& edge = given_.unbalanced_edge()) mesh::refuse_unbalanced(*edge);
}

void DirectionTable::query(PointsView points, RadialResults& out) const {
  require_closed();
  radial::query(measured_view(), points, out);
}

std::vector<double> DirectionTable::radial_gaps(PointsView points) const {
  require_closed();
  return radial::radial_gaps(measured_view(), points);
}

void DirectionTable::penetrations(const PointBlocks& points, const Pose& X_FM, Penetrations& out,
                                  PenetrationWork* work) const {
  require_closed();
  auto scratch = scratch_.take();
  radial::penetrations(exact_view(), cube_view(), points, X_FM, *scratch, out, work);
  measured_on_demand_.fetch_add(scratch->crossing.forms.take_count(), std::memory_order_relaxed);
  scratch_.put_back(std::move(scratch));
}

void DirectionTable::penetrations(const PointBlocks& points, std::span<const Pose> X_FM,
                                  std::span<Penetrations> out) const {
  assert(out.size() == X_FM.size());
  require_closed();
  const ExactView exact = exact_view();
  const std::optional<CubeView> cube = cube_view();
  // A pose may take no more than a microsecond: some together are worth a task.
  constexpr std::size_t poses_per_task = 8;
  core::parallel_chunks(X_FM.size(), poses_per_task, [&](std::size_t first, std::size_t last) {
    auto scratch = scratch_.take();
    for (std::size_t i = first; i < last; ++i)
      radial::penetrations(exact, cube, points, X_FM[i], *scratch, out[i], nullptr);
    measured_on_demand_.fetch_add(scratch->crossing.forms.take_count(), std::memory_order_relaxed);
    scratch_.put_back(std::move(scratch));
  });
}

void DirectionTable::add_ray_to_normal(PointsView points, const Pose& X_FM, Penetrations& out) const {
  out.ray_to_normal.resize(out.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Index t = out.triangle[i];
    out.ray_to_normal[i] =
        t == no_index ? Angle() : angle_to_normal(posed(X_FM, points[out.point[i]]), cone_of(mesh(), t));
  }
}

void DirectionTable::prepare_penetrations() const {
  if (cube() && !reads_earlier_parts()) rejection_parts();
}

const RejectionParts& DirectionTable::rejection_parts() const {
  return rejection_.get([this](RejectionParts& parts) { find_rejection_parts(parts); });
}

void DirectionTable::find_rejection_parts(RejectionParts& parts) const {
  measure_forms();
  parts.scale = table_.forms.scale;
  // Points nearer to the centre than the surface are inside and to be found where the centre is.
  parts.radii.starts_at_centre = winding_at_centre_.value_or(0) > 0;
  find_radii(*cube(), table_, parts.radii);
  parts.pyramid.fill(cube()->cells_per_side(), parts.radii.of_cell);
}

void DirectionTable::measure_forms() const {
  forms_measured_.get([this](std::monostate&) { measure(mesh(), table_.forms); });
}

ExactView DirectionTable::measured_view() const {
  ExactView view = exact_view();
  if (!cube()) return view;
  measure_forms();
  view.edge_functions = table_.forms.edge_functions.data();
  return view;
}

/// Once as many forms were measured as there are, all and the radii that follow from them are worth it.
bool DirectionTable::reads_earlier_parts() const noexcept {
  return earlier_.drift && !rejection_.is_current() &&
         measured_on_demand_.load(std::memory_order_relaxed) < mesh().triangles.size();
}

CubeView DirectionTable::drifted_view(const Drift& drift) const {
  const auto& [radii, pyramid, scale] = earlier_.parts;
  const float nearest = std::sqrt(radii.least_squared) * (1 - 0x1p-20f) - drift.mm,
              furthest = std::sqrt(radii.greatest_squared) * (1 + 0x1p-20f) + drift.mm;
  MeshView corners = view_of(mesh().vertices, mesh().triangles);
  corners.xyz = table_.forms.corner.data()->data();
  return {.cells_per_side = cube()->cells_per_side(),
          .levels = DirectionPyramid::level_count(cube()->cells_per_side()),
          .radii = radii.of_cell.data(),
          .pyramid = pyramid.data(),
          .entries = table_.entries.view(),
          .nearest = radii.nearest.data(),
          .edge_functions = nullptr,
          .mesh = corners,
          .drift = drift,
          .scale = scale,
          .winding_at_centre = winding_at_centre_.value_or(0),
          .nearest_squared = nearest * nearest,
          .furthest_squared = furthest * furthest};
}

std::optional<CubeView> DirectionTable::cube_view() const {
  if (!cube()) return {};
  if (reads_earlier_parts()) return drifted_view(*earlier_.drift);
  const auto& [radii, pyramid, scale] = rejection_parts();
  return CubeView{.cells_per_side = cube()->cells_per_side(),
                  .levels = DirectionPyramid::level_count(cube()->cells_per_side()),
                  .radii = radii.of_cell.data(),
                  .pyramid = pyramid.data(),
                  .entries = table_.entries.view(),
                  .nearest = radii.nearest.data(),
                  .edge_functions = table_.forms.edge_functions.data(),
                  .mesh = {},
                  .drift = {},
                  .scale = scale,
                  .winding_at_centre = winding_at_centre_.value_or(0),
                  .nearest_squared = radii.least_squared,
                  .furthest_squared = radii.greatest_squared};
}

RadialTableSize DirectionTable::table_size() const noexcept {
  Index longest = 0;
  for (const CellRow& row : entries().row) longest = std::max(longest, row.last - row.first);
  return {.cells = entries().row.size(),
          .entries = entries().count(),
          .bytes = entries().bytes() + cartesian_.box.size() * sizeof(CartesianBox) + table_.forms.bytes() +
                   table_.slack.bytes() + rejection_.last().bytes() + earlier_.parts.bytes() +
                   (earlier_.vertices.size() + spare_.size()) * sizeof(Vec3) + triangles_at_.bytes(),
          .longest_list = longest};
}

}  // namespace condyle::radial
