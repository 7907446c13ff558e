#include "contact/body_pair.hpp"

#include <algorithm>
#include <utility>

#include "contact/placed_trees.hpp"
#include "core/float_bounds.hpp"
#include "mesh/disjoint_sets.hpp"
#include "mesh/triangle_intersection.hpp"
#include "mesh/vertical_ray.hpp"

namespace condyle::contact {
namespace {

using Node = mesh::TriangleTree::Node;

/// In single precision, no smaller than what it holds.
struct Box {
  std::array<float, 3> low, high;
};

/// Some boxes, compared with another one at once.
class Boxes {
 public:
  static constexpr Index most = mesh::TriangleTree::leaf_triangles;

  void set(Index i, const mesh::TriangleCorners& t) noexcept {
    for (int k = 0; k < 3; ++k) {
      low_[k][i] = core::float_below(std::min(std::min(t[0][k], t[1][k]), t[2][k]));
      high_[k][i] = core::float_above(std::max(std::max(t[0][k], t[1][k]), t[2][k]));
    }
  }
  Box operator[](Index i) const noexcept {
    return {{low_[0][i], low_[1][i], low_[2][i]}, {high_[0][i], high_[1][i], high_[2][i]}};
  }
  Box of_all(Index count) const noexcept {
    Box all = (*this)[0];
    for (Index i = 1; i < count; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        all.low[k] = std::min(all.low[k], low_[k][i]);
        all.high[k] = std::max(all.high[k], high_[k][i]);
      }
    }
    return all;
  }

  /// By how much each is apart from another box, above 0; a NaN may meet. Without branches: no branch predicts which
  /// axis separates two boxes.
  std::array<float, most> apart_from(const Box& other) const noexcept {
    std::array<float, most> apart;
    const auto along = [&](std::size_t k, std::size_t i) {
      return std::max(low_[k][i] - other.high[k], other.low[k] - high_[k][i]);
    };
    for (std::size_t i = 0; i < most; ++i)
      apart[i] = std::max(std::max(along(0, i), along(1, i)), along(2, i));
    return apart;
  }

 private:
  alignas(32) float low_[3][most] = {}, high_[3][most] = {};
};

mesh::TriangleCorners posed_corners(const mesh::TriangleTree& tree, Index triangle, const Pose& X) {
  const mesh::TriangleCorners t = tree.corners(triangle);
  return {posed(X, t[0]), posed(X, t[1]), posed(X, t[2])};
}

/// Triangles of a leaf in F.
struct LeafTriangles {
  Index leaf = no_index, count = 0;
  std::array<mesh::TriangleCorners, Boxes::most> corners;
  Boxes boxes;
  Box box;  ///< of all

  /// Does nothing if it is this leaf already: in a row of pairs one of the two is often unchanged.
  template <class CornersOf>
  void take(Index number, const Node& node, const CornersOf& corners_of) {
    if (leaf == number) return;
    leaf = number, count = node.last - node.first;
    for (Index i = 0; i < count; ++i) {
      corners[i] = corners_of(node.first + i);
      boxes.set(i, corners[i]);
    }
    box = boxes.of_all(count);
  }
};

/// visit(fixed, mobile), by places, for each pair of triangles that meet, until one returns true.
template <class Visit>
void visit_meeting_pairs(const mesh::TriangleTree& fixed, const mesh::TriangleTree& mobile, const Pose& X_FM,
                         const Visit& visit) {
  LeafTriangles in_fixed, in_mobile;
  PlacedTrees(fixed, mobile, X_FM).visit_leaf_pairs([&](Index fixed_leaf, Index mobile_leaf) {
    const Node &f = fixed.nodes()[fixed_leaf], &m = mobile.nodes()[mobile_leaf];
    in_fixed.take(fixed_leaf, f, [&](Index t) { return fixed.corners(t); });
    in_mobile.take(mobile_leaf, m, [&](Index t) { return posed_corners(mobile, t, X_FM); });
    const auto from_mobile = in_fixed.boxes.apart_from(in_mobile.box);
    for (Index i = 0; i < in_fixed.count; ++i) {
      if (from_mobile[i] > 0) continue;
      const auto from_fixed = in_mobile.boxes.apart_from(in_fixed.boxes[i]);
      for (Index j = 0; j < in_mobile.count; ++j) {
        if (!(from_fixed[j] > 0) && mesh::triangles_intersect(in_fixed.corners[i], in_mobile.corners[j]) &&
            visit(f.first + i, m.first + j))
          return true;
      }
    }
    return false;
  });
}

/// Points in F against the solids of both bodies.
class PlacedSolids {
 public:
  PlacedSolids(const mesh::TriangleTree& fixed, const mesh::TriangleTree& mobile, const Pose& X_FM)
      : fixed_(fixed), mobile_(mobile), X_FM_(X_FM), placed_(fixed, mobile, X_FM) {}

