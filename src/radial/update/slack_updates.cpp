#include "radial/update/slack_updates.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "radial/build/cube_binning.hpp"
#include "radial/build/rows.hpp"

namespace condyle::radial {
namespace {

/// How long before their turn triangles and their corners are fetched: they lie anywhere.
constexpr std::size_t triangles_ahead = 8;

PlacedVertices in_slack(const CubeTable& table) {
  return {table.slack.face.data(), nullptr, table.slack.rectangle.data()};
}

/// Corners of some triangles; what else is known of these and their corners is fetched.
std::vector<Triangle> corners_of(const TriMesh& mesh, const CubeTable& table,
                                 std::span<const Index> triangles) {
  std::vector<Triangle> corners(triangles.size());
  const auto ahead = [&](std::size_t i, std::size_t by) {
    return triangles[std::min(i + by, triangles.size() - 1)];
  };
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    __builtin_prefetch(&mesh.triangles[ahead(i, 2 * triangles_ahead)]);
    __builtin_prefetch(&table.forms.edge_functions[triangles[i]]);
    for (const Index v : mesh.triangles[ahead(i, triangles_ahead)]) {
      __builtin_prefetch(&table.forms.corner[v]), __builtin_prefetch(&table.slack.rectangle[v]),
          __builtin_prefetch(&table.slack.face[v]);
    }
    corners[i] = mesh.triangles[triangles[i]];
  }
  return corners;
}

/// Slack of a vertex that moves on, beyond its projection, in cells: more would make rows longer, less would soon be
/// left again.
constexpr float slack_around = 1.0f / 16;
/// A vertex that moves further than this is not expected back at its old position. With one cell, a ball of 130000
/// triangles whose vertices go to and fro by 0.8 cells left their slack at each update, which took twice as long.
constexpr float widest_slack = 1.5f;

struct FacePosition {
  float u, w;
};

/// Where a vertex is projected on a face, off it too.
FacePosition position_on(int face, const Vec3& v) {
  const int axis = face % 3;
  const double depth = face < 3 ? v[axis] : -v[axis];
  return {static_cast<float>(v[(axis + 1) % 3] / depth), static_cast<float>(v[(axis + 2) % 3] / depth)};
}

SlackRectangle rectangle_about(const FacePosition& at, float around) {
  return {at.u - around, at.w - around, at.u + around, at.w + around};
}

SlackRectangle hull_of(const SlackRectangle& a, const SlackRectangle& b) {
  return {std::min(a.low_u, b.low_u), std::min(a.low_w, b.low_w), std::max(a.high_u, b.high_u),
          std::max(a.high_w, b.high_w)};
}

/// Grows the vertex's slack rectangle, which holds the old one too, on its face, where that does not become too wide: a
/// vertex that goes to and fro over an edge of the cube stays on one face. Else one about it.
void grow_slack(const Vec3& v, int cells_per_side, std::uint8_t& face, SlackRectangle& slack) {
  const float cell = 2.0f / static_cast<float>(cells_per_side), around = slack_around * cell;
  const int axis = face % 3;
  if ((face < 3 ? v[axis] : -v[axis]) > 0) {
    const SlackRectangle both = hull_of(slack, rectangle_about(position_on(face, v), around));
    if (std::max(both.high_u - both.low_u, both.high_w - both.low_w) <= widest_slack * cell) {
      slack = both;
      return;
    }
  }
  int largest = 0;
  v.cwiseAbs().maxCoeff(&largest);
  face = static_cast<std::uint8_t>(v[largest] < 0 ? largest + 3 : largest);
  slack = rectangle_about(position_on(face, v), around);
}

Points points_at(const TriMesh& mesh, std::span<const Index> vertices) {
  Points points;
  points.reserve(vertices.size());
  for (const Index v : vertices) points.push_back(mesh.vertices[v]);
  return points;
}

void grow_slack(const TriMesh& mesh, const CubeMap& map, std::span<const Index> vertices, CubeTable& table) {
  for (const Index v : vertices)
    grow_slack(mesh.vertices[v], map.cells_per_side(), table.slack.face[v], table.slack.rectangle[v]);
}

/// The triangles that have one of the vertices.
std::vector<Index> triangles_at(const TriMesh& mesh, std::span<const Index> vertices,
                                std::span<const Index> among) {
  std::vector<unsigned char> is_asked(mesh.vertices.size());
  for (const Index v : vertices) is_asked[v] = 1;
  std::vector<Index> triangles;
  for (const Index t : among) {
    const auto& [a, b, c] = mesh.triangles[t];
    if ((is_asked[a] | is_asked[b] | is_asked[c]) != 0) triangles.push_back(t);
  }
  return triangles;
}

/// Cells, each once.
class CellSet {
 public:
  explicit CellSet(Index cells) : is_in_(cells / bits + 1) {}
  void add(Index cell) {
    const std::uint64_t bit = std::uint64_t{1} << cell % bits;
    if ((is_in_[cell / bits] & bit) == 0) cells_.push_back(cell);
    is_in_[cell / bits] |= bit;
  }
  std::span<const Index> cells() const noexcept { return cells_; }

