#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "condyle/core/error.hpp"
#include "condyle/core/predicates.hpp"
#include "condyle/mesh/triangle_intersection.hpp"
#include "condyle/radial/cell_lists.hpp"
#include "condyle/radial/cube_passes.hpp"

namespace condyle {
namespace {

/// Triangles measured and listed together: their radii stay in the nearest cache.
constexpr std::size_t triangles_per_chunk = 1024;

/// See Listing.
constexpr std::size_t spare_cells = 4;

constexpr float infinity = std::numeric_limits<float>::infinity();

constexpr CellOctagon whole_cell{range_word(0, 255, 0, 255), range_word(0, 255, 0, 255)};

/// One over the length of the direction to each corner of a face's cells, (n + 1)^2 of them.
std::vector<float> inverse_lengths(int n) {
  std::vector<float> lengths;
  for (int row = 0; row <= n; ++row) {
    for (int column = 0; column <= n; ++column) {
      const double u = 2.0 * column / n - 1, w = 2.0 * row / n - 1;
      lengths.push_back(static_cast<float>(1 / std::sqrt(1 + u * u + w * w)));
    }
  }
  return lengths;
}

struct FacePosition {
  float u, w;
};

class CubeListing {
 public:
  CubeListing(const TriMesh& mesh, const CubeMap& map, const std::vector<float>& inverse_length)
      : mesh_(mesh),
        map_(map),
        n_(map.cells_per_side()),
        view_{mesh.vertices.x.data(), mesh.vertices.y.data(),
              mesh.vertices.z.data(), nullptr,
              mesh.vertices.size(),   mesh.triangles.empty() ? nullptr : mesh.triangles[0].data(),
              mesh.triangles.size()},
        inverse_length_(inverse_length),
        length_(map.cell_count() + spare_cells, 0),
        least_(map.cell_count() + spare_cells, infinity),
        greatest_(map.cell_count() + spare_cells, 0.0f) {
    // The cosine of the angle between a cell's middle and its corners, widened: half a diagonal of the face's
    // coordinates at most, and cos x >= 1 - x^2 / 2.
    const double half_diagonal = std::sqrt(2.0) / n_ + 2 * list_margin;
    cosine_ = static_cast<float>(std::max(0.0, 1 - half_diagonal * half_diagonal / 2));
  }

  /// Entries of all triangles; their forms and the vertices' places go to the lists' arrays.
  void list(UninitialisedVector<ConeForms>& forms, UninitialisedVector<Vec3>& corners) {
    const std::size_t triangles = mesh_.triangles.size();
    forms.resize(triangles);
    face_.resize(mesh_.vertices.size());
    vertex_.resize(mesh_.vertices.size());
    nearest_.resize(triangles);
    place_vertices(view_, face_.data(), vertex_.data());
    corners.resize(mesh_.vertices.size());
    for (std::size_t i = 0; i < mesh_.vertices.size(); ++i) corners[i] = mesh_.vertices[i];
    view_.xyz = corners.data()->data();
    entry_.resize(5 * triangles / 2 + 4 * triangles_per_chunk);
    std::array<TriangleRadii, triangles_per_chunk> radii;
    std::array<std::uint32_t, triangles_per_chunk> elsewhere;
    for (std::size_t first = 0; first < triangles; first += triangles_per_chunk) {
      const std::size_t last = std::min(first + triangles_per_chunk, triangles);
      measure_triangles(view_, first, last, forms.data(), radii.data());
      for (std::size_t t = first; t < last; ++t) nearest_[t] = radii[t - first].least;
      make_room(4 * triangles_per_chunk);
      Listing listing{
          n_, entry_.data(), count_, length_.data(), least_.data(), greatest_.data(), elsewhere.data(), 0};
      list_small_triangles(view_, face_.data(), vertex_.data(), first, last, radii.data(), listing);
      count_ = listing.count;
      for (std::size_t i = 0; i < listing.elsewhere_count; ++i) {
        list_triangle(elsewhere[i], radii[elsewhere[i] - first], forms[elsewhere[i]]);
      }
    }
  }

  /// The entries in the order of the triangles, and least and greatest squared radius in each cell.
  std::span<const ListedTriangle> entries() const { return {entry_.data(), count_}; }
  /// Squared radius that no point of the triangle is below.
  float nearest(Index triangle) const { return nearest_[triangle]; }
  float least(Index cell) const { return least_[cell]; }
  float greatest(Index cell) const { return greatest_[cell]; }

