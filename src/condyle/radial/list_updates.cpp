#include <algorithm>
#include <numeric>

#include <hwy/cache_control.h>

#include "condyle/radial/cube_listing.hpp"
#include "condyle/radial/cube_lists.hpp"

namespace condyle {
namespace {

/// How long before their turn triangles and their corners are fetched: they lie anywhere.
constexpr std::size_t triangles_ahead = 8;

/// Vertices of some triangles of their own, with their rooms: for listing these alone.
class PartsInRooms {
 public:
  PartsInRooms(const TriMesh& mesh, const CellLists& lists, std::span<const Index> triangles) {
    const std::size_t corners = 3 * triangles.size();
    parts_.vertices.reserve(corners);
    parts_.triangles.reserve(triangles.size());
    face_.reserve(corners), low_.reserve(corners), high_.reserve(corners);
    const auto ahead = [&](std::size_t i, std::size_t by) {
      return triangles[std::min(i + by, triangles.size() - 1)];
    };
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      hwy::Prefetch(&mesh.triangles[ahead(i, 2 * triangles_ahead)]);
      for (const Index v : mesh.triangles[ahead(i, triangles_ahead)]) {
        hwy::Prefetch(&lists.corner[v]), hwy::Prefetch(&lists.room[v]), hwy::Prefetch(&lists.face[v]);
      }
      const auto first = static_cast<Index>(low_.size());
      parts_.triangles.push_back({first, first + 1, first + 2});
      for (const Index v : mesh.triangles[triangles[i]]) {
        parts_.vertices.push_back(lists.corner[v]);
        face_.push_back(lists.face[v]);
        const FaceRoom& room = lists.room[v];
        low_.push_back(lowest_in(room)), high_.push_back(highest_in(room));
      }
    }
  }

  const TriMesh& mesh() const noexcept { return parts_; }
  PlacedVertices placed() const noexcept { return {face_.data(), low_.data(), high_.data()}; }

  static FacePoint lowest_in(const FaceRoom& r) noexcept {
    return {{r.low_u, r.low_w, r.low_u + r.low_w, r.low_u - r.high_w}};
  }
  static FacePoint highest_in(const FaceRoom& r) noexcept {
    return {{r.high_u, r.high_w, r.high_u + r.high_w, r.high_u - r.low_w}};
  }

 private:
  TriMesh parts_;
  std::vector<std::uint8_t> face_;
  std::vector<FacePoint> low_, high_;
};

/// All triangles, with the rooms of their vertices.
void list_all_in_rooms(const TriMesh& mesh, const CubeMap& map, CellLists& lists) {
  UninitialisedVector<FacePoint> low(lists.room.size()), high(lists.room.size());
  for (std::size_t i = 0; i < lists.room.size(); ++i) {
    low[i] = PartsInRooms::lowest_in(lists.room[i]), high[i] = PartsInRooms::highest_in(lists.room[i]);
  }
  list_all(mesh, map, {lists.face.data(), low.data(), high.data()}, lists);
}

/// What a vertex that moves on is given beyond where it was seen, in cells: more would make lists longer,
/// less would soon be left again.
constexpr float room_around = 1.0f / 16;
/// What moves further than this between two looks is not expected back where it was.
constexpr float widest_room = 1.0f;

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

MeshView view_of(const Points& points) {
  return {points.x.data(), points.y.data(), points.z.data(), nullptr, points.size(), nullptr, 0};
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
  explicit CellSet(Index cells) : is_in_(cells) {}
  void add(Index cell) {
    if (is_in_[cell] == 0) cells_.push_back(cell);
    is_in_[cell] = 1;
  }
  std::span<const Index> cells() const noexcept { return cells_; }

 private:
  std::vector<unsigned char> is_in_;
  std::vector<Index> cells_;
};

/// Takes triangles out of the rows that their vertices' rooms put them in; adds those cells to `touched`.
void unlist(const TriMesh& mesh, const CubeMap& map, std::span<const Index> triangles, CellLists& lists,
            CellSet& touched) {
  const PartsInRooms parts(mesh, lists, triangles);
  CubeListing listing(parts.mesh(), map, parts.placed());
  listing.list();
  for (const ListedTriangle& entry : listing.entries()) {
    lists.remove_entry(entry.cell, triangles[entry.triangle]);
    touched.add(entry.cell);
  }
}

/// Puts triangles that are in no row into those of their vertices' rooms.
void list_some(const TriMesh& mesh, const CubeMap& map, std::span<const Index> triangles, CellLists& lists) {
  const PartsInRooms parts(mesh, lists, triangles);
  CubeListing listing(parts.mesh(), map, parts.placed());
  listing.list();
  lists.has_clipped |= listing.has_clipped();
  for (const ListedTriangle& entry : listing.entries())
    lists.add_entry(entry.cell, triangles[entry.triangle], entry.octagon);
}

/// Lists anew the triangles at vertices that left their rooms.
void relist(const TriMesh& mesh, const CubeMap& map, std::span<const Index> strayed,
            std::span<const Index> triangles, CellLists& lists, CellSet& touched) {
  unlist(mesh, map, triangles, lists, touched);
  give_rooms(mesh, map, strayed, lists);
  list_some(mesh, map, triangles, lists);
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
  strayed.resize(find_strayed(view_of(at), face.data(), room.data(), strayed.data()));
  for (Index& i : strayed) i = vertices[i];
  return strayed;
}

/// Which triangles of a listing are in each of its cells, see TouchedTriangles.
struct EntriesByCell {
  std::vector<std::uint32_t> first;
  UninitialisedVector<std::uint32_t> listed;

