#include "condyle/range_of_motion.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <utility>

#include "condyle/error.hpp"
#include "condyle/tangential.hpp"
#include "core/latest_few.hpp"
#include "core/lazy.hpp"
#include "core/parallel.hpp"
#include "core/per_thread.hpp"
#include "mesh/surface_to_surface.hpp"
#include "motion/rom/ligament_limits.hpp"
#include "motion/rom/overlap.hpp"
#include "motion/search/add_free_interval.hpp"
#include "motion/search/contact_set.hpp"
#include "motion/search/first_contact.hpp"
#include "motion/search/free_slides.hpp"

namespace condyle::motion {
namespace {

/// One body as it counts: its features, and the numbers its triangles have in the whole mesh.
struct IncludedBody {
  Mesh mesh;
  std::vector<Index> triangle_in_whole;
  core::Lazy<std::optional<FeatureTree>> made_tree = {};

  explicit IncludedBody(PartOfMesh part)
      : mesh(std::move(part.mesh)), triangle_in_whole(std::move(part.triangle_in_whole)) {}
  /// The same triangles over vertices elsewhere.
  IncludedBody(const IncludedBody& before, const Points& vertices)
      : mesh(before.mesh.moved_to(vertices)), triangle_in_whole(before.triangle_in_whole) {
    made_tree.get([&](auto& made) { made.emplace(before.tree().moved_to(vertices)); });
  }

  const FeatureTree& tree() const {
    return *made_tree.get([&](auto& made) { made.emplace(mesh); });
  }

  /// Vertices that its triangles use, spread over all of it: neighbours in the tree are neighbours in space.
  Points spread_vertices(std::size_t most) const {
    Points spread;
    const std::span<const Vec3> vertices = tree().vertices();
    const std::size_t step = std::max<std::size_t>(1, vertices.size() / most);
    for (std::size_t v = 0; v < vertices.size(); v += step) spread.push_back(vertices[v]);
    return spread;
  }

  Feature in_whole(Feature feature) const noexcept {
    if (feature.kind == FeatureKind::face) feature.id = triangle_in_whole[feature.id];
    return feature;
  }
};

/// Taken off the ends of arcs, which err by 1e-7 rad at most; narrower arcs are not worth their sorting.
constexpr Angle arc_slack = Angle::radians(1e-6), narrowest_arc = Angle::degrees(1);

/// Vertices whose contact angles are computed before pairs of triangles are evaluated: more vertices add little to
/// these.
constexpr std::size_t most_probed_vertices = 512;

/// The body that turned in a search.
enum class Rotating { fixed, mobile };

/// Coarser than usual: such a table is asked once.
constexpr tangential::RingTableOptions coarse_rings{.cells_per_triangle = 0.03};

/// Tables about the axis of adduction that a part of the fixed body keeps: built-in motions change adduction at two flexions.
constexpr std::size_t adductions_kept = 2;

/// Directions of slides in whose frames a part of the fixed body is kept.
constexpr std::size_t slides_kept = 3;

/// With the bodies in each other's role.
ContactWitness exchanged(const ContactWitness& contact) {
  return {contact.mobile_feature, contact.fixed_feature, contact.mobile_point, contact.fixed_point,
          contact.kind};
}

/// The axis of internal rotation as seen in M, for F rotating about it: adding d to the angle turns M by d
/// about e3, and so F, seen from M, by -d about e3, which is d about -e3.
AxisFrame rotation_axis_in_M(CoordinateSystem system) {
  return {Vec3::Zero(), -axis_of(JointAngle::internal_rotation, system, {})};
}

AxisFrame flexion_axis(CoordinateSystem system) {
  return {Vec3::Zero(), axis_of(JointAngle::flexion, system, {})};
}

AxisFrame adduction_axis(CoordinateSystem system, const JointAngles& start) {
  return {Vec3::Zero(), axis_of(JointAngle::adduction, system, start)};
}

/// How the body that rests is made ready for a search.
enum class Resting {
  by_table,          ///< all of it, for many searches
  as_far_as_looked,  ///< for those of one pose
};

RotatingBody& made(std::optional<RotatingBody>& body, const FeatureTree& tree) {
  if (!body) body.emplace(tree);
  return *body;
}

}  // namespace

struct RangeOfMotion::Parts {
  /// A part of the fixed body.
  struct FixedPart {
    IncludedBody body;
    core::Lazy<std::optional<RotationTable>> about_flexion = {};
    core::LatestFew<Angle, std::optional<RotationTable>, adductions_kept> adduction_tables = {};
    core::LatestFew<Vec3, std::optional<SlidingBody>, slides_kept> slides = {};

