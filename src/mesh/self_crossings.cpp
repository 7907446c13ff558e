#include "mesh/self_crossings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "condyle/repair.hpp"
#include "core/float_bounds.hpp"
#include "core/lazy.hpp"
#include "mesh/findings.hpp"
#include "mesh/triangle_intersection.hpp"
#include "mesh/triangle_tree.hpp"

namespace condyle::mesh {
namespace {

using Node = TriangleTree::Node;

/// Nodes are rounded outwards; the sums here are in double and lose nothing of that.
bool apart(const Node& a, const Node& b) noexcept {
  for (std::size_t k = 0; k < 3; ++k)
    if (std::abs(double{a.centre[k]} - double{b.centre[k]}) > double{a.half[k]} + double{b.half[k]})
      return true;
  return false;
}

/// Boxes of all triangles in the order of the tree, in single precision and no smaller than what they hold. Those of a leaf
/// stand side by side and are compared at once.
class TriangleBoxes {
 public:
  static constexpr Index at_once = TriangleTree::leaf_triangles;

  explicit TriangleBoxes(const TriangleTree& tree) {
    const std::size_t count = tree.triangles().size();
    for (std::size_t k = 0; k < 3; ++k) {
      // The last leaf is read as if it were full.
      low_[k].resize(count + at_once), high_[k].resize(count + at_once);
      const auto axis = static_cast<int>(k);
      for (std::size_t t = 0; t < count; ++t) {
        const TriangleCorners c = tree.corners(static_cast<Index>(t));
        low_[k][t] = core::float_below(std::min(std::min(c[0][axis], c[1][axis]), c[2][axis]));
        high_[k][t] = core::float_above(std::max(std::max(c[0][axis], c[1][axis]), c[2][axis]));
      }
    }
  }

  bool apart(Index s, const Node& node) const noexcept {
    for (std::size_t k = 0; k < 3; ++k)
      if (double{low_[k][s]} - double{node.centre[k]} > double{node.half[k]} ||
          double{node.centre[k]} - double{high_[k][s]} > double{node.half[k]})
        return true;
    return false;
  }

  /// By how much triangle s is apart from those from `first` on, above 0. Without branches.
  std::array<float, at_once> apart(Index s, Index first) const noexcept {
    std::array<float, at_once> out;
    const auto along = [&](std::size_t k, std::size_t i) {
      return std::max(low_[k][first + i] - high_[k][s], low_[k][s] - high_[k][first + i]);
    };
    for (std::size_t i = 0; i < at_once; ++i)
      out[i] = std::max(std::max(along(0, i), along(1, i)), along(2, i));
    return out;
  }

 private:
  std::array<std::vector<float>, 3> low_, high_;
};

class Search {
 public:
  Search(const TriMesh& mesh, const TriangleTree& tree) : tree_(tree), boxes_(tree) {
    found_.crosses.resize(mesh.triangles.size());
    const std::vector<Index> first = first_of_same_coordinates(mesh.vertices);
    places_.reserve(tree.triangles().size());
    for (const Index t : tree.mesh_triangles()) {
      const auto [a, b, c] = mesh.triangles[t];
      places_.push_back({first[a], first[b], first[c]});
    }
  }

  SelfCrossings run() {
    if (tree_.empty()) return std::move(found_);
    std::vector<std::pair<Index, Index>> open{{0, 0}};
    while (!open.empty()) {
      const auto [i, j] = open.back();
      open.pop_back();
      const Node &a = tree_.nodes()[i], &b = tree_.nodes()[j];
      if (i != j && apart(a, b)) continue;
      if (a.is_leaf() && b.is_leaf()) {
        look_at(a, b);
      } else if (i == j) {
        open.insert(open.end(), {{a.child, a.child}, {a.child, a.child + 1}, {a.child + 1, a.child + 1}});
      } else if (b.is_leaf() || (!a.is_leaf() && a.size() > b.size())) {
        open.insert(open.end(), {{a.child, j}, {a.child + 1, j}});
      } else {
        open.insert(open.end(), {{i, b.child}, {i, b.child + 1}});
      }
    }
    return std::move(found_);
  }

 private:
  void look_at(const Node& a, const Node& b) {
    for (Index s = a.first; s < a.last; ++s) {
      if (boxes_.apart(s, b)) continue;
      const auto apart_by = boxes_.apart(s, b.first);
      for (Index t = &a == &b ? s + 1 : b.first; t < b.last; ++t)
        if (!(apart_by[t - b.first] > 0) && !share_a_vertex(s, t) &&
            triangles_intersect(tree_.corners(s), tree_.corners(t)))
          note(tree_.mesh_triangles()[s], tree_.mesh_triangles()[t]);
    }
  }

  bool share_a_vertex(Index s, Index t) const noexcept {
    for (const Index v : places_[s])
      for (const Index w : places_[t])
        if (v == w) return true;
    return false;
  }

  void note(Index s, Index t) {
    ++found_.pairs;
    const std::array<Index, 2> pair{std::min(s, t), std::max(s, t)};
    found_.first = std::min(found_.first.value_or(pair), pair);
    found_.crosses[s] = found_.crosses[t] = 1;
  }

  const TriangleTree& tree_;
  TriangleBoxes boxes_;
  std::vector<Triangle> places_;  ///< of the corners: the first vertex that lies there
  SelfCrossings found_;
};

struct KeptCrossings {
  core::Lazy<SelfCrossings> crossings;
};

}  // namespace

const SelfCrossings& self_crossings_of(const Mesh& mesh) {
  return findings_of(mesh).get<KeptCrossings>().crossings.get(
      [&](SelfCrossings& crossings) { crossings = Search(mesh, *tree_of(mesh)).run(); });
}

}  // namespace condyle::mesh