  const PlacedTrees& placed() const noexcept { return placed_; }

  bool holds(BodyRole body, const Vec3& p) const {
    const auto corners_of_fixed = [&](Index t) { return fixed_.corners(t); };
    const auto corners_of_mobile = [&](Index t) { return posed_corners(mobile_, t, X_FM_); };
    const auto box_of_fixed = [](const Node& node) { return node; };
    const auto box_of_mobile = [&](const Node& node) { return placed_.mobile_in_fixed(node); };
    return (body == BodyRole::fixed ? mesh::winding_number(fixed_, p, box_of_fixed, corners_of_fixed)
                                    : mesh::winding_number(mobile_, p, box_of_mobile, corners_of_mobile)) > 0;
  }

 private:
  const mesh::TriangleTree &fixed_, &mobile_;
  const Pose& X_FM_;
  PlacedTrees placed_;
};

}  // namespace

BodyPair::Body::Body(const Mesh& mesh) : tree(mesh::tree_of(mesh)), is_closed(mesh.is_closed()) {}

const std::vector<Index>& BodyPair::Body::place_of_triangle() const {
  return place_of_triangle_.get([&](std::vector<Index>& places) {
    places.resize(tree->triangles().size());
    for (Index place = 0; place < places.size(); ++place) places[tree->mesh_triangles()[place]] = place;
  });
}

void BodyPair::Body::update(const Mesh& mesh, std::span<const char> is_moved) {
  // Held twice here; a third holder is a copy of this pair.
  if (!refitted || refitted.use_count() > 2) refitted = std::make_shared<mesh::TriangleTree>(*tree);
  tree = refitted;
  refitted->refit(mesh.vertices(), is_moved);
  if (!refitted->is_worn()) return;
  *refitted = mesh::TriangleTree(mesh);
  place_of_triangle_.make_out_of_date();
}

void BodyPair::update(BodyRole body, const Mesh& mesh, std::span<const char> is_moved) {
  (body == BodyRole::fixed ? fixed_ : mobile_).update(mesh, is_moved);
}

BodyPair::BodyPair(const Mesh& fixed, const Mesh& mobile) : fixed_(fixed), mobile_(mobile) {}

bool BodyPair::touch(const Pose& X_FM, std::optional<TrianglePair>& last_witness) const {
  if (last_witness) {
    const Index f = fixed_.place_of_triangle()[last_witness->fixed],
                m = mobile_.place_of_triangle()[last_witness->mobile];
    if (mesh::triangles_intersect(fixed_.tree->corners(f), posed_corners(*mobile_.tree, m, X_FM)))
      return true;
  }
  bool hit = false;
  visit_meeting_pairs(*fixed_.tree, *mobile_.tree, X_FM, [&](Index f, Index m) {
    last_witness = {fixed_.tree->mesh_triangles()[f], mobile_.tree->mesh_triangles()[m]};
    return hit = true;
  });
  return hit || one_inside_other(X_FM);
}