    explicit FixedPart(PartOfMesh part) : body(std::move(part)) {}
    FixedPart(const FixedPart& before, const Points& vertices) : body(before.body, vertices) {}

    const RotationTable& flexion_table(CoordinateSystem axes) const {
      return *about_flexion.get([&](auto& made) { made.emplace(body.tree(), flexion_axis(axes)); });
    }

    /// About the axis that the angles of a start have.
    std::shared_ptr<const std::optional<RotationTable>> adduction_table(CoordinateSystem axes,
                                                                        const JointAngles& start) const {
      return adduction_tables.get(start.flexion, [&](std::optional<RotationTable>& table) {
        table.emplace(body.tree(), adduction_axis(axes, start));
      });
    }
  };

  /// A part of the mobile body.
  struct MobilePart {
    IncludedBody body;
    AxisFrame rotation_axis;
    core::Lazy<Points> probed = {};
    core::Lazy<std::optional<RotationTable>> table = {};

    MobilePart(PartOfMesh part, CoordinateSystem system)
        : body(std::move(part)), rotation_axis(rotation_axis_in_M(system)) {}
    MobilePart(const MobilePart& before, const Points& vertices)
        : body(before.body, vertices), rotation_axis(before.rotation_axis) {}

    const Points& probed_vertices() const {
      return probed.get([&](Points& made) { made = body.spread_vertices(most_probed_vertices); });
    }

    /// The part stationary about the axis of internal rotation.
    const RotationTable& rotation_table() const {
      return *table.get([&](auto& made) { made.emplace(body.tree(), rotation_axis); });
    }
  };

  JointKind kind;
  CoordinateSystem system;
  TranslationFrame translation_frame;
  Mesh whole_fixed, whole_mobile;
  BearingRule bearing_rule;
  BearingFinding bearing;
  LeftOut left_out;
  std::vector<PairOfParts> impinging, earlier;
  LigamentLimits ligaments;
  // Neither moves: tables and threads refer to their trees. Joints that differ in the other body share them.
  std::vector<std::shared_ptr<const FixedPart>> fixed = {};
  std::vector<std::shared_ptr<const MobilePart>> mobile = {};

  /// Storage of one thread for a part of the fixed body: ready to rotate, and the table of the flexion of its last adduction.
  struct FixedWorker {
    std::optional<RotatingBody> rotating = {};
    std::optional<Angle> flexion = {};
    std::shared_ptr<const std::optional<RotationTable>> adduction_table = {};
    /// About the axis whose contacts it last collected.
    std::optional<tangential::RingTable> rings = {};
  };
  struct Worker {
    std::vector<FixedWorker> fixed;
    std::vector<std::optional<RotatingBody>> mobile;
    /// Bodies at rest for single poses, by the angle that varies and the number of their part.
    std::map<std::pair<JointAngle, std::size_t>, std::optional<RotatingBody>> resting = {};

    explicit Worker(const Parts& parts) : fixed(parts.fixed.size()), mobile(parts.mobile.size()) {}
  };
  mutable core::PerThread<Worker> workers;

  Parts(const Joint& joint, BearingFinding found, BearingRule rule, PartsOfJoint included)
      : kind(joint.kind),
        system(joint.coordinates()),
        translation_frame(joint.translation_frame),
        whole_fixed(joint.fixed.mesh),
        whole_mobile(joint.mobile.mesh),
        bearing_rule(rule),
        bearing(std::move(found)),
        left_out(included.left_out),
        impinging(std::move(included.impinging)),
        earlier(std::move(included.earlier)),
        ligaments(joint),
        workers([this] { return Worker(*this); }) {
    for (PartOfMesh& part : included.fixed)
      fixed.push_back(std::make_shared<const FixedPart>(std::move(part)));
    for (PartOfMesh& part : included.mobile)
      mobile.push_back(std::make_shared<const MobilePart>(std::move(part), system));
  }

