#include "mesh/triangle_tree.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/float_bounds.hpp"
#include "core/lazy.hpp"
#include "core/parallel.hpp"
#include "core/predicates.hpp"
#include "mesh/findings.hpp"

namespace condyle::mesh {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

constexpr int bits_per_axis = 10, bits_per_digit = 10, digits = 3;

/// A triangle and the cell of its centroid, in the order of a curve that fills space (Morton 1966).
struct KeyedTriangle {
  std::uint32_t key;
  Index triangle;
};

/// Every third bit from the ten of a number, of two numbers at once in the halves of a word.
constexpr std::uint64_t spread(std::uint64_t bits) noexcept {
  bits = (bits | bits << 16) & 0x030000ff'030000ffu;
  bits = (bits | bits << 8) & 0x0300f00f'0300f00fu;
  bits = (bits | bits << 4) & 0x030c30c3'030c30c3u;
  return (bits | bits << 2) & 0x09249249'09249249u;
}

struct Cube {
  Vec3 low;
  double steps_per_mm;

  /// The key of the centroid of three points.
  std::uint32_t key_of(const Vec3& a, const Vec3& b, const Vec3& c) const noexcept {
    constexpr double last = (1 << bits_per_axis) - 1;
    const auto step = [&](int axis) -> std::uint64_t {
      const double steps = (a[axis] + b[axis] + c[axis] - 3 * low[axis]) * (steps_per_mm / 3);
      // Not a number, where coordinates overflow, ends anywhere: any order is a right one.
      return static_cast<std::uint32_t>(static_cast<int>(std::max(0.0, std::min(last, steps))));
    };
    const std::uint64_t of_xy = spread(step(0) << 32 | step(1));
    return static_cast<std::uint32_t>(of_xy >> 30 | of_xy << 1 | spread(step(2)));
  }
};

Cube cube_around(const TriMesh& mesh) {
  Vec3 low = Vec3::Zero();
  double side = 0;
  const auto& v = mesh.vertices;
  int axis = 0;
  for (const auto* values : {&v.x, &v.y, &v.z}) {
    const auto [least, most] = std::minmax_element(values->begin(), values->end());
    low[axis++] = *least;
    side = std::max(side, *most - *least);
  }
  return {low, side > 0 ? (1 << bits_per_axis) / side : 0};
}

/// By digits from the lowest: linear, and equal keys keep their order.
void sort_by_key(std::vector<KeyedTriangle>& items) {
  std::array<std::array<Index, 1 << bits_per_digit>, digits> starts{};
  constexpr std::uint32_t mask = (1 << bits_per_digit) - 1;
  for (const auto& item : items) {
    for (std::uint32_t d = 0; d < digits; ++d) ++starts[d][item.key >> d * bits_per_digit & mask];
  }
  std::vector<KeyedTriangle> other(items.size());
  for (std::uint32_t d = 0; d < digits; ++d) {
    Index sum = 0;
    for (Index& start : starts[d]) sum += std::exchange(start, sum);
    for (const auto& item : items) other[starts[d][item.key >> d * bits_per_digit & mask]++] = item;
    items.swap(other);
  }
}

std::vector<KeyedTriangle> in_order_of_the_curve(const TriMesh& mesh) {
  const Cube cube = cube_around(mesh);
  std::vector<KeyedTriangle> items(mesh.triangles.size());
  for (Index t = 0; t < items.size(); ++t) {
    items[t] = {cube.key_of(mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)), t};
  }
  sort_by_key(items);
  return items;
}

/// Bounds of a node, still in double.
struct Extent {
  Vec3 low = Vec3::Constant(infinity), high = -low;
  double squared_nearest = infinity, squared_farthest = 0;

  void extend(const Extent& other) noexcept {
    low = low.cwiseMin(other.low), high = high.cwiseMax(other.high);
    squared_nearest = std::min(squared_nearest, other.squared_nearest);
    squared_farthest = std::max(squared_farthest, other.squared_farthest);
  }
};

/// The nearest point of a triangle is at most (longest edge) / sqrt(3) from its nearest corner and a right
/// angle off: |p|^2 >= min^2 - longest^2 / 3. The squares' roundings are below 16 u max^2.
Extent extent_of(const std::array<Vec3, 3>& t) noexcept {
  // Minima of pairs: a list of three would be stored and read again.
  const double a = t[0].squaredNorm(), b = t[1].squaredNorm(), c = t[2].squaredNorm();
  const double min = std::min(std::min(a, b), c), max = std::max(std::max(a, b), c);
  const double longest = std::max(std::max((t[1] - t[0]).squaredNorm(), (t[2] - t[1]).squaredNorm()),
                                  (t[0] - t[2]).squaredNorm());
  return {t[0].cwiseMin(t[1]).cwiseMin(t[2]), t[0].cwiseMax(t[1]).cwiseMax(t[2]),
          min - longest / 3 - 16 * core::rounding_unit * max, max};
}

