#include "motion/search/rotation_table.hpp"

#include <algorithm>
#include <cmath>

#include "core/predicates.hpp"
#include "mesh/vertical_ray.hpp"

namespace condyle::motion {
namespace {

using Node = FeatureTree::Node;
using Point = Triple<double>;

Point triple(const Vec3& p) noexcept {
  return {p.x(), p.y(), p.z()};
}
mesh::TriangleCorners corners_of(const CylinderFeatures& features, const FeatureTree& tree, Index triangle) {
  mesh::TriangleCorners out;
  for (std::size_t k = 0; k < 3; ++k) {
    const Point& p = features.points[tree.triangles()[triangle][k]];
    out[k] = {p.x, p.y, p.z};
  }
  return out;
}

/// Nodes of the rotating body with at most so many triangles get their box from their triangles, the others
/// from their box in the body's own frame. That costs one point and is loose, triangles cost all of theirs.
/// On a hip of 30 000 and 15 000 triangles six limits take 0.78 ms in all with 8, 0.97 ms with 16 and 1.5 ms
/// with 32; on one of 156 000 and 99 000 triangles 3.6, 3.9 and 4.3 ms.
constexpr Index tight_triangles = 8;

CylinderBox hull_of_triangles(const CylinderFeatures& features, const Node& node) noexcept {
  CylinderBox box = features.triangle_boxes[node.first];
  for (Index t = node.first + 1; t < node.last; ++t) {
    box = hull(box, features.triangle_boxes[t]);
  }
  return box;
}

}  // namespace

CylinderFeatures::CylinderFeatures(const FeatureTree& tree)
    : points(std::make_unique_for_overwrite<Point[]>(tree.vertices().size())),
      at(std::make_unique_for_overwrite<CylinderPoint[]>(tree.vertices().size())),
      node_boxes(std::make_unique_for_overwrite<CylinderBox[]>(tree.nodes().size())),
      triangle_boxes(std::make_unique_for_overwrite<CylinderBox[]>(tree.triangles().size())) {}

RotationTable::RotationTable(const FeatureTree& tree, const AxisFrame& frame, const Pose& X_RT)
    : tree_(&tree), frame_(frame), features_(tree) {
  for (std::size_t v = 0; v < tree.vertices().size(); ++v) {
    features_.points[v] = triple(frame.to_axis(posed(X_RT, tree.vertices()[v])));
    features_.at[v] = cylinder_point(features_.points[v]);
  }
  for (Index t = 0; t < tree.triangles().size(); ++t) features_.fill_box(tree, t);
  // Children come after their parent.
  for (std::size_t i = tree.nodes().size(); i-- > 0;) {
    const Node& node = tree.nodes()[i];
    features_.node_boxes[i] =
        node.is_leaf() ? hull_of_triangles(features_, node)
                       : hull(features_.node_boxes[node.child], features_.node_boxes[node.child + 1]);
  }
}

RotatingBody::RotatingBody(const FeatureTree& tree)
    : tree_(&tree),
      frame_(Vec3::Zero(), Vec3::UnitZ()),
      features_(tree),
      node_mark_(tree.nodes().size(), 0),
      leaf_mark_(tree.nodes().size(), 0),
      vertex_mark_(tree.vertices().size(), 0) {
  if (tree.empty()) return;
  const Node& root = tree.nodes().front();
  for (std::size_t k = 0; k < 3; ++k)
    extent_ = std::max(extent_, static_cast<double>(std::abs(root.centre[k])) + root.half[k]);
}

RotatingBody::RotatingBody(const FeatureTree& tree, const Points& moved) : RotatingBody(tree) {
  moved_ = &moved;
  double farthest = 0;
  for (Index v = 0; v < tree.vertices().size(); ++v)
    farthest = std::max(farthest, (moved[tree.mesh_vertex(v)] - tree.vertices()[v]).squaredNorm());
  // More than the roundings of the sum and of the root.
  moved_by_ = std::sqrt(farthest) * (1 + 1e-12);
  extent_ += moved_by_;
}

RotatingBody::RotatingBody(const FeatureTree& tree, const Points& directions, double longest, double by)
    : RotatingBody(tree) {
  directions_ = &directions, along_ = by;
  moved_by_ = std::abs(by) * longest * (1 + 1e-12);
  extent_ += moved_by_;
}

void RotatingBody::start_at(const AxisFrame& frame_R, const Pose& X_RT) {
  const bool as_before = pose_number_ > 0 && frame_R.rotation() == frame_.rotation() &&
                         frame_R.point() == frame_.point() && X_RT.matrix() == X_RT_.matrix();
  if (as_before) return;
  frame_ = frame_R;
  X_RT_ = X_RT;
  rotation_size_ = (frame_R.rotation() * X_RT.linear()).cwiseAbs();
  // Two changes of frame, each three products and three sums of numbers of this size, for the centre and for
  // the point.
  const double size = 3 * extent_ + X_RT.translation().lpNorm<1>() + frame_R.point().lpNorm<1>();
  posing_slack_ = 64 * core::rounding_unit * size;
  origins_apart_ = (X_RT.translation() - frame_R.point()).norm() + posing_slack_;
  if (++pose_number_ == 0) {
    for (auto* marks : {&node_mark_, &leaf_mark_, &vertex_mark_}) std::fill(marks->begin(), marks->end(), 0u);
    pose_number_ = 1;
  }
}

void RotatingBody::place_vertex(Index vertex) {
  if (vertex_mark_[vertex] == pose_number_) return;
  vertex_mark_[vertex] = pose_number_;
  Vec3 own = moved_ ? Vec3((*moved_)[tree_->mesh_vertex(vertex)]) : tree_->vertices()[vertex];
  if (directions_) own += along_ * (*directions_)[tree_->mesh_vertex(vertex)];
  const Point p = triple(frame_.to_axis(posed(X_RT_, own)));
  features_.points[vertex] = p;
  features_.at[vertex] = cylinder_point(p);
}

const CylinderBox& RotatingBody::node_box(Index i) {
  auto& box = features_.node_boxes[i];
  if (node_mark_[i] == pose_number_) return box;
  node_mark_[i] = pose_number_;
  const Node& node = tree_->nodes()[i];
  if (node.is_leaf()) {
    leaf_features(i);
    box = hull_of_triangles(features_, node);
  } else if (node.last - node.first <= tight_triangles) {
    box = hull(node_box(node.child), node_box(node.child + 1));
  } else {
    const auto vec3 = [](const std::array<float, 4>& v) { return Vec3(v[0], v[1], v[2]); };
    const Vec3 centre = frame_.to_axis(posed(X_RT_, vec3(node.centre)));
    const Vec3 half = rotation_size_ * vec3(node.half) + Vec3::Constant(posing_slack_ + moved_by_);
    box = box_of_box(triple(centre), triple(half));
    box.r_lo = std::max(box.r_lo, node.nearest - origins_apart_ - moved_by_);
    box.r_hi = std::min(box.r_hi, node.farthest + origins_apart_ + moved_by_);
  }
  return box;
}

const CylinderFeatures& RotatingBody::leaf_features(Index i) {
  if (leaf_mark_[i] != pose_number_) {
    leaf_mark_[i] = pose_number_;
    const Node& leaf = tree_->nodes()[i];
    for (Index t = leaf.first; t < leaf.last; ++t) {
      for (const Index v : tree_->triangles()[t]) place_vertex(v);
      features_.fill_box(*tree_, t);
    }
  }
  return features_;
}

template <class Body>
int winding_number(Body& body, const Triple<double>& point) {
  const FeatureTree& tree = body.tree();
  if (tree.empty()) return 0;
  const CylinderBox column = box_of_vertex(point, cylinder_point(point));
  const auto above = [&](const CylinderBox& box) {
    return box.rho_lo <= column.rho_hi && column.rho_lo <= box.rho_hi && box.z_hi >= point.z &&
           arcs_meet(box, column);
  };
  int winding = 0;
  std::vector<Index> open = {0};
  while (!open.empty()) {
    const Index i = open.back();
    open.pop_back();
    if (!above(body.node_box(i))) continue;
    const Node& node = tree.nodes()[i];
    if (!node.is_leaf()) {
      open.push_back(node.child);
      open.push_back(node.child + 1);
      continue;
    }
    const auto& features = body.leaf_features(i);
    for (Index t = node.first; t < node.last; ++t)
      winding += mesh::crossing_above(corners_of(features, tree, t), {point.x, point.y, point.z});
  }
  return winding;
}

template int winding_number<const RotationTable>(const RotationTable&, const Triple<double>&);
template int winding_number<RotatingBody>(RotatingBody&, const Triple<double>&);

}  // namespace condyle::motion
