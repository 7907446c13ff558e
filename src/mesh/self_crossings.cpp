#include "mesh/self_crossings.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "condyle/repair.hpp"
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

bool apart(const TriangleCorners& a, const TriangleCorners& b) noexcept {
  for (int k = 0; k < 3; ++k) {
    const auto [a_low, a_high] = std::minmax({a[0][k], a[1][k], a[2][k]});
    const auto [b_low, b_high] = std::minmax({b[0][k], b[1][k], b[2][k]});
    if (a_high < b_low || b_high < a_low) return true;
  }
  return false;
}

class Search {
 public:
  explicit Search(const TriMesh& mesh)
      : mesh_(mesh), tree_(mesh), place_(first_of_same_coordinates(mesh.vertices)) {
    found_.crosses.resize(mesh.triangles.size());
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
      const TriangleCorners corners = tree_.corners(s);
      for (Index t = &a == &b ? s + 1 : b.first; t < b.last; ++t) {
        const TriangleCorners others = tree_.corners(t);
        if (apart(corners, others)) continue;
        const auto [first, second] = std::minmax(tree_.mesh_triangles()[s], tree_.mesh_triangles()[t]);
        if (!share_a_vertex(first, second) && triangles_intersect(corners, others)) note(first, second);
      }
    }
  }

  bool share_a_vertex(Index s, Index t) const noexcept {
    const auto at = [&](Index v) { return place_[v]; };
    for (const Index v : mesh_.triangles[s])
      for (const Index w : mesh_.triangles[t])
        if (at(v) == at(w)) return true;
    return false;
  }

  void note(Index first, Index second) {
    ++found_.pairs;
    const std::array<Index, 2> pair{first, second};
    found_.first = std::min(found_.first.value_or(pair), pair);
    found_.crosses[first] = found_.crosses[second] = 1;
  }

  const TriMesh& mesh_;
  TriangleTree tree_;
  std::vector<Index> place_;
  SelfCrossings found_;
};

}  // namespace

SelfCrossings self_crossings(const TriMesh& mesh) {
  return Search(mesh).run();
}

}  // namespace condyle::mesh
