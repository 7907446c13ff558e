#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "condyle/radial.hpp"
#include "questions.hpp"
#include "timing.hpp"

/// Maps from directions to cells, each with as many cells, the same binning and the same plain test of a vertex
/// against the triangles of its cell: what a map costs and what its cells cost.

namespace bench {
namespace {

using condyle::Index;
using condyle::Vec3;

struct Range {
  double low, high;
};

Range squared(Range s) noexcept {
  const double a = s.low * s.low, b = s.high * s.high;
  return {s.low <= 0 && s.high >= 0 ? 0 : std::min(a, b), std::max(a, b)};
}

/// Where a direction falls: on which square, and its two coordinates there, each in [-1, 1].
struct Place {
  int square;
  double a, b;
};

/// A positive multiple of each direction of a block of cells lies in here; empty (low > high) if there is none.
struct Box {
  Vec3 low, high;
};

const Box no_directions = {Vec3::Constant(1), Vec3::Constant(-1)};

/// Hemispheres on discs: (x, y, +-height(s)) for s = a^2 + b^2 up to 1, the height falling as s grows.
template <class Height>
Box of_disc(int square, Range a, Range b, Height height) {
  const Range aa = squared(a), bb = squared(b);
  if (aa.low + bb.low > 1) return no_directions;
  const double most = height(aa.low + bb.low), least = height(std::min(1.0, aa.high + bb.high));
  return square == 0 ? Box{{a.low, b.low, least}, {a.high, b.high, most}}
                     : Box{{a.low, b.low, -most}, {a.high, b.high, -least}};
}

struct NormalisedCartesian {
  static constexpr const char* title = "the paper's map, x/R and y/R";
  static constexpr int squares = 2;
  static constexpr double share_used = std::numbers::pi / 4;
  static Place place(const Vec3& v) noexcept {
    const double r = 1 / v.norm();
    return {v.z() < 0, v.x() * r, v.y() * r};
  }
  static Box box(int square, Range a, Range b) {
    return of_disc(square, a, b, [](double s) { return std::sqrt(1 - s); });
  }
};

/// Lambert's azimuthal projection of each hemisphere.
struct EqualArea {
  static constexpr const char* title = "equal-area discs (Lambert)";
  static constexpr int squares = 2;
  static constexpr double share_used = std::numbers::pi / 4;
  static Place place(const Vec3& v) noexcept {
    const double r = v.norm(), scale = 1 / std::sqrt(r * (r + std::abs(v.z())));
    return {v.z() < 0, v.x() * scale, v.y() * scale};
  }
  static Box box(int square, Range a, Range b) {
    return of_disc(square, a, b, [](double s) { return (1 - s) / std::sqrt(2 - s); });
  }
};

/// Lambert's cylindrical projection, a square for each sign of y.
struct LongitudeAndHeight {
  static constexpr const char* title = "longitude and z/R, of equal area";
  static constexpr int squares = 2;
  static constexpr double share_used = 1;
  static Place place(const Vec3& v) noexcept {
    return {v.y() < 0, std::atan2(std::abs(v.y()), v.x()) * (2 / std::numbers::pi) - 1, v.z() / v.norm()};
  }
  static Box box(int square, Range a, Range b) {
    constexpr double quarter = std::numbers::pi / 2;
    const auto longitude = [](double at) { return std::clamp(at + 1, 0.0, 2.0) * quarter; };
    const Range l = {longitude(a.low), longitude(a.high)}, bb = squared(b);
    const double near = std::sqrt(1 - std::min(1.0, bb.high)), far = std::sqrt(1 - std::min(1.0, bb.low));
    const double c0 = std::cos(l.high), c1 = std::cos(l.low), s0 = std::sin(l.low), s1 = std::sin(l.high);
    const double most = (l.low <= quarter && l.high >= quarter ? 1 : std::max(s0, s1)) * far;
    const double least = std::min(s0, s1) * near;
    return {{std::min(c0 * near, c0 * far), square == 0 ? least : -most, b.low},
            {std::max(c1 * near, c1 * far), square == 0 ? most : -least, b.high}};
  }
};

struct Cube {
  static constexpr const char* title = "a cube, Condyle's map";
  static constexpr int squares = 6;
  static constexpr double share_used = 1;
  static Place place(const Vec3& v) noexcept {
    const double x = std::abs(v.x()), y = std::abs(v.y()), z = std::abs(v.z());
    const int k = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
    const double scale = 1 / std::abs(v[k]);
    return {k + 3 * (v[k] < 0), v[(k + 1) % 3] * scale, v[(k + 2) % 3] * scale};
  }
  static Box box(int square, Range a, Range b) {
    const int k = square % 3;
    Box box;
    box.low[k] = box.high[k] = square < 3 ? 1 : -1;
    box.low[(k + 1) % 3] = a.low, box.high[(k + 1) % 3] = a.high;
    box.low[(k + 2) % 3] = b.low, box.high[(k + 2) % 3] = b.high;
    return box;
  }
};

/// A triangle seen from the centre: the planes through the centre and its sides, inwards, and its own.
struct SeenTriangle {
  Vec3 side[3], normal;
  double volume;  ///< six times that of the tetrahedron with the centre

