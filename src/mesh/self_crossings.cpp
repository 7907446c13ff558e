#include "mesh/self_crossings.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "core/float_bounds.hpp"
#include "core/lazy.hpp"
#include "core/parallel.hpp"
#include "mesh/findings.hpp"
#include "mesh/oriented_boxes.hpp"
#include "mesh/triangle_intersection.hpp"
#include "mesh/triangle_tree.hpp"

namespace condyle::mesh {
namespace {

using Node = TriangleTree::Node;

/// In single precision and no smaller than what it holds. The fourth of each is 0.
struct Box {
  Eigen::Array4f low, high;
};

/// Without branches: whether two boxes of one surface are apart cannot be predicted.
bool apart(const Box& a, const Box& b) noexcept {
  return (a.low - b.high).max(b.low - a.high).maxCoeff() > 0;
}

/// The boxes of all triangles, in the order of the tree.
std::vector<Box> boxes_of_triangles(const TriangleTree& tree) {
  std::vector<Box> boxes(tree.triangles().size());
  for (Index t = 0; t < boxes.size(); ++t) {
    const TriangleCorners c = tree.corners(t);
    for (int k = 0; k < 3; ++k) {
      boxes[t].low[k] = core::float_below(std::min(std::min(c[0][k], c[1][k]), c[2][k]));
      boxes[t].high[k] = core::float_above(std::max(std::max(c[0][k], c[1][k]), c[2][k]));
    }
    boxes[t].low[3] = boxes[t].high[3] = 0;
  }
  return boxes;
}

/// The boxes of all nodes. Children come after their parent.
std::vector<Box> boxes_of_nodes(const TriangleTree& tree, const std::vector<Box>& triangles) {
  std::vector<Box> boxes(tree.nodes().size());
  for (std::size_t i = boxes.size(); i-- > 0;) {
    const Node& node = tree.nodes()[i];
    Box box = node.is_leaf() ? triangles[node.first] : boxes[node.child];
    const auto extend = [&](const Box& other) {
      box.low = box.low.min(other.low);
      box.high = box.high.max(other.high);
    };
    if (node.is_leaf())
      for (Index t = node.first + 1; t < node.last; ++t) extend(triangles[t]);
    else
      extend(boxes[node.child + 1]);
    boxes[i] = box;
  }
  return boxes;
}

/// Vertices that all triangles of a node have in common, by their places; no_index for none.
using CommonVertices = std::array<Index, 3>;

/// One for each node. Vertices that lie at one place are one.
std::vector<CommonVertices> common_vertices(const TriangleTree& tree) {
  const auto kept_in = [&](CommonVertices common, const CommonVertices& other) {
    for (Index& v : common)
      if (v != no_index && std::none_of(other.begin(), other.end(), [&](Index w) {
            return w != no_index && tree.vertices()[v] == tree.vertices()[w];
          }))
        v = no_index;
    return common;
  };
  std::vector<CommonVertices> common(tree.nodes().size());
  for (std::size_t i = common.size(); i-- > 0;) {
    const Node& node = tree.nodes()[i];
    if (!node.is_leaf()) {
      common[i] = kept_in(common[node.child], common[node.child + 1]);
      continue;
    }
    common[i] = tree.triangles()[node.first];
    for (Index t = node.first + 1; t < node.last; ++t) common[i] = kept_in(common[i], tree.triangles()[t]);
  }
  return common;
}

bool has_any(const CommonVertices& common) noexcept {
  return std::any_of(common.begin(), common.end(), [](Index v) { return v != no_index; });
}

/// Whether so many triangles meet in one vertex that upright boxes of many of them overlap.
bool is_fan(const TriangleTree& tree, const std::vector<CommonVertices>& common) {
  constexpr Index many = 64;
  for (std::size_t i = 0; i < common.size(); ++i)
    if (tree.nodes()[i].last - tree.nodes()[i].first >= many && has_any(common[i])) return true;
  return false;
}

class CrossingSearch {
 public:
  explicit CrossingSearch(const TriangleTree& tree)
      : tree_(tree),
        triangle_boxes_(boxes_of_triangles(tree)),
        node_boxes_(boxes_of_nodes(tree, triangle_boxes_)),
        common_(common_vertices(tree)),
        oriented_(is_fan(tree, common_) || are_often_slender(tree) ? OrientedBoxes(tree) : OrientedBoxes()),
        crosses_(tree.triangles().size()) {}

  SelfCrossings run() {
    if (tree_.empty()) return std::move(found_);
    // From the top down to as many pairs of nodes as keep all threads at work; below each, one goes on by itself.
    constexpr std::size_t enough = 512, grain = 8;
    std::vector<NodePair> open{{0, 0}};
    for (std::size_t before = 0; open.size() < enough && open.size() != before;) {
      before = open.size();
      std::vector<NodePair> below;
      for (const NodePair& pair : open)
        if (are_leaves(pair))
          below.push_back(pair);
        else
          go_down(pair, below);
      open = std::move(below);
    }
    std::mutex mutex;
    core::parallel_chunks(open.size(), grain, [&](std::size_t begin, std::size_t end) {
      std::vector<NodePair> own(open.begin() + static_cast<std::ptrdiff_t>(begin),
                                open.begin() + static_cast<std::ptrdiff_t>(end));
      Noted noted;
      while (!own.empty()) {
        const NodePair pair = own.back();
        own.pop_back();
        ++noted.steps;
        if (are_leaves(pair))
          test_leaves(pair, noted);
        else
          go_down(pair, own);
      }
      const std::lock_guard lock(mutex);
      found_.pairs += noted.pairs, found_.steps += noted.steps;
      if (noted.first) found_.first = std::min(found_.first.value_or(*noted.first), *noted.first);
    });
    found_.crosses.assign(crosses_.begin(), crosses_.end());
    return std::move(found_);
  }

