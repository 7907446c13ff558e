#include "motion/search/first_contact.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <tuple>
#include <vector>

#include "condyle/error.hpp"
#include "core/coordinate_range.hpp"
#include "core/per_thread.hpp"
#include "core/trigonometry.hpp"
#include "motion/search/node_pairs.hpp"
#include "motion/search/start_contact.hpp"

namespace condyle::motion {
namespace {

using Node = FeatureTree::Node;
using Point = Triple<double>;

Vec3 vec3(const Point& p) noexcept {
  return {p.x, p.y, p.z};
}

/// Added to the best angle when regions are left out: more than any event's error and the slack of all boxes,
/// so that whether a pair is tested never decides between pairs that meet at the same angle.
constexpr double keep_ties = 1e-10;

/// A pair of features in contact, by their slots in tree order.
struct Results {
  double angle;  ///< size of the rotation, less its error: never past the true one
  double error;
  FeaturePair features;
  FeatureKind rotating_kind, stationary_kind;
  Index rotating, stationary;
  MetLeaves leaves;  ///< that the features belong to
};

/// The feature in this slot, by its numbers in the mesh.
Feature feature(const FeatureTree& tree, FeatureKind kind, Index slot) {
  switch (kind) {
    case FeatureKind::vertex:
      return {kind, tree.mesh_vertex(slot)};
    case FeatureKind::edge: {
      const auto [a, b] = tree.edges()[slot];
      return {kind, tree.mesh_vertex(a), tree.mesh_vertex(b)};
    }
    case FeatureKind::face:
      break;
  }
  return {FeatureKind::face, tree.mesh_triangle(slot)};
}

/// Goal of a search: the first contact of all, which bounds the remaining search.
class FirstOfAll {
 public:
  explicit FirstOfAll(double range) : within_(range) {}

  double within() const noexcept { return within_; }
  void add(const Results& found) {
    if (found_ && std::tie(found_->angle, found_->features) <= std::tie(found.angle, found.features)) return;
    found_ = found;
    within_ = found.angle;
  }
  const std::optional<Results>& found() const noexcept { return found_; }

 private:
  double within_;
  std::optional<Results> found_;
};

/// The first contact of each feature of the rotating body.
class FirstOfEach {
 public:
  explicit FirstOfEach(double range) : within_(range) {}

  double within() const noexcept { return within_; }
  void add(const Results& found) {
    const auto [place, is_new] = found_.try_emplace(found.features.rotating, found);
    Results& known = place->second;
    if (!is_new && std::tie(found.angle, found.features) < std::tie(known.angle, known.features))
      known = found;
  }
  const std::map<Feature, Results>& found() const noexcept { return found_; }

 private:
  double within_;
  std::map<Feature, Results> found_;
};

/// Depth first, nearest first: the first contact found is usually the true one, and bounds the rest. Stationary is
/// const RotationTable or RotatingBody.
template <class Stationary, class Kept>
class Search {
 public:
  Search(Stationary& stationary, RotatingBody& rotating, RotationSense sense, double range, SearchWork& work)
      : stationary_(stationary), rotating_(rotating), sense_(sense), kept_(range), work_(work) {
    narrow_window();
  }

  const auto& run(const std::optional<MetLeaves>& first = {}) {
    if (first) compare_leaves({first->rotating, first->stationary, 0});
    push(0, 0);
    while (!open_.empty()) {
      const NodePair pair = open_.back();
      open_.pop_back();
      if (pair.gap > reach_) continue;
      const Node &m = rotating_.tree().nodes()[pair.rotating],
                 &f = stationary_.tree().nodes()[pair.stationary];
      if (m.is_leaf() && f.is_leaf()) {
        compare_leaves(pair);
      } else {
        const std::size_t before = open_.size();
        split(rotating_.tree(), stationary_.tree(), pair, [&](Index a, Index b) { push(a, b); });
        if (open_.size() == before + 2 && open_[before].gap < open_[before + 1].gap) {
          std::swap(open_[before], open_[before + 1]);
        }
      }
    }
    return kept_.found();
  }

 private:
  void push(Index rotating, Index stationary) {
    ++work_.node_pairs;
    const CylinderBox &m = rotating_.node_box(rotating), &f = stationary_.node_box(stationary);
    if (!m.overlaps_profile(f)) return;
    const double gap = gap_in_sense(m, f, sense_);
    if (gap <= reach_) open_.push_back({rotating, stationary, gap});
  }

  bool within_reach(const CylinderBox& rotating, const CylinderBox& stationary) const noexcept {
    return rotating.overlaps_profile(stationary) && gap_in_sense(rotating, stationary, sense_) <= reach_;
  }