  SeenTriangle(const Vec3& a, const Vec3& b, const Vec3& c)
      : side{a.cross(b), b.cross(c), c.cross(a)},
        normal(side[0] + side[1] + side[2]),
        volume(a.dot(side[1])) {
    if (volume < 0)
      for (Vec3& s : side) s = -s;
  }

  bool may_meet(const Box& box) const noexcept {
    for (const Vec3& s : side) {
      const double most = s.cwiseProduct(box.low).cwiseMax(s.cwiseProduct(box.high)).sum();
      if (most < -1e-12 * s.cwiseAbs().sum()) return false;
    }
    return true;
  }
  /// What the surface adds to the winding number of v if the ray from the centre crosses it beyond v.
  int winding_beyond(const Vec3& v) const noexcept {
    if (side[0].dot(v) < 0 || side[1].dot(v) < 0 || side[2].dot(v) < 0) return 0;
    return std::abs(normal.dot(v)) < std::abs(volume) ? (volume > 0 ? 1 : -1) : 0;
  }
};

/// A table of lists on a map. Triangles are binned by halving blocks of cells down to quarters of a cell: the same way for
/// each map, conservative, and nearly exact whatever the shape of cells.
template <class Map>
class PlainTable {
 public:
  PlainTable(const std::vector<SeenTriangle>& triangles, std::size_t cells)
      : triangles_(triangles),
        n_(static_cast<int>(
            std::lround(std::sqrt(static_cast<double>(cells) / (Map::squares * Map::share_used))))),
        list_(static_cast<std::size_t>(Map::squares * n_ * n_)) {
    for (Index t = 0; t < triangles.size(); ++t)
      for (int square = 0; square < Map::squares; ++square) bin(t, square, 0, parts * n_, 0, parts * n_);
  }

  std::size_t cell_of(const Vec3& v) const noexcept {
    const Place at = Map::place(v);
    const auto step = [&](double s) { return std::clamp(static_cast<int>((s + 1) * (0.5 * n_)), 0, n_ - 1); };
    return static_cast<std::size_t>((at.square * n_ + step(at.b)) * n_ + step(at.a));
  }
  const std::vector<Index>& list_of(const Vec3& v) const noexcept { return list_[cell_of(v)]; }
  bool is_inside(const Vec3& v) const noexcept {
    int winding = 0;
    for (const Index t : list_of(v)) winding += triangles_[t].winding_beyond(v);
    return winding > 0;
  }

  std::int64_t cells_used() const { return std::lround(static_cast<double>(list_.size()) * Map::share_used); }

 private:
  static constexpr int parts = 4;