  void sort_into(CellLists& lists) const {
    const Index cells = map_.cell_count();
    lists.least_squared = infinity, lists.greatest_squared = 0;
    for (Index cell = 0; cell < cells; ++cell) {
      lists.least_squared = std::min(lists.least_squared, least_[cell]);
      lists.greatest_squared = std::max(lists.greatest_squared, greatest_[cell]);
    }
    if (count_ > 0) lists.scale = {lists.least_squared, lists.greatest_squared};
    lists.row.resize(cells);
    lists.row_end.clear();
    lists.radii.resize(cells);
    std::uint32_t first = 0;
    for (Index cell = 0; cell < cells; ++cell) {
      lists.row[cell] = {first, first};
      first += length_[cell];
      lists.radii[cell] =
          length_[cell] == 0 ? no_radii
                             : radius_word(lists.scale.code(least_[cell]), lists.scale.code(greatest_[cell]));
    }
    lists.resize_entries(count_);
    for (std::size_t i = 0; i < count_; ++i) {
      const ListedTriangle& entry = entry_[i];
      lists.set_entry(lists.row[entry.cell].last++, entry.triangle, entry.octagon,
                      lists.scale.code(nearest_[entry.triangle]));
    }
  }

 private:
  void make_room(std::size_t entries) {
    if (entry_.size() < count_ + entries)
      entry_.resize(std::max(count_ + entries, entry_.size() + entry_.size() / 2));
  }

  void add(std::uint32_t cell, Index triangle, const CellOctagon& octagon, float least, float greatest) {
    make_room(1);
    entry_[count_++] = {cell, triangle, octagon};
    ++length_[cell];
    least_[cell] = std::min(least_[cell], least);
    greatest_[cell] = std::max(greatest_[cell], greatest);
  }

  /// A triangle over many cells, or over several faces. A face is seen by those rays whose largest coordinate
  /// is its own: a triangle with all corners beyond one side of that pyramid keeps off it. With all corners
  /// well in front of the others, their places on these faces are those of a plane triangle.
  void list_triangle(Index t, const TriangleRadii& radii, const ConeForms& forms) {
    const auto& [ia, ib, ic] = mesh_.triangles[t];
    const FacePoint &a = vertex_[ia], &b = vertex_[ib], &c = vertex_[ic];
    const bool on_one_face = face_[ia] == face_[ib] && face_[ib] == face_[ic];
    if (on_one_face && is_off_edges(a) && is_off_edges(b) && is_off_edges(c)) {
      return list_on_face(face_[ia], {{{a.u(), a.w()}, {b.u(), b.w()}, {c.u(), c.w()}}}, t, radii, forms);
    }
    const std::array<Vec3, 3> corner = {mesh_.corner(t, 0), mesh_.corner(t, 1), mesh_.corner(t, 2)};
    std::array<bool, 6> seen{};
    for (int face = 0; face < 6; ++face) {
      seen[static_cast<std::size_t>(face)] = !keeps_off(corner, face);
      if (seen[static_cast<std::size_t>(face)] && !is_in_front(corner, face)) {
        return list_clipped({corner[0], corner[1], corner[2]}, t);
      }
    }
    for (int face = 0; face < 6; ++face) {
      if (seen[static_cast<std::size_t>(face)]) list_on_face(face, places(corner, face), t, radii, forms);
    }
  }

  static bool keeps_off(const std::array<Vec3, 3>& corner, int face) {
    const int axis = face % 3;
    const double sign = (face < 3 ? 1 : -1) * (1 + 2 * static_cast<double>(list_margin));
    for (const int side : {(axis + 1) % 3, (axis + 2) % 3}) {
      const auto all = [&](double direction) {
        return std::all_of(corner.begin(), corner.end(),
                           [&](const Vec3& v) { return sign * v[axis] < direction * v[side]; });
      };
      if (all(1) || all(-1)) return true;
    }
    return false;
  }

  /// Places on the face are then within eight times its size.
  static bool is_in_front(const std::array<Vec3, 3>& corner, int face) {
    return std::all_of(corner.begin(), corner.end(), [&](const Vec3& v) {
      return 8 * (face < 3 ? v[face % 3] : -v[face % 3]) >= v.cwiseAbs().maxCoeff();
    });
  }

  static std::array<FacePosition, 3> places(const std::array<Vec3, 3>& corner, int face) {
    const int axis = face % 3;
    std::array<FacePosition, 3> p;
    for (std::size_t k = 0; k < 3; ++k) {
      const double depth = std::abs(corner[k][axis]);
      p[k] = {static_cast<float>(corner[k][(axis + 1) % 3] / depth),
              static_cast<float>(corner[k][(axis + 2) % 3] / depth)};
    }
    return p;
  }

  static bool is_off_edges(const FacePoint& p) {
    return std::max(std::abs(p.u()), std::abs(p.w())) < 1 - 2 * list_margin;
  }

