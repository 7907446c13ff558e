#include "contact/body_pair.hpp"

#include <algorithm>

#include "contact/placed_trees.hpp"
#include "mesh/triangle_intersection.hpp"
#include "mesh/vertical_ray.hpp"

namespace condyle::contact {
namespace {

using Node = mesh::TriangleTree::Node;

struct Box {
  Vec3 low, high;

  static Box of(const mesh::TriangleCorners& t) noexcept {
    return {t[0].cwiseMin(t[1]).cwiseMin(t[2]), t[0].cwiseMax(t[1]).cwiseMax(t[2])};
  }
  /// Without branches: which axis tells two boxes apart is anybody's guess.
  bool meets(const Box& other) const noexcept {
    const Vec3 gap = (low - other.high).cwiseMax(other.low - high);
    return std::max(std::max(gap.x(), gap.y()), gap.z()) <= 0;
  }
};

mesh::TriangleCorners posed_corners(const mesh::TriangleTree& tree, Index triangle, const Pose& X) {
  const mesh::TriangleCorners t = tree.corners(triangle);
  return {posed(X, t[0]), posed(X, t[1]), posed(X, t[2])};
}

/// Triangles of a leaf in F.
struct LeafTriangles {
  Index leaf = no_index, count = 0;
  std::array<mesh::TriangleCorners, mesh::TriangleTree::leaf_triangles> corners;
  std::array<Box, mesh::TriangleTree::leaf_triangles> boxes;

  /// Does nothing where it is this leaf already: in a row of pairs one of the two often is.
  template <class CornersOf>
  void take(Index number, const Node& node, const CornersOf& corners_of) {
    if (leaf == number) return;
    leaf = number, count = node.last - node.first;
    for (Index i = 0; i < count; ++i) {
      corners[i] = corners_of(node.first + i);
      boxes[i] = Box::of(corners[i]);
    }
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
    for (Index i = 0; i < in_fixed.count; ++i) {
      for (Index j = 0; j < in_mobile.count; ++j) {
        if (in_fixed.boxes[i].meets(in_mobile.boxes[j]) &&
            mesh::triangles_intersect(in_fixed.corners[i], in_mobile.corners[j]) &&
            visit(f.first + i, m.first + j))
          return true;
      }
    }
    return false;
  });
}

/// Sum of the crossings above p of the tree's triangles: `box_of` tells where a node may be, `corners_of`
/// where a triangle is.
template <class BoxOf, class CornersOf>
int winding_number(const mesh::TriangleTree& tree, const Vec3& p, const BoxOf& box_of,
                   const CornersOf& corners_of) {
  int winding = 0;
  std::vector<Index> open = {0};
  while (!open.empty()) {
    const Index i = open.back();
    open.pop_back();
    const Node& node = tree.nodes()[i];
    const auto box = box_of(node);
    const auto beyond = [&](int axis) { return std::abs(p[axis] - box.centre[axis]) > box.half[axis]; };
    if (beyond(0) || beyond(1) || p.z() - box.centre[2] > box.half[2]) continue;
    if (!node.is_leaf()) {
      open.push_back(node.child);
      open.push_back(node.child + 1);
      continue;
    }
    for (Index t = node.first; t < node.last; ++t) winding += mesh::crossing_above(corners_of(t), p);
  }
  return winding;
}

}  // namespace

BodyPair::Body::Body(const Mesh& mesh)
    : tree(mesh),
      is_closed(mesh.is_closed()),
      place_of_triangle(mesh.triangles().size()),
      piece_vertices(tree.one_vertex_of_each_piece()) {
  for (Index place = 0; place < place_of_triangle.size(); ++place)
    place_of_triangle[tree.mesh_triangles()[place]] = place;
}

BodyPair::BodyPair(const Mesh& fixed, const Mesh& mobile) : fixed_(fixed), mobile_(mobile) {}

bool BodyPair::touch(const Pose& X_FM, std::optional<TrianglePair>& last_witness) const {
  if (last_witness) {
    const Index f = fixed_.place_of_triangle[last_witness->fixed],
                m = mobile_.place_of_triangle[last_witness->mobile];
    if (mesh::triangles_intersect(fixed_.tree.corners(f), posed_corners(mobile_.tree, m, X_FM))) return true;
  }
  bool hit = false;
  visit_meeting_pairs(fixed_.tree, mobile_.tree, X_FM, [&](Index f, Index m) {
    last_witness = {fixed_.tree.mesh_triangles()[f], mobile_.tree.mesh_triangles()[m]};
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
  visit_meeting_pairs(fixed_.tree, mobile_.tree, X_FM, [&](Index f, Index m) {
    pairs.push_back({fixed_.tree.mesh_triangles()[f], mobile_.tree.mesh_triangles()[m]});
    return false;
  });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// Surfaces that do not meet: a connected piece is inside the other solid with every vertex or with none.
bool BodyPair::one_inside_other(const Pose& X_FM) const {
  const mesh::TriangleTree &fixed = fixed_.tree, &mobile = mobile_.tree;
  const auto in_fixed = [&](Index v) {
    return winding_number(
               fixed, posed(X_FM, mobile.vertices()[v]), [](const Node& node) { return node; },
               [&](Index t) { return fixed.corners(t); }) > 0;
  };
  const PlacedTrees placed(fixed, mobile, X_FM);
  const auto in_mobile = [&](Index v) {
    return winding_number(
               mobile, fixed.vertices()[v], [&](const Node& node) { return placed.mobile_in_fixed(node); },
               [&](Index t) { return posed_corners(mobile, t, X_FM); }) > 0;
  };
  const auto any = [](const std::vector<Index>& vertices, const auto& inside) {
    return std::any_of(vertices.begin(), vertices.end(), inside);
  };
  return (fixed_.is_closed && !fixed.empty() && any(mobile_.piece_vertices, in_fixed)) ||
         (mobile_.is_closed && !mobile.empty() && any(fixed_.piece_vertices, in_mobile));
}

}  // namespace condyle::contact
