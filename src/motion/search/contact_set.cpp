#include "motion/search/contact_set.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/trigonometry.hpp"
#include "mesh/triangle_intersection.hpp"
#include "motion/search/node_pairs.hpp"

namespace condyle::motion {
namespace {

/// Events of a pair closer than this, in radians, are not distinguished: between them the bodies could be nearer
/// than the rounding of turned coordinates.
constexpr double narrow_gap = 1e-9;

/// Arcs collected before they are united with the rest: uniting costs as much as the set has arcs.
constexpr std::size_t arcs_at_a_time = 64;

core::Arc arc(double from, double to) {
  return {Angle::radians(from), Angle::radians(to - from)};
}

Vec3 turned(const Triple<double>& p, double cosine, double sine) {
  return {p.x * cosine - p.y * sine, p.x * sine + p.y * cosine, p.z};
}

bool in_contact_at(const Corners& rotating, const Corners& stationary, double angle) {
  const auto [s, c] = core::sine_cosine(angle);
  mesh::TriangleCorners a, b;
  for (std::size_t k = 0; k < 3; ++k) a[k] = turned(rotating[k], c, s), b[k] = turned(stationary[k], 1, 0);
  return mesh::triangles_intersect(a, b);
}

/// Angles at which the two may meet: those that make their arcs meet.
core::Arc window(const CylinderBox& rotating, const CylinderBox& stationary) {
  const double from = stationary.theta - (rotating.theta + rotating.theta_width);
  return arc(from, from + rotating.theta_width + stationary.theta_width);
}

/// The angles at which the two surfaces meet. Stationary is RotatingBody or const RotationTable.
template <class Stationary>
class Collector {
 public:
  Collector(Stationary& stationary, RotatingBody& rotating, core::ArcSet known)
      : stationary_(stationary), rotating_(rotating), found_(std::move(known)) {}

  core::ArcSet run() {
    push(0, 0);
    while (!open_.empty()) {
      const NodePair pair = open_.back();
      open_.pop_back();
      const auto &m = rotating_.tree().nodes()[pair.rotating],
                 &f = stationary_.tree().nodes()[pair.stationary];
      if (m.is_leaf() && f.is_leaf()) {
        rotating_.leaf_features(pair.rotating), stationary_.leaf_features(pair.stationary);
        compare({m.first, m.last}, {f.first, f.last});
      } else {
        split(rotating_.tree(), stationary_.tree(), pair, [&](Index a, Index b) { push(a, b); });
      }
    }
    unite();
    return std::move(found_);
  }

 private:
  /// A feature wholly in the angles already found has nothing to add.
  bool may_add(const CylinderBox& rotating, const CylinderBox& stationary) const {
    return rotating.overlaps_profile(stationary) && !found_.contains(window(rotating, stationary));
  }

  void push(Index rotating, Index stationary) {
    if (may_add(rotating_.node_box(rotating), stationary_.node_box(stationary)))
      open_.push_back({rotating, stationary, 0});
  }

  void compare(const FeatureTree::Range& rotating, const FeatureTree::Range& stationary) {
    for (Index s = rotating.first; s < rotating.last; ++s) {
      const auto& box = rotating_.features().triangle_boxes[s];
      for (Index t = stationary.first; t < stationary.last; ++t) {
        if (may_add(box, stationary_.features().triangle_boxes[t])) compare_triangles(s, t);
      }
    }
  }

  void compare_triangles(Index s, Index t) {
    const Corners a = rotating_.features().corners(rotating_.tree(), s);
    const Corners b = stationary_.features().corners(stationary_.tree(), t);
    find_events(PlacedTriangle(a, rotating_, s), PlacedTriangle(b, stationary_, t));
    if (events_.empty()) {
      // Without an event the state never changes; a pair away from the axis is apart at some angle.
      const auto all =
          window(rotating_.features().triangle_boxes[s], stationary_.features().triangle_boxes[t]);
      if (all.width.radians() >= two_pi && in_contact_at(a, b, 0)) add(arc(0, two_pi));
      return;
    }
    std::sort(events_.begin(), events_.end(),
              [](const ContactEvent& x, const ContactEvent& y) { return x.angle < y.angle; });
    for (std::size_t i = 0; i < events_.size(); ++i) {
      const bool is_last = i + 1 == events_.size();
      const ContactEvent here = events_[i];
      ContactEvent next = is_last ? events_[0] : events_[i + 1];
      if (is_last) next.angle += two_pi;
      const double from = here.angle - here.error, to = next.angle + next.error;
      const bool joined =
          next.angle - here.angle < narrow_gap || in_contact_at(a, b, (here.angle + next.angle) / 2);
      add(joined ? arc(from, to) : arc(from, here.angle + here.error));
    }
  }

  /// A triangle with the boxes of its parts: of two only parts whose profiles overlap can meet.
  struct PlacedTriangle {
    const Corners& corners;
    const CylinderBox& box;
    std::array<CylinderBox, 3> vertices, edges;  ///< edge k from corner k to the next

    template <class Body>
    PlacedTriangle(const Corners& placed, const Body& body, Index triangle)
        : corners(placed), box(body.features().triangle_boxes[triangle]) {
      const CylinderFeatures& features = body.features();
      const auto& ids = body.tree().triangles()[triangle];
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = (k + 1) % 3;
        vertices[k] = features.vertex_box(ids[k]);
        edges[k] = box_of_edge(placed[k], features.at[ids[k]], placed[next], features.at[ids[next]]);
      }
    }
  };

  void find_events(const PlacedTriangle& a, const PlacedTriangle& b) {
    events_.clear();
    const auto keep = [&](const ContactEvents& events) {
      events_.insert(events_.end(), events.begin(), events.end());
    };
    for (std::size_t k = 0; k < 3; ++k) {
      if (a.vertices[k].overlaps_profile(b.box)) keep(vertex_meets_face(a.corners[k], b.corners));
      if (b.vertices[k].overlaps_profile(a.box)) keep(face_meets_vertex(a.corners, b.corners[k]));
      for (std::size_t l = 0; l < 3; ++l)
        if (a.edges[k].overlaps_profile(b.edges[l]))
          keep(edges_meet(a.corners[k], a.corners[(k + 1) % 3], b.corners[l], b.corners[(l + 1) % 3]));
    }
  }

  void add(const core::Arc& more) {
    fresh_.push_back(more);
    if (fresh_.size() == arcs_at_a_time) unite();
  }
  void unite() {
    found_ = found_.united(core::ArcSet(fresh_));
    fresh_.clear();
  }

  Stationary& stationary_;
  RotatingBody& rotating_;
  std::vector<NodePair> open_;
  std::vector<ContactEvent> events_;
  std::vector<core::Arc> fresh_;
  core::ArcSet found_;
};

template <class Stationary>
core::ArcSet contact_set_of(Stationary& stationary, RotatingBody& rotating, const core::ArcSet& known) {
  if (stationary.tree().empty() || rotating.tree().empty()) return known;
  return Collector<Stationary>(stationary, rotating, known).run();
}

}  // namespace

core::ArcSet contact_set(const RotationTable& stationary, RotatingBody& rotating, const core::ArcSet& known) {
  return contact_set_of(stationary, rotating, known);
}
core::ArcSet contact_set(RotatingBody& stationary, RotatingBody& rotating, const core::ArcSet& known) {
  return contact_set_of(stationary, rotating, known);
}

}  // namespace condyle::motion