  void bin(Index t, int square, int i0, int i1, int j0, int j1) {
    const int size = parts * n_;
    const auto range = [&](int first, int last) {
      constexpr double margin = 1e-9;  // far above what place() rounds by
      return Range{2.0 * first / size - 1 - margin, 2.0 * last / size - 1 + margin};
    };
    std::vector<Index>& cell = list_[static_cast<std::size_t>((square * n_ + j0 / parts) * n_ + i0 / parts)];
    const bool is_within_cell = i1 - i0 <= parts && j1 - j0 <= parts;
    if (is_within_cell && !cell.empty() && cell.back() == t) return;
    const Box box = Map::box(square, range(i0, i1), range(j0, j1));
    if (box.low.x() > box.high.x() || !triangles_[t].may_meet(box)) return;
    if (i1 - i0 == 1 && j1 - j0 == 1) return cell.push_back(t);
    const auto middle = [](int first, int last) {
      const int half = (first + last) / 2;
      return last - first > parts ? half / parts * parts : half;
    };
    const int i = i1 - i0 > 1 ? middle(i0, i1) : i1, j = j1 - j0 > 1 ? middle(j0, j1) : j1;
    bin(t, square, i0, i, j0, j);
    if (i < i1) bin(t, square, i, i1, j0, j);
    if (j < j1) bin(t, square, i0, i, j, j1);
    if (i < i1 && j < j1) bin(t, square, i, i1, j, j1);
  }

  const std::vector<SeenTriangle>& triangles_;
  int n_;
  std::vector<std::vector<Index>> list_;
};

const TableHead maps_head{"direction_maps",
                          "Maps from directions to cells, binned and asked alike; one thread",
                          {{"scene", "scene"},
                           {"map", "map"},
                           {"cells", "cells"},
                           {"mean_list", "list that a vertex reads"},
                           {"map_ns_per_vertex", "the map alone, ns per vertex"},
                           {"ns_per_vertex", "all, ns per vertex"},
                           {"over_paper", "over the paper's"}}};

/// Vertices in the fixed body's frame, at poses of each kind.
condyle::Points posed_vertices(const Scene& scene) {
  condyle::Points points;
  const condyle::PointsView vertices = scene.joint.mobile.mesh.vertices();
  for (std::size_t p = 0; p < 6; ++p)
    for (std::size_t v = 0; v < vertices.size(); ++v)
      points.push_back(condyle::posed(scene.poses[p].X_FM, vertices[v]));
  return points;
}

}  // namespace

void ask_direction_maps(const Scene& scene, Effort effort, Report& report) {
  const condyle::TriMesh& fixed = scene.joint.fixed.mesh;
  std::vector<SeenTriangle> triangles;
  for (std::size_t t = 0; t < fixed.triangles.size(); ++t)
    triangles.emplace_back(fixed.corner(t, 0), fixed.corner(t, 1), fixed.corner(t, 2));
  const condyle::Points points = posed_vertices(scene);
  const auto count = static_cast<double>(points.size());
  const auto states = condyle::radial::RadialTable(fixed).query(points).state;
  const auto truth = std::count(states.begin(), states.end(), condyle::PointState::inside);
  double paper_seconds;
  const auto study = [&]<class Map>(Map, std::size_t cells) {
    const PlainTable<Map> table(triangles, cells);
    std::size_t listed = 0;
    std::ptrdiff_t inside = 0;
    volatile std::size_t kept = 0;
    for (std::size_t i = 0; i < points.size(); ++i) listed += table.list_of(points[i]).size();
    const auto map_alone = [&] {
      std::size_t sum = 0;
      for (std::size_t i = 0; i < points.size(); ++i) sum += table.cell_of(points[i]);
      kept = sum;
    };
    const auto all = [&] {
      inside = 0;
      for (std::size_t i = 0; i < points.size(); ++i) inside += table.is_inside(points[i]);
    };
    const auto samples = interleaved(effort == Effort::full ? 9 : 1, {map_alone, all});
    const double seconds = median(samples[1]);
    if (paper_seconds == 0) paper_seconds = seconds;
    if (inside != truth)
      report.disagreements.push_back(fmt::format("direction_maps/{}, {}: {} vertices inside, truly {}",
                                                 scene.joint.name, Map::title, inside, truth));
    report.table(maps_head).add({scene.joint.name, Map::title, table.cells_used(),
                                 static_cast<double>(listed) / count, median(samples[0]) / count * 1e9,
                                 seconds / count * 1e9, seconds / paper_seconds});
  };
  for (const std::size_t cells : {triangles.size() / 4, 4 * triangles.size()}) {
    paper_seconds = 0;
    study(NormalisedCartesian{}, cells), study(EqualArea{}, cells), study(LongitudeAndHeight{}, cells);
    study(Cube{}, cells);
  }
}

}  // namespace bench