 private:
  struct NodePair {
    Index i, j;
  };
  /// What one task found; which triangles cross it writes down at once.
  struct Noted {
    std::size_t pairs = 0, steps = 0;
    std::optional<std::array<Index, 2>> first;
  };

  bool are_leaves(const NodePair& pair) const noexcept {
    return tree_.nodes()[pair.i].is_leaf() && tree_.nodes()[pair.j].is_leaf();
  }

  /// Adds the pairs of children that may hold crossings.
  void go_down(const NodePair& pair, std::vector<NodePair>& below) const {
    const auto [i, j] = pair;
    const Node &a = tree_.nodes()[i], &b = tree_.nodes()[j];
    if (i == j) {
      add(a.child, a.child, below), add(a.child, a.child + 1, below), add(a.child + 1, a.child + 1, below);
    } else if (b.is_leaf() || (!a.is_leaf() && a.size() > b.size())) {
      add(a.child, j, below), add(a.child + 1, j, below);
    } else {
      add(i, b.child, below), add(i, b.child + 1, below);
    }
  }

  void add(Index i, Index j, std::vector<NodePair>& below) const {
    if (i != j && (apart(node_boxes_[i], node_boxes_[j]) || (!oriented_.empty() && oriented_.apart(i, j))))
      return;
    if (!all_share_a_vertex(i, j)) below.push_back({i, j});
  }

  /// Whether every triangle of one node has a vertex that every triangle of the other has too: then none of them cross.
  bool all_share_a_vertex(std::size_t i, std::size_t j) const noexcept {
    if (i == j) return has_any(common_[i]);
    for (const Index v : common_[i])
      for (const Index w : common_[j])
        if (v != no_index && w != no_index && tree_.vertices()[v] == tree_.vertices()[w]) return true;
    return false;
  }

  void test_leaves(const NodePair& pair, Noted& noted) {
    const Node &a = tree_.nodes()[pair.i], &b = tree_.nodes()[pair.j];
    const Box& box_of_b = node_boxes_[pair.j];
    std::array<Index, TriangleTree::leaf_triangles> near;
    for (Index s = a.first; s < a.last; ++s) {
      const Box& box = triangle_boxes_[s];
      if (apart(box, box_of_b)) continue;
      std::size_t kept = 0;
      for (Index t = &a == &b ? s + 1 : b.first; t < b.last; ++t) {
        near[kept] = t;
        kept += static_cast<std::size_t>(!apart(box, triangle_boxes_[t]));
      }
      noted.steps += kept;
      const TriangleCorners corners = tree_.corners(s);
      const auto strip = oriented_.empty() ? std::nullopt : std::optional<TriangleStrip>(corners);
      for (std::size_t k = 0; k < kept; ++k) {
        if (share_a_vertex(s, near[k])) continue;
        const TriangleCorners others = tree_.corners(near[k]);
        if (!(strip && strip->apart(others)) && cross(corners, others))
          note(tree_.mesh_triangles()[s], tree_.mesh_triangles()[near[k]], noted);
      }
    }
  }

  /// Without branches as well: most near triangles pass.
  bool share_a_vertex(Index s, Index t) const noexcept {
    bool shared = false;
    for (const Index v : tree_.triangles()[s])
      for (const Index w : tree_.triangles()[t]) shared |= v == w;
    return shared;
  }

  /// Vertices that lie at one place are one.
  static bool cross(const TriangleCorners& a, const TriangleCorners& b) {
    for (const Vec3& p : a)
      for (const Vec3& q : b)
        if (p == q) return false;
    return triangles_intersect(a, b);
  }

  void note(Index s, Index t, Noted& noted) {
    ++noted.pairs;
    const std::array<Index, 2> pair{std::min(s, t), std::max(s, t)};
    noted.first = std::min(noted.first.value_or(pair), pair);
    for (const Index triangle : pair) crosses_[triangle].store(1, std::memory_order_relaxed);
  }

  const TriangleTree& tree_;
  std::vector<Box> triangle_boxes_, node_boxes_;
  std::vector<CommonVertices> common_;
  OrientedBoxes oriented_;                          ///< none for most surfaces
  std::vector<std::atomic<std::uint8_t>> crosses_;  ///< of the triangles, by whichever task
  SelfCrossings found_;
};

struct KeptCrossings {
  core::Lazy<SelfCrossings> crossings;
};

}  // namespace

const SelfCrossings& self_crossings_of(const Mesh& mesh) {
  return findings_of(mesh).get<KeptCrossings>().crossings.get(
      [&](SelfCrossings& crossings) { crossings = CrossingSearch(*tree_of(mesh)).run(); });
}

}  // namespace condyle::mesh