  EntriesByCell(const CubeListing& listing, std::span<const Index> cells, Index cell_count)
      : listed(listing.entries().size()) {
    UninitialisedVector<std::uint32_t> next(cell_count);
    first.reserve(cells.size() + 1);
    first.push_back(0);
    for (const Index cell : cells) {
      next[cell] = first.back();
      first.push_back(first.back() + listing.length(cell));
    }
    for (const ListedTriangle& entry : listing.entries()) listed[next[entry.cell]++] = entry.triangle;
  }
};

/// Forms of some triangles, and the radii of the cells that they are listed in and of the `touched` ones.
/// Whether any of these are others than before.
bool measure_some(const TriMesh& mesh, const CubeMap& map, std::span<const Index> triangles, CellLists& lists,
                  CellSet& touched) {
  // Far apart, and needed only when all are measured.
  for (const Index t : triangles) hwy::Prefetch(&lists.forms[t]);
  const PartsInRooms parts(mesh, lists, triangles);
  CubeListing listing(parts.mesh(), map, parts.placed());
  listing.list();
  for (const ListedTriangle& entry : listing.entries()) touched.add(entry.cell);
  const EntriesByCell by_cell(listing, touched.cells(), map.cell_count());
  std::vector<Triangle> corners(triangles.size());
  for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = mesh.triangles[triangles[i]];
  UninitialisedVector<ConeForms> forms(triangles.size());
  UninitialisedVector<TrianglePlane> planes(triangles.size());
  const MeshView view{nullptr,
                      nullptr,
                      nullptr,
                      lists.corner.data()->data(),
                      lists.corner.size(),
                      corners.empty() ? nullptr : corners[0].data(),
                      corners.size()};
  std::vector<std::uint32_t> unknown;
  measure_triangles(view, 0, triangles.size(), lists.scale, forms.data(), planes.data(), unknown);
  for (std::size_t i = 0; i < triangles.size(); ++i) lists.forms[triangles[i]] = forms[i];
  return find_radii_in(map, {triangles, planes, touched.cells(), by_cell.first, by_cell.listed}, lists);
}

}  // namespace

void make_rooms(const TriMesh& mesh, CellLists& lists) {
  if (!lists.room.empty()) return;
  UninitialisedVector<FacePoint> place(mesh.vertices.size());
  lists.face.resize(mesh.vertices.size());
  lists.room.resize(mesh.vertices.size());
  place_vertices(view_of(mesh), lists.face.data(), place.data());
  for (std::size_t i = 0; i < place.size(); ++i) {
    const float u = place[i].u(), w = place[i].w();
    lists.room[i] = {u, w, u, w};
  }
}

void follow_vertices(const TriMesh& mesh, const CubeMap& map, CellLists& lists) {
  if (lists.has_clipped) return list_cells(mesh, map, lists);
  UninitialisedVector<Index> strayed(mesh.vertices.size());
  strayed.resize(find_strayed(view_of(mesh), lists.face.data(), lists.room.data(), strayed.data()));
  // Listing one triangle among others that stay takes several times what it does when all are listed.
  const bool are_many = strayed.size() > mesh.vertices.size() / 16;
  if (are_many) {
    give_rooms(mesh, map, strayed, lists);
    list_all_in_rooms(mesh, map, lists);
  } else if (!strayed.empty()) {
    std::vector<Index> all(mesh.triangles.size());
    std::iota(all.begin(), all.end(), Index{0});
    CellSet touched(map.cell_count());
    relist(mesh, map, strayed, triangles_at(mesh, strayed, all), lists, touched);
  }
  if (lists.has_clipped) return list_cells(mesh, map, lists);
  measure(mesh, lists);
}

bool follow_vertices(const TriMesh& mesh, const CubeMap& map, std::span<const Index> moved,
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
    return true;
  }
  return measure_some(mesh, map, triangles, lists, touched);
}

}  // namespace condyle