  void list_clipped(const Cone& cone, Index t) {
    map_.visit_cells(cone, [&](const CellOverlap& overlap) {
      const double least = overlap.min_radius * overlap.min_radius,
                   most = overlap.max_radius * overlap.max_radius;
      add(overlap.cell, t, whole_cell, static_cast<float>(least * (1 - 0x1p-16)),
          static_cast<float>(most * (1 + 0x1p-16)));
    });
  }

  /// Parts of the face that a triangle takes, widened.
  FaceParts parts_of(const std::array<FacePosition, 3>& p) const {
    const float scale = 0.5f * static_cast<float>(n_ * parts_per_cell);
    FaceParts parts{};
    const auto set = [&](std::size_t k, float a, float b, float c, float start, float margin, int most) {
      const auto part = [&](float at) { return std::clamp(static_cast<int>((at + start) * scale), 0, most); };
      parts.least[k] = part(std::min({a, b, c}) - margin),
      parts.greatest[k] = part(std::max({a, b, c}) + margin);
    };
    // Corners may lie off the face.
    const int most = n_ * parts_per_cell - 1;
    set(0, p[0].u, p[1].u, p[2].u, 1, list_margin, most);
    set(1, p[0].w, p[1].w, p[2].w, 1, list_margin, most);
    set(2, p[0].u + p[0].w, p[1].u + p[1].w, p[2].u + p[2].w, 2, 2 * list_margin, 2 * most + 1);
    set(3, p[0].u - p[0].w, p[1].u - p[1].w, p[2].u - p[2].w, 2, 2 * list_margin, 2 * most + 1);
    return parts;
  }

  static bool keeps_off_face(float a, float b, float c) {
    return std::max({a, b, c}) < -1 - 2 * list_margin || std::min({a, b, c}) > 1 + 2 * list_margin;
  }

  /// An edge of the triangle on the face: inside is where normal . (p - start) >= 0.
  struct Side {
    FacePosition start;
    float u, w;

    /// Whether no point of the cell, widened, is inside.
    bool keeps_off(float low_u, float high_u, float low_w, float high_w) const {
      const float best = u * ((u > 0 ? high_u : low_u) - start.u) + w * ((w > 0 ? high_w : low_w) - start.w);
      return best < -2 * list_margin * (std::abs(u) + std::abs(w));
    }
  };

  void list_on_face(int face, const std::array<FacePosition, 3>& p, Index t, const TriangleRadii& radii,
                    const ConeForms& forms) {
    if (keeps_off_face(p[0].u, p[1].u, p[2].u) || keeps_off_face(p[0].w, p[1].w, p[2].w)) return;
    const FaceParts parts = parts_of(p);
    const int first_column = parts.least[0] >> 8, last_column = parts.greatest[0] >> 8;
    const int first_row = parts.least[1] >> 8, last_row = parts.greatest[1] >> 8;
    const float turn = (p[1].u - p[0].u) * (p[2].w - p[0].w) - (p[1].w - p[0].w) * (p[2].u - p[0].u);
    const float sign = turn < 0 ? -1.0f : 1.0f;
    std::array<Side, 3> side;
    for (std::size_t k = 0; k < 3; ++k) {
      const FacePosition &from = p[k], &to = p[(k + 1) % 3];
      side[k] = {from, sign * (from.w - to.w), sign * (to.u - from.u)};
    }
    // Of a sliver the turn may be rounding: it keeps its octagon. Places err by up to 8 u, u = 2^-24.
    const auto extent = [](float x, float y, float z) { return std::max({x, y, z}) - std::min({x, y, z}); };
    const float width = std::max(extent(p[0].u, p[1].u, p[2].u), extent(p[0].w, p[1].w, p[2].w));
    const bool has_sides = std::abs(turn) > 16 * list_margin * width;
    const float step = 2.0f / static_cast<float>(n_);
    for (int row = first_row; row <= last_row; ++row) {
      const float low_w = static_cast<float>(row) * step - 1, high_w = low_w + step;
      for (int column = first_column; column <= last_column; ++column) {
        const float low_u = static_cast<float>(column) * step - 1, high_u = low_u + step;
        const auto off = [&](const Side& s) { return s.keeps_off(low_u, high_u, low_w, high_w); };
        if (has_sides && (off(side[0]) || off(side[1]) || off(side[2]))) continue;
        const auto octagon = octagon_in_cell(parts, n_, column, row);
        if (!octagon) continue;
        const auto [least, greatest] = radii_in_cell(face, column, row, radii, forms);
        add(static_cast<std::uint32_t>((face * n_ + row) * n_ + column), t, *octagon, least, greatest);
      }
    }
  }