  /// The same with the vertices of one body elsewhere.
  Parts(const Parts& before, BodyRole moved, const Points& vertices)
      : kind(before.kind),
        system(before.system),
        translation_frame(before.translation_frame),
        whole_fixed(before.whole_fixed),
        whole_mobile(before.whole_mobile),
        bearing_rule(before.bearing_rule),
        bearing(before.bearing),
        left_out(before.left_out),
        impinging(before.impinging),
        earlier(before.earlier),
        ligaments(before.ligaments),
        fixed(before.fixed),
        mobile(before.mobile),
        workers([this] { return Worker(*this); }) {
    if (moved == BodyRole::fixed) {
      whole_fixed = whole_fixed.moved_to(vertices);
      for (auto& part : fixed) part = std::make_shared<const FixedPart>(*part, vertices);
    } else {
      whole_mobile = whole_mobile.moved_to(vertices);
      for (auto& part : mobile) part = std::make_shared<const MobilePart>(*part, vertices);
    }
  }

  const RotationTable& adduction_table(Worker& worker, std::size_t part, const JointAngles& start) const {
    FixedWorker& of_part = worker.fixed[part];
    if (of_part.flexion != start.flexion) {
      of_part.adduction_table = fixed[part]->adduction_table(system, start);
      of_part.flexion = start.flexion;
    }
    return **of_part.adduction_table;
  }

  /// The body that rotates, at its start about this axis, which is seen in the other one.
  RotatingBody& started(Worker& worker, const PairOfParts& pair, JointAngle vary, const JointAngles& start,
                        const AxisFrame& axis) const {
    const bool fixed_rotates = vary == JointAngle::internal_rotation;
    RotatingBody& body = fixed_rotates
                             ? made(worker.fixed[pair.fixed].rotating, fixed[pair.fixed]->body.tree())
                             : made(worker.mobile[pair.mobile], mobile[pair.mobile]->body.tree());
    const Pose X_FM = pose_at(system, start);
    body.start_at(axis, fixed_rotates ? inverted(X_FM) : X_FM);
    return body;
  }

  /// The table of the body in which the axis is at rest.
  const RotationTable& table_of(Worker& worker, const PairOfParts& pair, JointAngle vary,
                                const JointAngles& start) const {
    return vary == JointAngle::internal_rotation ? mobile[pair.mobile]->rotation_table()
           : vary == JointAngle::adduction       ? adduction_table(worker, pair.fixed, start)
                                                 : fixed[pair.fixed]->flexion_table(system);
  }

  /// The same body, ready as far as searches have looked.
  RotatingBody& resting_body(Worker& worker, const PairOfParts& pair, JointAngle vary,
                             const JointAngles& start) const {
    const bool is_mobile = vary == JointAngle::internal_rotation;
    const FeatureTree& tree = is_mobile ? mobile[pair.mobile]->body.tree() : fixed[pair.fixed]->body.tree();
    RotatingBody& body = made(worker.resting[{vary, is_mobile ? pair.mobile : pair.fixed}], tree);
    body.start_at(is_mobile                       ? mobile[pair.mobile]->rotation_axis
                  : vary == JointAngle::adduction ? adduction_axis(system, start)
                                                  : flexion_axis(system),
                  Pose::Identity());
    return body;
  }

  /// First contact of one part of each body.
  RotationLimits first_contact(Worker& worker, const PairOfParts& pair, JointAngle vary,
                               const JointAngles& start, const RotationRange& range, Resting resting) const {
    const auto search = [&](auto& stationary) {
      return motion::first_contact(stationary, started(worker, pair, vary, start, stationary.frame()), range);
    };
    RotationLimits limits = resting == Resting::by_table ? search(table_of(worker, pair, vary, start))
                                                         : search(resting_body(worker, pair, vary, start));
    for (Limit* limit : {&limits.negative, &limits.positive})
      if (limit->contact)
        finish(*limit->contact, pair,
               vary == JointAngle::internal_rotation ? Rotating::fixed : Rotating::mobile);
    return limits;
  }