/// Bounds of a node from its box and its shell in single precision.
Extent extent_of(const TriangleTree::Node& node) noexcept {
  Extent extent;
  for (int axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    extent.low[axis] = double{node.centre[k]} - double{node.half[k]};
    extent.high[axis] = double{node.centre[k]} + double{node.half[k]};
  }
  extent.squared_nearest = double{node.nearest} * double{node.nearest};
  extent.squared_farthest = double{node.farthest} * double{node.farthest};
  return extent;
}

void set_bounds(TriangleTree::Node& node, const Extent& extent) noexcept {
  for (int axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    node.centre[k] = static_cast<float>(extent.low[axis] / 2 + extent.high[axis] / 2);
    const double centre = node.centre[k];
    node.half[k] = core::float_above(std::max(extent.high[axis] - centre, centre - extent.low[axis]));
  }
  node.nearest = extent.squared_nearest > 0 ? core::float_below(std::sqrt(extent.squared_nearest)) : 0.0f;
  node.farthest = core::float_above(std::sqrt(extent.squared_farthest) * (1 + 8 * core::rounding_unit));
}

/// Splits where the curve leaves one half of a cell for the other.
class Builder {
 public:
  Builder(const TriangleTree& tree, const std::vector<KeyedTriangle>& items,
          core::UninitialisedVector<TriangleTree::Node>& nodes)
      : tree_(tree), items_(items), nodes_(nodes) {}

  void build() {
    nodes_.push_back({{}, {}, 0, 0, 0, static_cast<Index>(items_.size()), 0});
    build(0);
  }

 private:
  Extent build(Index at) {
    const Index first = nodes_[at].first, last = nodes_[at].last;
    Extent extent;
    if (last - first <= TriangleTree::leaf_triangles) {
      for (Index t = first; t < last; ++t) extent.extend(extent_of(tree_.corners(t)));
    } else {
      const Index middle = split(first, last), child = static_cast<Index>(nodes_.size());
      nodes_[at].child = child;
      nodes_.push_back({{}, {}, 0, 0, first, middle, 0});
      nodes_.push_back({{}, {}, 0, 0, middle, last, 0});
      extent = build(child);
      extent.extend(build(child + 1));
    }
    set_bounds(nodes_[at], extent);
    return extent;
  }

  /// The first item with the highest bit in which the keys differ; the middle one where they are all alike.
  Index split(Index first, Index last) const noexcept {
    const std::uint32_t differ = items_[first].key ^ items_[last - 1].key;
    if (differ == 0) return first + (last - first) / 2;
    const std::uint32_t high = std::bit_floor(differ), upper = items_[last - 1].key & ~(high - 1);
    const auto begin = items_.begin();
    return static_cast<Index>(std::partition_point(begin + first, begin + last,
                                                   [&](const auto& item) { return item.key < upper; }) -
                              begin);
  }

  const TriangleTree& tree_;
  const std::vector<KeyedTriangle>& items_;
  core::UninitialisedVector<TriangleTree::Node>& nodes_;
};

struct KeptTree {
  core::Lazy<std::shared_ptr<const TriangleTree>> tree;
};

}  // namespace

std::shared_ptr<const TriangleTree> tree_of(const Mesh& mesh) {
  return findings_of(mesh).get<KeptTree>().tree.get(
      [&](auto& tree) { tree = std::make_shared<const TriangleTree>(mesh); });
}

TriangleTree::TriangleTree(const TriMesh& mesh) {
  if (mesh.triangles.empty()) return;
  const auto items = in_order_of_the_curve(mesh);
  mesh_triangles_.resize(items.size());
  for (std::size_t i = 0; i < items.size(); ++i) mesh_triangles_[i] = items[i].triangle;
  number_anew(mesh);
  nodes_.reserve(items.size());
  Builder(*this, items, nodes_).build();
}