  /// A feature is in the box of the triangle that it belongs to: most triangles of a leaf are out of reach of
  /// the whole other leaf, and most pairs of the rest are out of each other's, so that few features are
  /// compared one by one.
  void compare_leaves(const NodePair& pair) {
    ++work_.leaf_pairs;
    leaves_ = {pair.rotating, pair.stationary};
    const Node &m = rotating_.tree().nodes()[pair.rotating], &f = stationary_.tree().nodes()[pair.stationary];
    const CylinderBox &m_leaf = rotating_.node_box(pair.rotating),
                      &f_leaf = stationary_.node_box(pair.stationary);
    const CylinderFeatures &mf = rotating_.leaf_features(pair.rotating),
                           &ff = stationary_.leaf_features(pair.stationary);
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
    const FeatureTree &mt = rotating_.tree(), &ft = stationary_.tree();
    const CylinderFeatures &mf = rotating_.features(), &ff = stationary_.features();
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

  void record(const ContactEvents& events, FeatureKind rotating_kind, Index rotating,
              FeatureKind stationary_kind, Index stationary) {
    ++work_.events;
    work_.exact_decisions += events.exact_decisions;
    for (const ContactEvent& event : events) {
      const double size = sense_ == RotationSense::positive ? event.angle : two_pi - event.angle;
      const double angle = std::max(0.0, size - event.error);
      if (angle > kept_.within()) continue;
      const FeaturePair features{feature(rotating_.tree(), rotating_kind, rotating),
                                 feature(stationary_.tree(), stationary_kind, stationary)};
      kept_.add(
          {angle, event.error, features, rotating_kind, stationary_kind, rotating, stationary, leaves_});
      narrow_window();
    }
  }

  void narrow_window() {
    reach_ = kept_.within() + keep_ties;
    window_ =
        sense_ == RotationSense::positive ? AngleWindow::forward(reach_) : AngleWindow::backward(reach_);
  }

  Stationary& stationary_;
  RotatingBody& rotating_;
  RotationSense sense_;
  Kept kept_;
  double reach_ = 0;
  AngleWindow window_;
  SearchWork& work_;
  std::vector<NodePair> open_;
  MetLeaves leaves_{};  ///< that are compared
};

Vec3 about_axis(const Vec3& p, double angle) {
  const auto [s, c] = core::sine_cosine(angle);
  return {c * p.x() - s * p.y(), s * p.x() + c * p.y(), p.z()};
}

/// The point of edge a b nearest to the line through c and d; a where the two are parallel.
Vec3 nearest_to_line(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a, across = u.cross(d - c);
  const double size = across.squaredNorm();
  const double s = size > 0 ? (c - a).cross(d - c).dot(across) / size : 0;
  return a + std::clamp(s, 0.0, 1.0) * u;
}

/// Where the two features meet after the rotation: as a point of either body in its own frame.
template <class Stationary>
ContactWitness witness(Stationary& stationary, RotatingBody& rotating, const Results& found,
                       double rotation) {
  const auto on_rotating = [&](Index v) { return about_axis(vec3(rotating.placed_vertex(v)), rotation); };
  const auto on_stationary = [&](Index v) { return vec3(stationary.placed_vertex(v)); };
  Vec3 m, f;
  if (found.rotating_kind == FeatureKind::vertex) {
    m = f = on_rotating(found.rotating);
  } else if (found.stationary_kind == FeatureKind::vertex) {
    m = f = on_stationary(found.stationary);
  } else {
    const auto [pa, pb] = rotating.tree().edges()[found.rotating];
    const auto [pc, pd] = stationary.tree().edges()[found.stationary];
    const Vec3 a = on_rotating(pa), b = on_rotating(pb), c = on_stationary(pc), d = on_stationary(pd);
    m = nearest_to_line(a, b, c, d), f = nearest_to_line(c, d, a, b);
  }
  return {found.features.stationary, found.features.rotating, stationary.to_own(f),
          rotating.to_own(about_axis(m, -rotation))};
}

/// Without a sign, that of a zero included.
Angle size_of(Angle range) noexcept {
  return Angle::radians(std::abs(range.radians()));
}

template <class Stationary>
Limit limit_in(RotationSense sense, Angle range, Stationary& stationary, RotatingBody& rotating,
               SearchWork& work, std::optional<MetLeaves>* leaves) {
  const Angle size = size_of(range);
  std::optional<Results> found;
  if (size > Angle())
    found = Search<Stationary, FirstOfAll>(stationary, rotating, sense, size.radians(), work)
                .run(leaves ? *leaves : std::nullopt);
  if (!found) return {size};
  if (leaves) *leaves = found->leaves;
  return {Angle::radians(found->angle), LimitReason::contact,
          witness(stationary, rotating, *found, sign_of(sense) * found->angle),
          Angle::radians(2 * found->error)};
}

RotationLimits in_contact_at_start(const std::optional<ContactWitness>& contact, const SearchWork& work) {
  const Limit limit{Angle(), LimitReason::contact_at_start, contact, Angle()};
  return {limit, limit, work};
}

template <class Stationary>
RotationLimits first_contact_of(Stationary& stationary, RotatingBody& rotating, const RotationRange& range,
                                LeavesAtEnds* leaves = nullptr) {
  assert(range.negative.radians() <= 0 && range.positive.radians() >= 0);
  assert(range.negative.radians() >= -two_pi && range.positive.radians() <= two_pi);
  SearchWork work;
  if (stationary.tree().empty() || rotating.tree().empty())
    return {{size_of(range.negative)}, {size_of(range.positive)}, work};
  if (const auto faces = faces_in_contact_at_start(stationary, rotating, work))
    return in_contact_at_start(faces, work);
  if (one_inside_other_at_start(stationary, rotating)) return in_contact_at_start(std::nullopt, work);
  const Limit negative = limit_in(RotationSense::negative, range.negative, stationary, rotating, work,
                                  leaves ? &leaves->negative : nullptr);
  const Limit positive = limit_in(RotationSense::positive, range.positive, stationary, rotating, work,
                                  leaves ? &leaves->positive : nullptr);
  return {negative, positive, work};
}

}  // namespace

RotationLimits first_contact(const RotationTable& stationary, RotatingBody& rotating,
                             const RotationRange& range) {
  return first_contact_of(stationary, rotating, range);
}

RotationLimits first_contact(RotatingBody& stationary, RotatingBody& rotating, const RotationRange& range,
                             LeavesAtEnds* leaves) {
  return first_contact_of(stationary, rotating, range, leaves);
}

std::vector<FeatureContact> feature_contacts(const RotationTable& stationary, RotatingBody& rotating,
                                             RotationSense sense, Angle range) {
  std::vector<FeatureContact> contacts;
  if (stationary.tree().empty() || rotating.tree().empty()) return contacts;
  SearchWork work;
  Search<const RotationTable, FirstOfEach> search(stationary, rotating, sense, range.radians(), work);
  for (const auto& [feature, found] : search.run())
    contacts.push_back({feature, Angle::radians(found.angle),
                        witness(stationary, rotating, found, sign_of(sense) * found.angle).mobile_point});
  std::stable_sort(contacts.begin(), contacts.end(),
                   [](const FeatureContact& a, const FeatureContact& b) { return a.turned < b.turned; });
  return contacts;
}

SearchWork& SearchWork::operator+=(const SearchWork& more) noexcept {
  node_pairs += more.node_pairs;
  leaf_pairs += more.leaf_pairs;
  events += more.events;
  exact_decisions += more.exact_decisions;
  triangle_tests += more.triangle_tests;
  return *this;
}

struct FirstContact::Parts {
  FeatureTree fixed, mobile;
  RotationTable table;
  mutable core::PerThread<RotatingBody> rotating;

  Parts(const Mesh& fixed_mesh, const Mesh& mobile_mesh, const AxisFrame& axis_F)
      : fixed(fixed_mesh),
        mobile(mobile_mesh),
        table(fixed, axis_F),
        rotating([this] { return RotatingBody(mobile); }) {}
};

FirstContact::FirstContact(const Mesh& fixed, const Mesh& mobile, const AxisFrame& axis_F)
    : parts_(std::make_unique<Parts>(fixed, mobile, axis_F)) {}

FirstContact::~FirstContact() = default;
FirstContact::FirstContact(FirstContact&&) noexcept = default;
FirstContact& FirstContact::operator=(FirstContact&&) noexcept = default;

RotationLimits FirstContact::limits(const Pose& X_FM, const RotationRange& range) const {
  core::require_rotation(X_FM);
  const double low = range.negative.radians(), high = range.positive.radians();
  if (!(low <= 0 && low >= -two_pi && high >= 0 && high <= two_pi))
    throw UsageError("first contact: a range goes from at most a full turn back over 0 to a full turn on");
  RotatingBody& rotating = parts_->rotating.local();
  rotating.start_at(parts_->table.frame(), X_FM);
  return motion::first_contact(parts_->table, rotating, range);
}

}  // namespace condyle::motion
