#include <algorithm>
#include <array>
#include <numeric>

#include <hwy/cache_control.h>

#include "radial/build/cube_listing.hpp"
#include "radial/build/cube_lists.hpp"

namespace condyle::radial {
namespace {

/// How long before their turn triangles and their corners are fetched: they lie anywhere.
constexpr std::size_t triangles_ahead = 8;

PlacedVertices in_rooms(const CellLists& lists) {
  return {lists.face.data(), nullptr, lists.room.data()};
}

/// Corners of some triangles; what else is known of these and their corners is fetched.
std::vector<Triangle> corners_of(const TriMesh& mesh, const CellLists& lists,
                                 std::span<const Index> triangles) {
  std::vector<Triangle> corners(triangles.size());
  const auto ahead = [&](std::size_t i, std::size_t by) {
    return triangles[std::min(i + by, triangles.size() - 1)];
  };
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    hwy::Prefetch(&mesh.triangles[ahead(i, 2 * triangles_ahead)]);
    hwy::Prefetch(&lists.forms[triangles[i]]);
    for (const Index v : mesh.triangles[ahead(i, triangles_ahead)]) {
      hwy::Prefetch(&lists.corner[v]), hwy::Prefetch(&lists.room[v]), hwy::Prefetch(&lists.face[v]);
    }
    corners[i] = mesh.triangles[triangles[i]];
  }
  return corners;
}

/// What a vertex that moves on is given beyond where it was seen, in cells: more would make lists longer,
/// less would soon be left again.
constexpr float room_around = 1.0f / 16;
/// What moves further than this is not expected back where it was. With one cell, a ball of 130000 triangles
/// whose vertices go to and fro by 0.8 cells left rooms at each update, which took twice as long.
constexpr float widest_room = 1.5f;

struct FacePosition {
  float u, w;
};

/// Where a vertex is seen on a face, off it too.
FacePosition position_on(int face, const Vec3& v) {
  const int axis = face % 3;
  const double depth = face < 3 ? v[axis] : -v[axis];
  return {static_cast<float>(v[(axis + 1) % 3] / depth), static_cast<float>(v[(axis + 2) % 3] / depth)};
}

FaceRoom room_about(const FacePosition& at, float around) {
  return {at.u - around, at.w - around, at.u + around, at.w + around};
}

FaceRoom union_of(const FaceRoom& a, const FaceRoom& b) {
  return {std::min(a.low_u, b.low_u), std::min(a.low_w, b.low_w), std::max(a.high_u, b.high_u),
          std::max(a.high_w, b.high_w)};
}

/// Gives the vertex a room that holds the old one too, on its face, where that does not become too wide: a
/// vertex that goes to and fro over an edge of the cube stays on one face. Else one about it.
void give_room(const Vec3& v, int cells_per_side, std::uint8_t& face, FaceRoom& room) {
  const float cell = 2.0f / static_cast<float>(cells_per_side), around = room_around * cell;
  const int axis = face % 3;
  if ((face < 3 ? v[axis] : -v[axis]) > 0) {
    const FaceRoom both = union_of(room, room_about(position_on(face, v), around));
    if (std::max(both.high_u - both.low_u, both.high_w - both.low_w) <= widest_room * cell) {
      room = both;
      return;
    }
  }
  int largest = 0;
  v.cwiseAbs().maxCoeff(&largest);
  face = static_cast<std::uint8_t>(v[largest] < 0 ? largest + 3 : largest);
  room = room_about(position_on(face, v), around);
}

Points points_at(const TriMesh& mesh, std::span<const Index> vertices) {
  Points points;
  points.reserve(vertices.size());
  for (const Index v : vertices) points.push_back(mesh.vertices[v]);
  return points;
}

void give_rooms(const TriMesh& mesh, const CubeMap& map, std::span<const Index> vertices, CellLists& lists) {
  for (const Index v : vertices)
    give_room(mesh.vertices[v], map.cells_per_side(), lists.face[v], lists.room[v]);
}

/// Those of the triangles that have one of the vertices.
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

/// Takes triangles out of the rows that their vertices' rooms put them in; adds those cells to `touched`.
void unlist(const TriMesh& mesh, const CubeMap& map, std::span<const Index> triangles,
            std::span<const Triangle> corners, CellLists& lists, CellSet& touched) {
  CubeListing listing(mesh.vertices, corners, map, in_rooms(lists));
  listing.list();
  for (const ListedTriangle& entry : listing.entries()) {
    lists.remove_entry(entry.cell, triangles[entry.triangle]);
    touched.add(entry.cell);
  }
}

/// Puts triangles that are in no row into those of their vertices' rooms.
void list_some(const TriMesh& mesh, const CubeMap& map, std::span<const Index> triangles,
               std::span<const Triangle> corners, CellLists& lists) {
  CubeListing listing(mesh.vertices, corners, map, in_rooms(lists));
  listing.list();
  lists.has_clipped |= listing.has_clipped();
  for (const ListedTriangle& entry : listing.entries())
    lists.add_entry(entry.cell, triangles[entry.triangle], entry.octagon);
}

/// Lists anew the triangles at vertices that left their rooms.
void relist(const TriMesh& mesh, const CubeMap& map, std::span<const Index> strayed,
            std::span<const Index> triangles, CellLists& lists, CellSet& touched) {
  const std::vector<Triangle> corners = corners_of(mesh, lists, triangles);
  unlist(mesh, map, triangles, corners, lists, touched);
  give_rooms(mesh, map, strayed, lists);
  list_some(mesh, map, triangles, corners, lists);
}

std::vector<Index> strayed_among(const TriMesh& mesh, const CellLists& lists,
                                 std::span<const Index> vertices) {
  const Points at = points_at(mesh, vertices);
  std::vector<std::uint8_t> face(vertices.size());
  std::vector<FaceRoom> room(vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    face[i] = lists.face[vertices[i]], room[i] = lists.room[vertices[i]];
  }
  std::vector<Index> strayed(vertices.size());
  strayed.resize(find_strayed(view_of(at, {}), face.data(), room.data(), strayed.data()));
  for (Index& i : strayed) i = vertices[i];
  return strayed;
}

/// Which triangles of a listing are in each of its cells, see TouchedTriangles.
struct EntriesByCell {
  std::vector<std::uint32_t> first;
  core::UninitialisedVector<std::uint32_t> listed;