  /// First contact that ends a motion, or the strain of a ligament.
  RotationLimits first_end(Worker& worker, JointAngle vary, const JointAngles& start,
                           const RotationRange& range, Resting resting = Resting::by_table) const {
    RotationLimits limits = first_impingement(worker, vary, start, range, resting);
    if (!ligaments.empty()) ligaments.take_sooner(limits, about(vary, start), pose_at(system, start), range);
    return limits;
  }

  AxisFrame about(JointAngle vary, const JointAngles& start) const {
    return {Vec3::Zero(), axis_of(vary, system, start)};
  }

  RotationLimits first_impingement(Worker& worker, JointAngle vary, const JointAngles& start,
                                   const RotationRange& range, Resting resting) const {
    RotationLimits limits = first_contact(worker, impinging.front(), vary, start, range, resting);
    for (std::size_t i = 1; i < impinging.size() && limits.free_at_start(); ++i) {
      const RotationLimits more = first_contact(worker, impinging[i], vary, start, range, resting);
      const auto take_sooner = [&](Limit& limit, const Limit& other) {
        if (other.reason == LimitReason::contact_at_start || other.turned < limit.turned ||
            limit.reason == LimitReason::end_of_range)
          limit = other;
      };
      take_sooner(limits.negative, more.negative);
      take_sooner(limits.positive, more.positive);
      limits.work += more.work;
    }
    return limits;
  }

  /// As the search reports it, in terms of the whole bodies and labelled.
  void finish(ContactWitness& contact, const PairOfParts& pair, Rotating rotating) const {
    if (rotating == Rotating::fixed) contact = exchanged(contact);
    contact.fixed_feature = fixed[pair.fixed]->body.in_whole(contact.fixed_feature);
    contact.mobile_feature = mobile[pair.mobile]->body.in_whole(contact.mobile_feature);
    // With its parts searched apart, a contact is of the kind of its parts.
    contact.kind = pair.kind == ContactKind::unknown || !bearing.roles.distinguish_bearing()
                       ? bearing.kind_of(whole_fixed, whole_mobile, contact)
                   : bearing.is_on_cut(contact) ? ContactKind::cut
                                                : pair.kind;
  }

  /// Angles at which two parts meet each other's surface, over a full turn, and those at which a vertex of the mobile one is
  /// inside. Angles in `known` are not evaluated and are in the answer.
  core::ArcSet contact_angles(Worker& worker, const PairOfParts& pair, JointAngle vary,
                              const JointAngles& start, std::vector<core::Arc> known) const {
    const AxisFrame axis = about(vary, start);
    const Mesh& stationary = fixed[pair.fixed]->body.mesh;
    std::optional<tangential::RingTable>& rings = worker.fixed[pair.fixed].rings;
    const bool has_rings = rings && rings->frame().direction() == axis.direction();
    if (stationary.is_closed() && !has_rings) rings.emplace(stationary, axis, coarse_rings);
    // A vertex inside is contact: its surface crosses the fixed one, or all of it is inside. Vertices detect most
    // contact, without a pair of triangles; the ends of intervals remain.
    if (rings) {
      const tangential::OccupiedArcs arcs =
          rings->occupied_arcs(posed(pose_at(system, start), mobile[pair.mobile]->probed_vertices().view()));
      for (std::size_t v = 0; v < arcs.size(); ++v)
        for (const tangential::OccupiedArc& arc : arcs.of(v)) {
          const Angle width = arc.end - arc.begin - arc_slack * 2;
          if (width > narrowest_arc) known.push_back({arc.begin + arc_slack, width});
        }
    }
    const RotationTable& table = table_of(worker, pair, vary, start);
    return motion::contact_set(table, started(worker, pair, vary, start, table.frame()), core::ArcSet(known));
  }

  /// Angles of contact between all parts whose contact ends a motion.
  core::ArcSet contact_angles(Worker& worker, JointAngle vary, const JointAngles& start,
                              std::vector<core::Arc> known) const {
    for (std::size_t i = 0; i + 1 < impinging.size(); ++i)
      known = contact_angles(worker, impinging[i], vary, start, std::move(known)).arcs();
    return contact_angles(worker, impinging.back(), vary, start, std::move(known));
  }