bool BodyPair::touch(const Pose& X_FM) const {
  std::optional<TrianglePair> none;
  return touch(X_FM, none);
}

std::vector<TrianglePair> BodyPair::pairs(const Pose& X_FM) const {
  std::vector<TrianglePair> pairs;
  visit_meeting_pairs(*fixed_.tree, *mobile_.tree, X_FM, [&](Index f, Index m) {
    pairs.push_back({fixed_.tree->mesh_triangles()[f], mobile_.tree->mesh_triangles()[m]});
    return false;
  });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// Surfaces that do not meet: a connected piece is inside the other solid with every vertex or with none.
bool BodyPair::one_inside_other(const Pose& X_FM) const {
  const mesh::TriangleTree &fixed = *fixed_.tree, &mobile = *mobile_.tree;
  const PlacedSolids solids(fixed, mobile, X_FM);
  const auto in_fixed = [&](Index v) {
    return solids.holds(BodyRole::fixed, posed(X_FM, mobile.vertices()[v]));
  };
  const auto in_mobile = [&](Index v) { return solids.holds(BodyRole::mobile, fixed.vertices()[v]); };
  const auto any = [](const std::vector<Index>& vertices, const auto& inside) {
    return std::any_of(vertices.begin(), vertices.end(), inside);
  };
  return (fixed_.is_closed && !fixed.empty() && any(mobile.one_vertex_of_each_piece(), in_fixed)) ||
         (mobile_.is_closed && !mobile.empty() && any(fixed.one_vertex_of_each_piece(), in_mobile));
}

/// A triangle that meets nothing is inside with every corner or with none: corners that such triangles connect are inside together. What is inside
/// is connected with a corner of a triangle that meets something, or is a piece by itself.
Reaching BodyPair::reaching(BodyRole body, const Pose& X_FM, std::span<const TrianglePair> pairs) const {
  const bool is_fixed = body == BodyRole::fixed;
  const Body& own = is_fixed ? fixed_ : mobile_;
  const BodyRole other = is_fixed ? BodyRole::mobile : BodyRole::fixed;
  const PlacedSolids solids(*fixed_.tree, *mobile_.tree, X_FM);
  const std::span<const Triangle> triangles = own.tree->triangles();
  const std::span<const Vec3> vertices = own.tree->vertices();
  std::vector<char> in_pairs(triangles.size());  // in the mesh's order
  for (const TrianglePair& pair : pairs) in_pairs[is_fixed ? pair.fixed : pair.mobile] = true;
  const auto meets = [&](Index t) { return in_pairs[own.tree->mesh_triangles()[t]]; };
  std::vector<Index> at_other, to_look_at = own.tree->one_vertex_of_each_piece();
  mesh::DisjointSets connected(vertices.size());
  solids.placed().visit_leaves_at_other(body, [&](const Node& leaf) {
    for (Index t = leaf.first; t < leaf.last; ++t) {
      at_other.push_back(t);
      const auto [a, b, c] = triangles[t];
      if (meets(t))
        to_look_at.insert(to_look_at.end(), {a, b, c});
      else
        connected.join(a, b), connected.join(b, c);
    }
  });
  std::vector<char> is_seen(vertices.size()), is_inside(vertices.size());  // of connected ones, the first's
  for (const Index v : to_look_at) {
    char& is_set_inside = is_inside[connected.find(v)];
    if (is_set_inside || std::exchange(is_seen[v], true)) continue;
    is_set_inside = solids.holds(other, is_fixed ? vertices[v] : posed(X_FM, vertices[v]));
  }
  std::erase_if(at_other, [&](Index t) { return !meets(t) && !is_inside[connected.find(triangles[t][0])]; });
  Reaching reaching{std::move(at_other), {}};
  for (const Index t : reaching.places) reaching.meets.push_back(meets(t));
  return reaching;
}

}  // namespace condyle::contact
