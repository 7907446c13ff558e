#include "motion/search/first_contact.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <tuple>
#include <vector>

#include "motion/search/node_pairs.hpp"
#include "motion/search/start_contact.hpp"

namespace condyle::motion {
namespace {

using Node = FeatureTree::Node;
using Point = Triple<double>;

Vec3 vec3(const Point& p) noexcept {
  return {p.x, p.y, p.z};
}

/// Added to the best angle when regions are left out: more than any touch's error and the slack of all boxes,
/// so that whether a pair is looked at never decides between pairs that touch at the same angle.
constexpr double keep_ties = 1e-10;

/// A pair of features by places, ordered as it was found to touch.
struct Found {
  double angle;  ///< Size of the turn, less its error: never past the true one.
  double error;
  FeaturePair features;
  FeatureKind turning_kind, resting_kind;
  Index turning, resting;
};

Feature vertex_feature(const FeatureTree& tree, Index place) {
  return {FeatureKind::vertex, tree.mesh_vertex(place)};
}
Feature edge_feature(const FeatureTree& tree, Index place) {
  const auto [a, b] = tree.edges()[place];
  return {FeatureKind::edge, tree.mesh_vertex(a), tree.mesh_vertex(b)};
}
Feature face_feature(const FeatureTree& tree, Index place) {
  return {FeatureKind::face, tree.mesh_triangle(place)};
}

Feature feature(const FeatureTree& tree, FeatureKind kind, Index place) {
  switch (kind) {
    case FeatureKind::vertex:
      return vertex_feature(tree, place);
    case FeatureKind::edge:
      return edge_feature(tree, place);
    case FeatureKind::face:
      break;
  }
  return face_feature(tree, place);
}

/// Depth first, nearest first: the first contact found is usually the true one, and bounds the rest.
class Search {
 public:
  Search(const RotationTable& resting, TurningBody& turning, TurnDirection direction, double range,
         TurnWork& work)
      : resting_(resting), turning_(turning), direction_(direction), best_angle_(range), work_(work) {
    narrow_window();
  }

  const std::optional<Found>& run() {
    push(0, 0);
    while (!open_.empty()) {
      const NodePair pair = open_.back();
      open_.pop_back();
      if (pair.gap > reach_) continue;
      const Node &m = turning_.tree().nodes()[pair.turning], &f = resting_.tree().nodes()[pair.resting];
      if (m.is_leaf() && f.is_leaf()) {
        compare_leaves(pair, m, f);
      } else {
        const std::size_t before = open_.size();
        split(turning_.tree(), resting_.tree(), pair, [&](Index a, Index b) { push(a, b); });
        if (open_.size() == before + 2 && open_[before].gap < open_[before + 1].gap) {
          std::swap(open_[before], open_[before + 1]);
        }
      }
    }
    return found_;
  }

 private:
  void push(Index turning, Index resting) {
    ++work_.node_pairs;
    const CylinderBox &m = turning_.node_box(turning), &f = resting_.node_box(resting);
    if (!m.shares_profile(f)) return;
    const double gap = gap_in_turn(m, f, direction_);
    if (gap <= reach_) open_.push_back({turning, resting, gap});
  }

  bool within_reach(const CylinderBox& turning, const CylinderBox& resting) const noexcept {
    return turning.shares_profile(resting) && gap_in_turn(turning, resting, direction_) <= reach_;
  }

  /// A feature is in the box of the triangle that it belongs to: most triangles of a leaf are out of reach of
  /// the whole other leaf, and most pairs of the rest are out of each other's, so that few features are
  /// compared one by one.
  void compare_leaves(const NodePair& pair, const Node& m, const Node& f) {
    ++work_.leaf_pairs;
    const CylinderBox &m_leaf = turning_.node_box(pair.turning), &f_leaf = resting_.node_box(pair.resting);
    const CylinderFeatures &mf = turning_.leaf_features(pair.turning), &ff = resting_.features();
    std::array<Index, mesh::TriangleTree::leaf_triangles> near{};
    std::size_t count = 0;
    for (Index t = f.first; t < f.last; ++t) {
      if (within_reach(m_leaf, ff.triangle_boxes[t])) near[count++] = t;
    }
    for (Index s = m.first; s < m.last && count > 0; ++s) {
      if (!within_reach(mf.triangle_boxes[s], f_leaf)) continue;
      for (std::size_t i = 0; i < count; ++i) {
        if (within_reach(mf.triangle_boxes[s], ff.triangle_boxes[near[i]])) compare_triangles(s, near[i]);
      }
    }
  }

  /// The two faces, and the vertices and edges that belong to them.
  void compare_triangles(Index s, Index t) {
    const FeatureTree &mt = turning_.tree(), &ft = resting_.tree();
    const CylinderFeatures &mf = turning_.features(), &ff = resting_.features();
    const auto m_vertices = mt.vertices_of(s), f_vertices = ft.vertices_of(t);
    for (Index v = m_vertices.first; v < m_vertices.last; ++v) {
      if (!within_reach(mf.vertex_box(v), ff.triangle_boxes[t])) continue;
      record(vertex_meets_face(mf.points[v], ff.corners(ft, t), window_), FeatureKind::vertex, v,
             FeatureKind::face, t);
    }
    for (Index v = f_vertices.first; v < f_vertices.last; ++v) {
      if (!within_reach(mf.triangle_boxes[s], ff.vertex_box(v))) continue;
      record(face_meets_vertex(mf.corners(mt, s), ff.points[v], window_), FeatureKind::face, s,
             FeatureKind::vertex, v);
    }
    const auto m_edges = mt.edges_of(s), f_edges = ft.edges_of(t);
    for (Index e = m_edges.first; e < m_edges.last; ++e) {
      const CylinderBox box = mf.edge_box(mt, e);
      if (!within_reach(box, ff.triangle_boxes[t])) continue;
      const auto [a, b] = mt.edges()[e];
      for (Index g = f_edges.first; g < f_edges.last; ++g) {
        if (!within_reach(box, ff.edge_box(ft, g))) continue;
        const auto [c, d] = ft.edges()[g];
        record(edges_meet(mf.points[a], mf.points[b], ff.points[c], ff.points[d], window_), FeatureKind::edge,
               e, FeatureKind::edge, g);
      }
    }
  }