  HeadAtLimit head_at(const JointAngles& angles) const {
    const BearingSurface& surface = *bearing.surface;
    const Pose X_FM = pose_at(system, angles);
    HeadAtLimit head;
    if (surface.socket)
      head.centre_distance_mm = (posed(X_FM, surface.head.centre) - surface.socket->centre).norm();
    for (const PairOfParts& pair : earlier) {
      if (pair.kind != ContactKind::bearing) continue;
      const auto nearest = mesh::closest_points(fixed[pair.fixed]->body.tree().triangle_tree(),
                                                mobile[pair.mobile]->body.tree().triangle_tree(), X_FM);
      if (nearest)
        head.joint_space_mm =
            std::min(nearest->distance_mm, head.joint_space_mm.value_or(nearest->distance_mm));
    }
    return head;
  }
};

namespace {

/// Notes contact that ends nothing, if it comes before the limit and before what is noted already.
void note_before(const Limit& limit, const Limit& earlier, std::optional<EarlierContact>& noted) {
  if (earlier.reason == LimitReason::end_of_range || !(earlier.turned < limit.turned)) return;
  if (noted && !(earlier.turned < noted->turned)) return;
  noted = {earlier.turned, earlier.contact, earlier.error_bound};
}

}  // namespace

RangeOfMotion::RangeOfMotion(const Joint& joint, const RangeOptions& options) {
  BearingFinding bearing = find_bearing_surface(joint, options.bearing);
  const BearingRule rule = bearing.roles.distinguish_bearing() ? options.bearing.rule : BearingRule::count;
  PartsOfJoint included = motion::parts_that_count(joint, options.overlap, bearing, rule);
  parts_ = std::make_unique<Parts>(joint, std::move(bearing), rule, std::move(included));
  const OverlapOptions& overlap = options.overlap;
  if (overlap.reference_contact == ReferenceContact::accept) return;
  if (both_limits(JointAngle::flexion, overlap.reference_pose, {Angle(), Angle()}).positive.reason ==
      LimitReason::contact_at_start)
    throw ReferenceContactError(motion::explain_overlap(joint, overlap.reference_pose));
}

RangeOfMotion::RangeOfMotion(const RangeOfMotion& before, BodyRole moved, const Points& vertices)
    : parts_(std::make_unique<Parts>(*before.parts_, moved, vertices)) {}

RangeOfMotion::RangeOfMotion(const RangeOfMotion& before, const Vec3& fixed_by, const Vec3& mobile_by) {
  const Parts of_fixed(*before.parts_, BodyRole::fixed,
                       shifted(before.parts_->whole_fixed.vertices(), fixed_by));
  parts_ = std::make_unique<Parts>(of_fixed, BodyRole::mobile,
                                   shifted(before.parts_->whole_mobile.vertices(), mobile_by));
  parts_->ligaments = before.parts_->ligaments.shifted(fixed_by, mobile_by);
  for (ImageCut& cut : parts_->bearing.fixed_cuts) cut.offset_mm += cut.normal.dot(fixed_by);
  for (ImageCut& cut : parts_->bearing.mobile_cuts) cut.offset_mm += cut.normal.dot(mobile_by);
}

RangeOfMotion::~RangeOfMotion() = default;

RotationLimits RangeOfMotion::both_limits(JointAngle vary, const JointAngles& start,
                                          const RotationRange& range) const {
  assert(kind() != JointKind::hinge || vary == JointAngle::flexion);
  Parts::Worker& worker = parts_->workers.local();
  RotationLimits limits = parts_->first_end(worker, vary, start, range);
  if (!limits.free_at_start()) return limits;
  for (const PairOfParts& pair : parts_->earlier) {
    const RotationLimits earlier = parts_->first_contact(
        worker, pair, vary, start, {-limits.negative.turned, limits.positive.turned}, Resting::by_table);
    const bool is_soft = pair.kind == ContactKind::soft;
    for (const auto limit : {&RotationLimits::negative, &RotationLimits::positive}) {
      Limit& end = limits.*limit;
      note_before(end, earlier.*limit, is_soft ? end.soft_contact : end.bearing_contact);
    }
    limits.work += earlier.work;
  }
  return limits;
}

FreeAngles RangeOfMotion::free_angles(JointAngle vary, const JointAngles& start,
                                      const RotationRange& range) const {
  if (!(range.negative >= Angle::degrees(-180) && range.negative <= Angle() && range.positive >= Angle() &&
        range.positive <= Angle::degrees(180)))
    throw UsageError("free angles: a range goes from at most half a turn back over 0 to half a turn on");
  FreeAngles free{both_limits(vary, start, range), {}};
  const RotationLimits& from_start = free.from_start;
  std::vector<core::Arc> known;
  if (from_start.free_at_start()) {
    known.push_back({-from_start.negative.turned, from_start.negative.turned + from_start.positive.turned});
    free.intervals.push_back(
        {-from_start.negative.turned, from_start.positive.turned, from_start.negative, from_start.positive});
  }
  if (!parts_->ligaments.empty())
    for (const core::Arc& arc :
         parts_->ligaments.strained(parts_->about(vary, start), pose_at(parts_->system, start)).arcs())
      known.push_back(arc);
  Parts::Worker& worker = parts_->workers.local();
  const Angle full_turn = Angle::radians(two_pi);
  for (const core::Arc& gap :
       parts_->contact_angles(worker, vary, start, std::move(known)).complement().arcs()) {
    for (const Angle shift : {-full_turn, Angle()}) {
      const Angle low = std::max(gap.start + shift, range.negative);
      const Angle high = std::min(gap.start + gap.width + shift, range.positive);
      if (!(high - low > narrowest_free_turn)) continue;
      // The gap is free or, one body inside the other, all contact; its ends are computed as limits are.
      const Angle middle = low + (high - low) * 0.5;
      const RotationLimits both = parts_->first_end(worker, vary, turned_by(start, vary, middle),
                                                    {range.negative - middle, range.positive - middle});
      if (both.free_at_start()) add_free_interval(free.intervals, middle, both);
    }
  }
  std::sort(free.intervals.begin(), free.intervals.end(),
            [](const FreeInterval& a, const FreeInterval& b) { return a.low < b.low; });
  return free;
}

FreeSlides RangeOfMotion::free_slides(const Vec3& direction_F, const Pose& X_FM,
                                      const SlideRange& range) const {
  const AxisFrame frame(Vec3::Zero(), direction_F);
  std::optional<FreeSlides> all;
  for (const std::vector<PairOfParts>* pairs : {&parts_->impinging, &parts_->earlier})
    for (const PairOfParts& pair : *pairs) {
      if (pair.kind == ContactKind::soft) continue;
      const Parts::FixedPart& fixed = *parts_->fixed[pair.fixed];
      const auto placed = fixed.slides.get(
          direction_F, [&](std::optional<SlidingBody>& body) { body.emplace(fixed.body.mesh, frame); });
      FreeSlides free = motion::free_slides(fixed.body.mesh, **placed, parts_->mobile[pair.mobile]->body.mesh,
                                            frame, X_FM, range);
      const auto finish = [&](SlideEnd& end) {
        if (end.contact) parts_->finish(*end.contact, pair, Rotating::mobile);
      };
      finish(free.negative), finish(free.positive);
      for (FreeSlide& interval : free.intervals) finish(interval.low), finish(interval.high);
      all = all ? free_in_both(*all, free) : std::move(free);
    }
  return *all;
}

const FreeInterval* FreeAngles::nearest_to_start() const noexcept {
  const auto distance = [](const FreeInterval& interval) {
    return std::max({interval.low.radians(), -interval.high.radians(), 0.0});
  };
  const auto nearest =
      std::min_element(intervals.begin(), intervals.end(),
                       [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  return nearest == intervals.end() ? nullptr : &*nearest;
}

MotionLimit RangeOfMotion::limit(const Motion& motion) const {
  check_motion(motion, kind());
  const bool grows = motion.sense == RotationSense::positive;
  const RotationRange range{.negative = grows ? Angle() : -motion.range,
                            .positive = grows ? motion.range : Angle()};
  RotationLimits both = both_limits(motion.vary, motion.start, range);
  MotionLimit limit{motion, std::move(grows ? both.positive : both.negative), {}};
  if (parts_->bearing.surface) limit.head = parts_->head_at(limit.angles_at_limit());
  return limit;
}

std::vector<MotionLimit> RangeOfMotion::limits(std::span<const Motion> motions) const {
  for (const Motion& motion : motions) check_motion(motion, kind());
  std::vector<MotionLimit> out(motions.size());
  core::parallel_chunks(motions.size(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) out[i] = limit(motions[i]);
  });
  return out;
}

std::optional<NearestEnd> RangeOfMotion::nearest_end(const JointAngles& start) const {
  std::optional<NearestEnd> nearest;
  Angle within = Angle::degrees(180);
  for (const JointAngle vary : all_joint_angles) {
    if (kind() == JointKind::hinge && vary != JointAngle::flexion) continue;
    const RotationLimits both =
        parts_->first_end(parts_->workers.local(), vary, start, {-within, within}, Resting::as_far_as_looked);
    for (const RotationSense sense : {RotationSense::negative, RotationSense::positive}) {
      const Limit& end = sense == RotationSense::negative ? both.negative : both.positive;
      if (end.reason == LimitReason::end_of_range || (nearest && !(end.turned < within))) continue;
      within = end.turned;
      nearest = {end, vary, sense};
    }
    if (!both.free_at_start()) break;
  }
  return nearest;
}

std::optional<NearestEnd> RangeOfMotion::end_behind(const JointAngles& start, Angle within) const {
  for (const JointAngle vary : all_joint_angles) {
    if (kind() == JointKind::hinge && vary != JointAngle::flexion) continue;
    for (const RotationSense back : {RotationSense::negative, RotationSense::positive}) {
      const bool is_back = back == RotationSense::negative;
      const RotationLimits both = parts_->first_end(
          parts_->workers.local(), vary, turned_by(start, vary, within * sign_of(back)),
          {is_back ? Angle() : within * -2, is_back ? within * 2 : Angle()}, Resting::as_far_as_looked);
      Limit end = is_back ? both.positive : both.negative;
      if (!both.free_at_start() || end.reason == LimitReason::end_of_range) continue;
      end.turned = Angle();
      return NearestEnd{end, vary, is_back ? RotationSense::positive : RotationSense::negative};
    }
  }
  return std::nullopt;
}

double RangeOfMotion::clearance_mm(const Pose& X_FM) const {
  double least = std::numeric_limits<double>::infinity();
  for (const PairOfParts& pair : parts_->impinging)
    if (const auto nearest =
            mesh::closest_points(parts_->fixed[pair.fixed]->body.tree().triangle_tree(),
                                 parts_->mobile[pair.mobile]->body.tree().triangle_tree(), X_FM, least))
      least = nearest->distance_mm;
  return least;
}

bool RangeOfMotion::may_end_within(Angle turn, const Vec3& origin_F, double clearance_mm) const {
  if (!parts_->ligaments.empty()) return true;
  double squared_reach = 0;
  const Points& vertices = parts_->whole_fixed.vertices();
  for (std::size_t v = 0; v < vertices.size(); ++v)
    squared_reach = std::max(squared_reach, (vertices[v] - origin_F).squaredNorm());
  return clearance_mm <= std::sqrt(squared_reach) * turn.radians();
}

JointKind RangeOfMotion::kind() const noexcept {
  return parts_->kind;
}
CoordinateSystem RangeOfMotion::coordinates() const noexcept {
  return parts_->system;
}
TranslationFrame RangeOfMotion::translation_frame() const noexcept {
  return parts_->translation_frame;
}
const BearingFinding& RangeOfMotion::bearing() const noexcept {
  return parts_->bearing;
}
BearingRule RangeOfMotion::bearing_rule() const noexcept {
  return parts_->bearing_rule;
}
const LeftOut& RangeOfMotion::left_out() const noexcept {
  return parts_->left_out;
}

}  // namespace condyle::motion
