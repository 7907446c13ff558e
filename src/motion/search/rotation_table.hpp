#pragma once

#include <memory>
#include <vector>

#include "condyle/pose.hpp"
#include "motion/events/cylinder_box.hpp"
#include "motion/events/rotation_event.hpp"
#include "motion/search/feature_tree.hpp"

/// The two bodies of a rotation about one axis. In coordinates (distance from the axis, height, direction) it
/// only shifts the direction, so both trees of features carry boxes in those coordinates, and "what can be
/// met, and after which angle at the earliest" is a comparison of boxes.
///
/// The table differs from the ring table of the tangential method (docs/mathematics/04-tangential-method.md), which
/// lists triangles by cells of the profile: there one vertex needs its whole circle; here whole regions of
/// both bodies are compared first, and most of the circle is never evaluated.

namespace condyle::motion {

/// Points and boxes of a feature tree about an axis, by slots. Memory for all is taken at once and not written
/// to before it is needed: a body that turns seldom needs much of it.
struct CylinderFeatures {
  std::unique_ptr<Triple<double>[]> points;
  std::unique_ptr<CylinderPoint[]> at;
  std::unique_ptr<CylinderBox[]> node_boxes, triangle_boxes;

  explicit CylinderFeatures(const FeatureTree& tree);

  /// Its corners being in place.
  void fill_box(const FeatureTree& tree, Index triangle) noexcept {
    const auto [a, b, c] = tree.triangles()[triangle];
    triangle_boxes[triangle] = box_of_triangle(points[a], at[a], points[b], at[b], points[c], at[c]);
  }
  CylinderBox vertex_box(Index vertex) const noexcept { return box_of_vertex(points[vertex], at[vertex]); }
  CylinderBox edge_box(const FeatureTree& tree, Index edge) const noexcept {
    const auto [a, b] = tree.edges()[edge];
    return box_of_edge(points[a], at[a], points[b], at[b]);
  }

  Corners corners(const FeatureTree& tree, Index triangle) const noexcept {
    const auto [a, b, c] = tree.triangles()[triangle];
    return {points[a], points[b], points[c]};
  }
};

/// A body placed about one axis, all boxes ready: for the one that rests, built once and then used from many
/// start poses and by many threads.
class RotationTable {
 public:
  /// The frame is given in the coordinates X_RT takes the mesh to: its own, or those of the other body. A
  /// ball joint wants its origin in the centre. The tree must outlive the table.
  RotationTable(const FeatureTree& tree, const AxisFrame& frame, const Pose& X_RT = Pose::Identity());

  const FeatureTree& tree() const noexcept { return *tree_; }
  const AxisFrame& frame() const noexcept { return frame_; }
  /// A point in the frame of the axis, in the coordinates that the frame is given in.
  Vec3 to_own(const Vec3& p) const noexcept { return frame_.from_axis(p); }
  const CylinderBox& node_box(Index node) const noexcept { return features_.node_boxes[node]; }
  const CylinderFeatures& features() const noexcept { return features_; }
  /// As RotatingBody's: here everything is ready.
  const CylinderFeatures& leaf_features(Index) const noexcept { return features_; }
  const Triple<double>& placed_vertex(Index vertex) const noexcept { return features_.points[vertex]; }

 private:
  const FeatureTree* tree_;
  AxisFrame frame_;
  CylinderFeatures features_;
};

/// The body that turns, at the pose from which it starts. Boxes are made when first needed, so that a new
/// pose costs only the nodes that the search visits. One per thread.
class RotatingBody {
 public:
  /// The tree must outlive this.
  explicit RotatingBody(const FeatureTree& tree);
  /// The same surface with its vertices elsewhere, one for each of the mesh's, which must outlive this: as with the tree moved there, which takes
  /// longer than one search. Boxes in the tree are taken wider by the farthest move.
  RotatingBody(const FeatureTree& tree, const Points& moved);
  /// The same with each of the mesh's vertices moved by so many times its direction, none of which is longer than `longest`: only those that
  /// searches look at are moved.
  RotatingBody(const FeatureTree& tree, const Points& directions, double longest, double by);

  /// Starts at X_RT, the pose of the rotating body T measured in the stationary body R, about the axis given in
  /// R. Prepared parts stay ready if it starts there already.
  void start_at(const AxisFrame& frame_R, const Pose& X_RT);

  const FeatureTree& tree() const noexcept { return *tree_; }
  const AxisFrame& frame() const noexcept { return frame_; }
  /// A point at the start pose, in the frame of the axis, in the body's own coordinates.
  Vec3 to_own(const Vec3& at_start) const noexcept { return inverted(X_RT_) * frame_.from_axis(at_start); }

  const CylinderBox& node_box(Index node);
  /// All features, the triangles of this leaf and their corners being ready.
  const CylinderFeatures& leaf_features(Index node);
  /// The features that are ready so far.
  const CylinderFeatures& features() const noexcept { return features_; }
  const Triple<double>& placed_vertex(Index vertex) {
    place_vertex(vertex);
    return features_.points[vertex];
  }

 private:
  void place_vertex(Index vertex);

  const FeatureTree* tree_;
  AxisFrame frame_;
  Pose X_RT_ = Pose::Identity();
  /// Sizes of the entries of the rotation from the body's own frame to that of the axis.
  Eigen::Matrix3d rotation_size_ = Eigen::Matrix3d::Zero();
  /// More than posing a box's centre and the points in it may have rounded them apart, in mm.
  double posing_slack_ = 0;
  /// No point is farther from the origin of the axis frame than from that of its own frame by more than this,
  /// nor nearer.
  double origins_apart_ = 0;
  double extent_ = 0;
  const Points *moved_ = nullptr, *directions_ = nullptr;
  double along_ = 0;     ///< times its direction each vertex is moved
  double moved_by_ = 0;  ///< no vertex is moved farther, mm
  CylinderFeatures features_;
  /// A node or vertex is ready where its mark is the number of the current pose.
  unsigned pose_number_ = 0;
  std::vector<unsigned> node_mark_, leaf_mark_, vertex_mark_;
};

/// Winding number of a closed body about the point, which is not on its surface; the point and the body at
/// the angle 0. Exact. Body is RotationTable or RotatingBody.
template <class Body>
int winding_number(Body& body, const Triple<double>& point);

}  // namespace condyle::motion