 private:
  static constexpr Index bits = 64;

  std::vector<std::uint64_t> is_in_;
  std::vector<Index> cells_;
};

/// Takes triangles out of the rows that their vertices' slack put them in; adds those cells to `touched`.
void remove(const TriMesh& mesh, const CubeMap& map, std::span<const Index> triangles,
            std::span<const Triangle> corners, const CubeTable& table, Rows& rows, CellSet& touched) {
  CubeBinning binning(mesh.vertices, corners, map, in_slack(table));
  binning.bin();
  binning.for_each_entry([&](const CellEntry& entry) {
    rows.remove(entry.cell, triangles[entry.triangle]);
    touched.add(entry.cell);
  });
}

/// Puts triangles that are in no row into those of their vertices' slack.
void reinsert(const TriMesh& mesh, const CubeMap& map, std::span<const Index> triangles,
              std::span<const Triangle> corners, CubeTable& table, Rows& rows) {
  CubeBinning binning(mesh.vertices, corners, map, in_slack(table));
  binning.bin();
  table.has_clipped |= binning.has_clipped();
  binning.for_each_entry(
      [&](const CellEntry& entry) { rows.add(entry.cell, triangles[entry.triangle], entry.dop); });
}

/// Bins the triangles at vertices that left their slack again.
void bin_again(const TriMesh& mesh, const CubeMap& map, std::span<const Index> left_slack,
               std::span<const Index> triangles, CubeTable& table, CellRadii* radii, CellSet& touched) {
  const std::vector<Triangle> corners = corners_of(mesh, table, triangles);
  Rows rows(table.entries, radii);
  remove(mesh, map, triangles, corners, table, rows, touched);
  grow_slack(mesh, map, left_slack, table);
  reinsert(mesh, map, triangles, corners, table, rows);
}

std::vector<Index> left_slack_among(const TriMesh& mesh, const CubeTable& table,
                                    std::span<const Index> vertices) {
  const Points at = points_at(mesh, vertices);
  std::vector<std::uint8_t> face(vertices.size());
  std::vector<SlackRectangle> slack(vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    face[i] = table.slack.face[vertices[i]], slack[i] = table.slack.rectangle[vertices[i]];
  }
  std::vector<Index> left_slack(vertices.size());
  left_slack.resize(find_left_slack(view_of(at, {}), face.data(), slack.data(), left_slack.data()));
  for (Index& i : left_slack) i = vertices[i];
  return left_slack;
}

/// See the header; adds cells that change to `touched`.
bool follow_rows(const TriMesh& mesh, const CubeMap& map, std::span<const Index> moved,
                 std::span<const Index> triangles, CubeTable& table, CellRadii* radii, CellSet& touched) {
  for (const Index v : moved) table.forms.corner[v] = mesh.vertices[v];
  bool has_changed = table.has_clipped;
  if (!table.has_clipped) {
    const std::vector<Index> left_slack = left_slack_among(mesh, table, moved);
    has_changed = !left_slack.empty();
    if (has_changed) {
      bin_again(mesh, map, left_slack, triangles_at(mesh, left_slack, triangles), table, radii, touched);
    }
  }
  if (table.has_clipped) build_rows(mesh, map, table);
  return has_changed;
}

/// Which triangles of a binning are in each of its cells, see ChangedTriangles.
struct EntriesByCell {
  std::vector<std::uint32_t> first;
  core::UninitialisedVector<std::uint32_t> place;