  EntriesByCell(const CubeListing& listing, std::span<const Index> cells, Index cell_count)
      : listed(listing.entries().size()) {
    core::UninitialisedVector<std::uint32_t> next(cell_count);
    first.reserve(cells.size() + 1);
    first.push_back(0);
    for (const Index cell : cells) {
      next[cell] = first.back();
      first.push_back(first.back() + listing.length(cell));
    }
    for (const ListedTriangle& entry : listing.entries()) listed[next[entry.cell]++] = entry.triangle;
  }
};

/// Forms of some triangles; their planes.
core::UninitialisedVector<TrianglePlane> measure_forms(std::span<const Index> triangles,
                                                       std::span<const Triangle> corners, CellLists& lists) {
  core::UninitialisedVector<TrianglePlane> planes(triangles.size());
  // In parts that stay in the nearest cache on their way to where they belong.
  constexpr std::size_t most = 64;
  std::array<ConeForms, most> forms;
  std::vector<std::uint32_t> unknown;
  for (std::size_t first = 0; first < triangles.size(); first += most) {
    const std::size_t count = std::min(most, triangles.size() - first);
    MeshView view = view_of({}, corners.subspan(first, count));
    view.xyz = lists.corner.data()->data();
    measure_triangles(view, 0, count, lists.scale, forms.data(), planes.data() + first, unknown);
    for (std::size_t i = 0; i < count; ++i) lists.forms[triangles[first + i]] = forms[i];
  }
  return planes;
}

/// Forms of some triangles, and the radii of the cells that they are listed in and of the `touched` ones.
ChangedRadii measure_some(const TriMesh& mesh, const CubeMap& map, std::span<const Index> triangles,
                          CellLists& lists, CellSet& touched) {
  const std::vector<Triangle> corners = corners_of(mesh, lists, triangles);
  CubeListing listing(mesh.vertices, corners, map, in_rooms(lists));
  listing.list();
  for (const ListedTriangle& entry : listing.entries()) touched.add(entry.cell);
  const EntriesByCell by_cell(listing, touched.cells(), map.cell_count());
  const core::UninitialisedVector<TrianglePlane> planes = measure_forms(triangles, corners, lists);
  return find_radii_in(map, {triangles, planes, touched.cells(), by_cell.first, by_cell.listed}, lists);
}

}  // namespace

void make_rooms(const TriMesh& mesh, CellLists& lists) {
  if (!lists.room.empty()) return;
  core::UninitialisedVector<FacePoint> place(mesh.vertices.size());
  lists.face.resize(mesh.vertices.size());
  lists.room.resize(mesh.vertices.size());
  place_vertices(view_of(mesh.vertices, mesh.triangles), lists.face.data(), place.data());
  for (std::size_t i = 0; i < place.size(); ++i) {
    const float u = place[i].u(), w = place[i].w();
    lists.room[i] = {u, w, u, w};
  }
}

void follow_vertices(const TriMesh& mesh, const CubeMap& map, CellLists& lists) {
  if (lists.has_clipped) return list_cells(mesh, map, lists);
  core::UninitialisedVector<Index> strayed(mesh.vertices.size());
  strayed.resize(find_strayed(view_of(mesh.vertices, mesh.triangles), lists.face.data(), lists.room.data(),
                              strayed.data()));
  // Listing one triangle among others that stay takes several times what it does when all are listed.
  const bool are_many = strayed.size() > mesh.vertices.size() / 16;
  if (are_many) {
    give_rooms(mesh, map, strayed, lists);
    list_all(mesh, map, in_rooms(lists), lists);
  } else if (!strayed.empty()) {
    std::vector<Index> all(mesh.triangles.size());
    std::iota(all.begin(), all.end(), Index{0});
    CellSet touched(map.cell_count());
    relist(mesh, map, strayed, triangles_at(mesh, strayed, all), lists, touched);
  }
  if (lists.has_clipped) return list_cells(mesh, map, lists);
  measure(mesh, lists);
}

ChangedRadii follow_vertices(const TriMesh& mesh, const CubeMap& map, std::span<const Index> moved,
                             std::span<const Index> triangles, CellLists& lists) {
  for (const Index v : moved) lists.corner[v] = mesh.vertices[v];
  CellSet touched(map.cell_count());
  if (!lists.has_clipped) {
    const std::vector<Index> strayed = strayed_among(mesh, lists, moved);
    if (!strayed.empty()) relist(mesh, map, strayed, triangles_at(mesh, strayed, triangles), lists, touched);
  }
  if (lists.has_clipped) {
    list_cells(mesh, map, lists);
    find_radii(map, lists);
    return {.may_be_all = true};
  }
  return measure_some(mesh, map, triangles, lists, touched);
}

}  // namespace condyle::radial