TriangleTree TriangleTree::moved_to(const Points& mesh_vertices) const {
  TriangleTree moved = *this;
  for (std::size_t v = 0; v < vertices_.size(); ++v) moved.vertices_[v] = mesh_vertices[mesh_vertices_[v]];
  // Children come after their parent.
  std::vector<Extent> extents(nodes_.size());
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    Node& node = moved.nodes_[i];
    if (node.is_leaf()) {
      for (Index t = node.first; t < node.last; ++t) extents[i].extend(extent_of(moved.corners(t)));
    } else {
      extents[i] = extents[node.child];
      extents[i].extend(extents[node.child + 1]);
    }
    set_bounds(node, extents[i]);
  }
  return moved;
}

void TriangleTree::refit(const Points& mesh_vertices, std::span<const char> is_moved) {
  if (empty()) return;
  if (overlap_made_ == 0) overlap_made_ = overlap();
  const auto has_moved = [&](Index place) { return is_moved.empty() || is_moved[mesh_vertices_[place]]; };
  for (Index place = 0; place < vertices_.size(); ++place)
    if (has_moved(place)) vertices_[place] = mesh_vertices[mesh_vertices_[place]];
  std::vector<char> is_refitted(is_moved.empty() ? 0 : nodes_.size());
  const auto needs_refit = [&](const Node& node) {
    if (is_moved.empty()) return true;
    if (!node.is_leaf()) return is_refitted[node.child] || is_refitted[node.child + 1];
    return std::any_of(
        triangles_.begin() + node.first, triangles_.begin() + node.last,
        [&](const Triangle& t) { return has_moved(t[0]) || has_moved(t[1]) || has_moved(t[2]); });
  };
  const auto mark = [&](std::size_t i) {
    if (!is_refitted.empty()) is_refitted[i] = true;
  };
  core::parallel_chunks(nodes_.size(), 1024, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      Node& node = nodes_[i];
      if (!node.is_leaf() || !needs_refit(node)) continue;
      Extent extent;
      for (Index t = node.first; t < node.last; ++t) extent.extend(extent_of(corners(t)));
      set_bounds(node, extent);
      mark(i);
    }
  });
  // Children come after their parent.
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    Node& node = nodes_[i];
    if (node.is_leaf() || !needs_refit(node)) continue;
    Extent extent = extent_of(nodes_[node.child]);
    extent.extend(extent_of(nodes_[node.child + 1]));
    set_bounds(node, extent);
    mark(i);
  }
  overlap_now_ = overlap();
}

double TriangleTree::overlap() const noexcept {
  double sum = 0;
  for (const Node& node : nodes_) sum += double{node.size()};
  return sum / double{nodes_[0].size()};
}

void TriangleTree::number_anew(const TriMesh& mesh) {
  std::vector<Index> place(mesh.vertices.size(), no_index);
  triangles_.resize(mesh_triangles_.size());
  mesh_vertices_.resize(mesh.vertices.size() + 1);
  // Without a branch on whether a vertex is new, which no processor predicts: each is written where the next new one goes.
  constexpr std::size_t ahead = 16;  // What is read lies anywhere in the mesh.
  Index count = 0;
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    if (i + ahead < triangles_.size()) __builtin_prefetch(&mesh.triangles[mesh_triangles_[i + ahead]]);
    for (std::size_t k = 0; k < 3; ++k) {
      const Index v = mesh.triangles[mesh_triangles_[i]][k];
      mesh_vertices_[count] = v;
      const Index at = std::min(place[v], count);
      place[v] = triangles_[i][k] = at;
      count += at == count;
    }
  }
  mesh_vertices_.resize(count);
  vertices_.resize(count);
  for (Index i = 0; i < count; ++i) vertices_[i] = mesh.vertices[mesh_vertices_[i]];
}

/// Union by smallest number.
const std::vector<Index>& TriangleTree::one_vertex_of_each_piece() const {
  return piece_vertices_.get([&](std::vector<Index>& pieces) {
    std::vector<Index> root(vertices_.size());
    std::iota(root.begin(), root.end(), Index{0});
    const auto find = [&](Index v) {
      while (root[v] != v) v = root[v] = root[root[v]];
      return v;
    };
    for (const auto& [a, b, c] : triangles_) {
      const Index i = root[a], j = root[b], k = root[c];
      if (i == j && j == k) continue;
      const Index p = find(i), q = find(j), r = find(k), low = std::min({p, q, r});
      root[p] = root[q] = root[r] = root[a] = root[b] = root[c] = low;
    }
    for (Index v = 0; v < root.size(); ++v) {
      if (root[v] == v) pieces.push_back(v);
    }
  });
}

}  // namespace condyle::mesh