  EntriesByCell(const CubeBinning& binning, std::span<const Index> cells, Index cell_count) {
    core::UninitialisedVector<std::uint32_t> next(cell_count);
    first.reserve(cells.size() + 1);
    first.push_back(0);
    for (const Index cell : cells) {
      next[cell] = first.back();
      first.push_back(first.back() + binning.length(cell));
    }
    place.resize(first.back());
    binning.for_each_entry([&](const CellEntry& entry) { place[next[entry.cell]++] = entry.triangle; });
  }
};

/// Forms of some triangles; their planes.
core::UninitialisedVector<TrianglePlane> measure_forms(std::span<const Index> triangles,
                                                       std::span<const Triangle> corners, CubeTable& table) {
  core::UninitialisedVector<TrianglePlane> planes(triangles.size());
  // In parts that stay in the nearest cache on their way to where they belong.
  constexpr std::size_t most = 64;
  std::array<EdgeFunctions, most> forms;
  std::vector<std::uint32_t> uncertain;
  for (std::size_t first = 0; first < triangles.size(); first += most) {
    const std::size_t count = std::min(most, triangles.size() - first);
    MeshView view = view_of({}, corners.subspan(first, count));
    view.xyz = table.forms.corner.data()->data();
    measure_triangles(view, 0, count, table.forms.scale, forms.data(), uncertain);
    for (std::size_t i = 0; i < count; ++i) {
      table.forms.edge_functions[triangles[first + i]] = forms[i];
      planes[first + i] = plane_of(forms[i]);
    }
  }
  return planes;
}

/// Radii of the cells that some triangles with these planes are in, and of the `touched` ones.
ChangedRadii measure_radii(const TriMesh& mesh, const CubeMap& map, std::span<const Index> triangles,
                           std::span<const Triangle> corners, std::span<const TrianglePlane> planes,
                           const CubeTable& table, CellRadii& radii, CellSet& touched) {
  CubeBinning binning(mesh.vertices, corners, map, in_slack(table));
  binning.bin();
  binning.for_each_entry([&](const CellEntry& entry) { touched.add(entry.cell); });
  const EntriesByCell by_cell(binning, touched.cells(), map.cell_count());
  return find_radii_in(map, table, {triangles, planes, touched.cells(), by_cell.first, by_cell.place}, radii);
}

}  // namespace

void init_slack(const TriMesh& mesh, CubeTable& table) {
  if (!table.slack.empty()) return;
  core::UninitialisedVector<FacePoint> place(mesh.vertices.size());
  table.slack.face.resize(mesh.vertices.size());
  table.slack.rectangle.resize(mesh.vertices.size());
  place_vertices(view_of(mesh.vertices, mesh.triangles), table.slack.face.data(), place.data());
  for (std::size_t i = 0; i < place.size(); ++i) {
    const float u = place[i].u(), w = place[i].w();
    table.slack.rectangle[i] = {u, w, u, w};
  }
}

bool follow_rows(const TriMesh& mesh, const CubeMap& map, CubeTable& table) {
  if (table.has_clipped) {
    build_rows(mesh, map, table);
    return true;
  }
  core::UninitialisedVector<Index> left_slack(mesh.vertices.size());
  left_slack.resize(find_left_slack(view_of(mesh.vertices, mesh.triangles), table.slack.face.data(),
                                    table.slack.rectangle.data(), left_slack.data()));
  // Reinserting one triangle among others that stay takes several times what it does when all are binned.
  const bool are_many = left_slack.size() > mesh.vertices.size() / 16;
  if (are_many) {
    grow_slack(mesh, map, left_slack, table);
    bin_all(mesh, map, in_slack(table), table);
  } else if (!left_slack.empty()) {
    std::vector<Index> all(mesh.triangles.size());
    std::iota(all.begin(), all.end(), Index{0});
    CellSet touched(map.cell_count());
    bin_again(mesh, map, left_slack, triangles_at(mesh, left_slack, all), table, nullptr, touched);
  }
  if (table.has_clipped) build_rows(mesh, map, table);
  return !left_slack.empty();
}

bool follow_rows(const TriMesh& mesh, const CubeMap& map, std::span<const Index> moved,
                 std::span<const Index> triangles, CubeTable& table) {
  CellSet touched(map.cell_count());
  return follow_rows(mesh, map, moved, triangles, table, nullptr, touched);
}

ChangedRadii follow_vertices(const TriMesh& mesh, const CubeMap& map, std::span<const Index> moved,
                             std::span<const Index> triangles, CubeTable& table, CellRadii* radii) {
  CellSet touched(map.cell_count());
  follow_rows(mesh, map, moved, triangles, table, radii, touched);
  const bool are_made_anew = table.slack.empty();
  if (are_made_anew) {
    measure(mesh, table.forms);
    if (radii != nullptr) find_radii(map, table, *radii);
    return {.may_be_all = true};
  }
  const std::vector<Triangle> corners = corners_of(mesh, table, triangles);
  const core::UninitialisedVector<TrianglePlane> planes = measure_forms(triangles, corners, table);
  if (radii == nullptr) return {};
  return measure_radii(mesh, map, triangles, corners, planes, table, *radii, touched);
}

}  // namespace condyle::radial
