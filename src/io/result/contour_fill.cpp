#include "io/result/contour_fill.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>

namespace condyle::io {
namespace {

/// A node of the triangulation: a grid point, or the middle of a cell.
struct Node {
  std::size_t id;
  ScreenPoint at;
  double value;
};

/// A triangle, counter-clockwise, and which of its sides (from corner k to k + 1) bound the whole domain.
struct Piece {
  std::array<Node, 3> corner;
  std::array<bool, 3> outer{};
};

using Side = std::pair<std::size_t, std::size_t>;

Side side_of(const Piece& piece, std::size_t k) {
  return std::minmax(piece.corner[k].id, piece.corner[(k + 1) % 3].id);
}

std::vector<Piece> triangulated(const GridField& field) {
  const std::size_t columns = field.x.size(), rows = field.y.size();
  std::vector<Piece> pieces;
  for (std::size_t j = 0; j + 1 < rows; ++j) {
    for (std::size_t i = 0; i + 1 < columns; ++i) {
      const auto node = [&](std::size_t column, std::size_t row) {
        const std::size_t id = row * columns + column;
        return Node{id, {field.x[column], field.y[row]}, field.values[id]};
      };
      const std::array cell{node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)};
      const auto missing = [](const Node& n) { return std::isnan(n.value); };
      const auto absent = std::find_if(cell.begin(), cell.end(), missing);
      if (absent == cell.end()) {
        const Node middle{columns * rows + j * columns + i,
                          {(cell[0].at.x + cell[2].at.x) / 2, (cell[0].at.y + cell[2].at.y) / 2},
                          ((cell[0].value + cell[2].value) + (cell[1].value + cell[3].value)) / 4};
        for (std::size_t k = 0; k < 4; ++k) pieces.push_back({{cell[k], cell[(k + 1) % 4], middle}});
      } else if (std::none_of(absent + 1, cell.end(), missing)) {
        const auto k = static_cast<std::size_t>(absent - cell.begin());
        pieces.push_back({{cell[(k + 1) % 4], cell[(k + 2) % 4], cell[(k + 3) % 4]}});
      }
    }
  }
  std::map<Side, int> uses;
  for (const Piece& piece : pieces)
    for (std::size_t k = 0; k < 3; ++k) ++uses[side_of(piece, k)];
  for (Piece& piece : pieces)
    for (std::size_t k = 0; k < 3; ++k) piece.outer[k] = uses[side_of(piece, k)] == 1;
  return pieces;
}

/// Where the level is on a side, the same bits from both its triangles: the side is always read from its
/// lower end. Exactly the upper end where the level is that end's value.
ScreenPoint crossing(const Node& a, const Node& b, double level) {
  const Node& low = a.value < b.value ? a : b;
  const Node& high = a.value < b.value ? b : a;
  const double t = (level - low.value) / (high.value - low.value);
  if (t == 1) return high.at;
  return {low.at.x + t * (high.at.x - low.at.x), low.at.y + t * (high.at.y - low.at.y)};
}

struct Less {
  bool operator()(const ScreenPoint& a, const ScreenPoint& b) const noexcept {
    return std::pair(a.x, a.y) < std::pair(b.x, b.y);
  }
};

enum class EdgeKind { along_outer_side, across_triangle };

/// Directed edges of an outline; two that run against each other cancel.
class Outline {
 public:
  void add(ScreenPoint from, ScreenPoint to, EdgeKind kind) {
    if (from == to) return;
    const auto back = edges_.find(to);
    if (back != edges_.end() && back->second.erase(from) > 0) {
      if (back->second.empty()) edges_.erase(back);
    } else {
      edges_[from].emplace(to, kind);
    }
  }

  /// Follows edges from the point until there is none, using them up.
  Ring take_path(ScreenPoint start) {
    Ring path{start};
    for (auto at = edges_.find(start); at != edges_.end(); at = edges_.find(path.back())) {
      path.push_back(at->second.begin()->first);
      at->second.erase(at->second.begin());
      if (at->second.empty()) edges_.erase(at);
    }
    return path;
  }

  bool empty() const noexcept { return edges_.empty(); }
  ScreenPoint first() const { return edges_.begin()->first; }

  Outline only(EdgeKind kind) const {
    Outline chosen;
    for (const auto& [from, ends] : edges_)
      for (const auto& [to, its_kind] : ends)
        if (its_kind == kind) chosen.edges_[from].emplace(to, kind);
    return chosen;
  }

  /// The points at which more edges begin than end, once per edge too many.
  std::vector<ScreenPoint> starts() const {
    std::map<ScreenPoint, std::ptrdiff_t, Less> excess;
    for (const auto& [from, ends] : edges_)
      for (const auto& [to, kind] : ends) ++excess[from], --excess[to];
    std::vector<ScreenPoint> starts;
    for (const auto& [point, count] : excess)
      for (std::ptrdiff_t i = 0; i < count; ++i) starts.push_back(point);
    return starts;
  }

 private:
  std::map<ScreenPoint, std::map<ScreenPoint, EdgeKind, Less>, Less> edges_;
};

/// The ring without points in the middle of a straight run along a row or column of the grid.
Ring simplified(const Ring& ring) {
  Ring out;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const ScreenPoint &before = ring[(i + ring.size() - 1) % ring.size()], &at = ring[i],
                      &after = ring[(i + 1) % ring.size()];
    const bool in_row = before.y == at.y && at.y == after.y;
    const bool in_column = before.x == at.x && at.x == after.x;
    if (!in_row && !in_column) out.push_back(at);
  }
  return out;
}

/// The outline of what is at or above the level. A side shared by two triangles is never part of it: both
/// have the same piece of it, walked in opposite directions.
Outline outline_at_or_above(const GridField& field, double level) {
  Outline outline;
  for (const Piece& piece : triangulated(field)) {
    std::optional<ScreenPoint> exit, entry;  // where the walk around the triangle leaves what is above
    for (std::size_t k = 0; k < 3; ++k) {
      const Node &a = piece.corner[k], &b = piece.corner[(k + 1) % 3];
      const bool a_above = a.value >= level, b_above = b.value >= level;
      if (a_above && !b_above) exit = crossing(a, b, level);
      if (!a_above && b_above) entry = crossing(a, b, level);
      if (piece.outer[k] && (a_above || b_above))
        outline.add(a_above ? a.at : *entry, b_above ? b.at : *exit, EdgeKind::along_outer_side);
    }
    if (exit) outline.add(*exit, *entry, EdgeKind::across_triangle);
  }
  return outline;
}

}  // namespace

ContourRegion region_at_or_above(const GridField& field, double level) {
  assert(field.values.size() == field.x.size() * field.y.size());
  Outline outline = outline_at_or_above(field, level);
  Outline crossings = outline.only(EdgeKind::across_triangle);
  ContourRegion region;
  while (!outline.empty()) {
    Ring ring = outline.take_path(outline.first());
    ring.pop_back();  // the first point again
    region.rings.push_back(simplified(ring));
  }
  for (const ScreenPoint& start : crossings.starts()) region.lines.push_back(crossings.take_path(start));
  while (!crossings.empty()) region.lines.push_back(crossings.take_path(crossings.first()));
  return region;
}

}  // namespace condyle::io