  void record(const Touches& touches, FeatureKind turning_kind, Index turning, FeatureKind resting_kind,
              Index resting) {
    ++work_.events;
    work_.exact_decisions += touches.exact_decisions;
    for (const Touch& touch : touches) {
      const double size = direction_ == TurnDirection::positive ? touch.angle : two_pi - touch.angle;
      const double angle = std::max(0.0, size - touch.error);
      if (angle > best_angle_) continue;
      const FeaturePair features{feature(turning_.tree(), turning_kind, turning),
                                 feature(resting_.tree(), resting_kind, resting)};
      if (found_ && std::tie(found_->angle, found_->features) <= std::tie(angle, features)) continue;
      found_ = Found{angle, touch.error, features, turning_kind, resting_kind, turning, resting};
      best_angle_ = angle;
      narrow_window();
    }
  }

  void narrow_window() {
    reach_ = best_angle_ + keep_ties;
    window_ =
        direction_ == TurnDirection::positive ? TurnWindow::forward(reach_) : TurnWindow::backward(reach_);
  }

  const RotationTable& resting_;
  TurningBody& turning_;
  TurnDirection direction_;
  double best_angle_;
  double reach_ = 0;
  TurnWindow window_;
  TurnWork& work_;
  std::vector<NodePair> open_;
  std::optional<Found> found_;
};

Vec3 about_axis(const Vec3& p, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * p.x() - s * p.y(), s * p.x() + c * p.y(), p.z()};
}

/// The point of edge a b nearest to the line through c and d; a where the two are parallel.
Vec3 nearest_to_line(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a, across = u.cross(d - c);
  const double size = across.squaredNorm();
  const double s = size > 0 ? (c - a).cross(d - c).dot(across) / size : 0;
  return a + std::clamp(s, 0.0, 1.0) * u;
}

/// Where the two features touch after the turn: as a point of either body in its own frame.
TouchingFeatures touching(const RotationTable& resting, TurningBody& turning, const Found& found,
                          double turn) {
  const auto on_turning = [&](Index v) { return about_axis(vec3(turning.placed_vertex(v)), turn); };
  const auto on_resting = [&](Index v) { return vec3(resting.features().points[v]); };
  Vec3 m, f;
  if (found.turning_kind == FeatureKind::vertex) {
    m = f = on_turning(found.turning);
  } else if (found.resting_kind == FeatureKind::vertex) {
    m = f = on_resting(found.resting);
  } else {
    const auto [pa, pb] = turning.tree().edges()[found.turning];
    const auto [pc, pd] = resting.tree().edges()[found.resting];
    const Vec3 a = on_turning(pa), b = on_turning(pb), c = on_resting(pc), d = on_resting(pd);
    m = nearest_to_line(a, b, c, d), f = nearest_to_line(c, d, a, b);
  }
  return {found.features, turning.to_own(about_axis(m, -turn)), resting.frame().from_axis(f)};
}

Limit limit_in(TurnDirection direction, double range, const RotationTable& resting, TurningBody& turning,
               TurnWork& work) {
  const double sign = static_cast<double>(direction);
  std::optional<Found> found;
  if (range > 0) found = Search(resting, turning, direction, range, work).run();
  if (!found) return {Angle::radians(sign * range), LimitReason::end_of_range, std::nullopt, Angle()};
  const double turn = sign * found->angle;
  return {Angle::radians(turn), LimitReason::contact, touching(resting, turning, *found, turn),
          Angle::radians(2 * found->error)};
}

TurnLimits both(const Limit& limit, const TurnWork& work) {
  return {limit, limit, work};
}

}  // namespace

TurnLimits first_contact(const RotationTable& resting, TurningBody& turning, const TurnRange& range) {
  assert(range.negative.radians() <= 0 && range.positive.radians() >= 0);
  assert(range.negative.radians() >= -two_pi && range.positive.radians() <= two_pi);
  TurnWork work;
  if (resting.tree().empty() || turning.tree().empty()) {
    return {{range.negative, LimitReason::end_of_range, std::nullopt, Angle()},
            {range.positive, LimitReason::end_of_range, std::nullopt, Angle()},
            work};
  }
  if (const auto faces = faces_touching_at_start(resting, turning, work)) {
    return both({Angle(), LimitReason::contact_at_start, faces, Angle()}, work);
  }
  if (one_inside_other_at_start(resting, turning)) {
    return both({Angle(), LimitReason::contact_at_start, std::nullopt, Angle()}, work);
  }
  const Limit negative = limit_in(TurnDirection::negative, -range.negative.radians(), resting, turning, work);
  const Limit positive = limit_in(TurnDirection::positive, range.positive.radians(), resting, turning, work);
  return {negative, positive, work};
}

}  // namespace condyle::motion

namespace condyle {

TurnWork& TurnWork::operator+=(const TurnWork& more) noexcept {
  node_pairs += more.node_pairs;
  leaf_pairs += more.leaf_pairs;
  events += more.events;
  exact_decisions += more.exact_decisions;
  triangle_tests += more.triangle_tests;
  return *this;
}

}  // namespace condyle