  struct SquaredRadii {
    float least, greatest;
  };

  /// Radii of the triangle's plane within a cell. In unit direction d the plane has the radius 1 / (n . d), n
  /// the plane's form. d is a sum of the cell's corner directions with weights >= 0, whose sum is at least 1
  /// and at most 1 / cosine (of the angle between middle and corner): so n . d lies between the least n .
  /// corner, if that is positive, and the greatest over the cosine. 2^-14 |n| covers the widening and the
  /// floats.
  SquaredRadii radii_in_cell(int face, int column, int row, const TriangleRadii& radii,
                             const ConeForms& forms) const {
    const int axis = face % 3;
    const float plane[3] = {forms.x[3], forms.y[3], forms.z[3]};
    const float n = face < 3 ? plane[axis] : -plane[axis], n_u = plane[(axis + 1) % 3],
                n_w = plane[(axis + 2) % 3];
    const float margin = 0x1p-14f * (std::abs(n) + std::abs(n_u) + std::abs(n_w));
    const float step = 2.0f / static_cast<float>(n_), u = static_cast<float>(column) * step - 1;
    const float w = static_cast<float>(row) * step - 1, corner = n + n_u * u + n_w * w;
    const float* inverse = inverse_length_.data() + row * (n_ + 1) + column;
    const float a = corner * inverse[0], b = (corner + n_u * step) * inverse[1];
    const float c = (corner + n_w * step) * inverse[n_ + 1];
    const float d = (corner + (n_u + n_w) * step) * inverse[n_ + 2];
    float least = std::min({a, b, c, d}), greatest = std::max({a, b, c, d});
    // The form is positive where rays leave the solid, negative where they enter.
    if (greatest + least < 0) std::swap(least, greatest), least = -least, greatest = -greatest;
    SquaredRadii within{radii.least, radii.greatest};
    const float nearest = cosine_ / (greatest + margin), furthest = 1 / (least - margin);
    if (nearest > 0) within.least = std::max(within.least, nearest * nearest * (1 - 0x1p-16f));
    if (furthest > 0) within.greatest = std::min(within.greatest, furthest * furthest * (1 + 0x1p-16f));
    return within;
  }

  const TriMesh& mesh_;
  const CubeMap& map_;
  int n_;
  MeshView view_;
  float cosine_;
  const std::vector<float>& inverse_length_;
  UninitialisedVector<std::uint8_t> face_;
  UninitialisedVector<FacePoint> vertex_;
  UninitialisedVector<float> nearest_;
  UninitialisedVector<ListedTriangle> entry_;
  std::size_t count_ = 0;
  std::vector<std::uint32_t> length_;
  std::vector<float> least_, greatest_;
};

}  // namespace

CellLists list_cells(const TriMesh& mesh, const CubeMap& map) {
  CellLists lists;
  list_cells(mesh, map, lists);
  return lists;
}

void list_cells(const TriMesh& mesh, const CubeMap& map, CellLists& lists) {
  if (lists.inverse_length.empty()) lists.inverse_length = inverse_lengths(map.cells_per_side());
  CubeListing listing(mesh, map, lists.inverse_length);
  listing.list(lists.forms, lists.corner);
  listing.sort_into(lists);
}

bool move_triangles(const CubeMap& map, std::span<const Index> triangles, const TriMesh& before,
                    const TriMesh& after, CellLists& lists) {
  UninitialisedVector<ConeForms> forms;
  UninitialisedVector<Vec3> corners;
  CubeListing old(before, map, lists.inverse_length);
  old.list(forms, corners);
  for (const ListedTriangle& entry : old.entries()) lists.remove_entry(entry.cell, triangles[entry.triangle]);

  CubeListing moved(after, map, lists.inverse_length);
  moved.list(forms, corners);
  for (std::size_t i = 0; i < triangles.size(); ++i) lists.forms[triangles[i]] = forms[i];
  bool grown = false;
  for (const ListedTriangle& entry : moved.entries()) {
    lists.add_entry(entry.cell, triangles[entry.triangle], entry.octagon,
                    lists.scale.code(moved.nearest(entry.triangle)));
    const float least = moved.least(entry.cell), greatest = moved.greatest(entry.cell);
    RadiusWord& word = lists.radii[entry.cell];
    const RadiusWord grown_word =
        union_of(word, radius_word(lists.scale.code(least), lists.scale.code(greatest)));
    grown |= grown_word != word;
    word = grown_word;
    lists.least_squared = std::min(lists.least_squared, least);
    lists.greatest_squared = std::max(lists.greatest_squared, greatest);
  }
  return grown;
}

}  // namespace condyle
