#include "condyle/range_of_motion.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "condyle/error.hpp"
#include "condyle/tangential.hpp"
#include "core/lazy.hpp"
#include "core/parallel.hpp"
#include "core/per_thread.hpp"
#include "mesh/surface_to_surface.hpp"
#include "motion/rom/overlap.hpp"
#include "motion/search/contact_set.hpp"
#include "motion/search/first_contact.hpp"

namespace condyle {
namespace {

/// One body as it counts: its features, and the numbers its triangles have in the whole mesh.
struct IncludedBody {
  Mesh mesh;
  motion::FeatureTree tree;
  std::vector<Index> triangle_in_whole;

  explicit IncludedBody(motion::PartOfMesh part)
      : mesh(std::move(part.mesh)), tree(mesh), triangle_in_whole(std::move(part.triangle_in_whole)) {}

  /// Vertices that its triangles use, spread over all of it: neighbours in the tree are neighbours in space.
  Points spread_vertices(std::size_t most) const {
    Points spread;
    const std::size_t step = std::max<std::size_t>(1, tree.vertices().size() / most);
    for (std::size_t v = 0; v < tree.vertices().size(); v += step) spread.push_back(tree.vertices()[v]);
    return spread;
  }

  Feature in_whole(Feature feature) const noexcept {
    if (feature.kind == FeatureKind::face) feature.id = triangle_in_whole[feature.id];
    return feature;
  }
};

/// Narrower ones may be what rounding leaves between two contacts, and are none.
constexpr Angle narrowest_interval = Angle::radians(1e-9);

/// Taken off the ends of arcs, which err by 1e-7 rad at most; narrower arcs are not worth their sorting.
constexpr Angle arc_slack = Angle::radians(1e-6), narrowest_arc = Angle::degrees(1);

/// Vertices whose contact angles are computed before pairs of triangles are evaluated: more vertices add little to
/// these.
constexpr std::size_t probed_vertices = 512;

/// The body that turned in a search.
enum class Rotating { fixed, mobile };

/// Coarser than usual: such a table is asked once.
constexpr RingTableOptions coarse_rings{.cells_per_triangle = 0.03};

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

}  // namespace

struct RangeOfMotion::Parts {
  /// A part of the mobile body.
  struct MobilePart {
    IncludedBody body;
    AxisFrame rotation_axis;
    core::Lazy<std::optional<motion::RotationTable>> table = {};

    MobilePart(motion::PartOfMesh part, CoordinateSystem system)
        : body(std::move(part)), rotation_axis(rotation_axis_in_M(system)) {}

    /// The part stationary about the axis of internal rotation.
    const motion::RotationTable& rotation_table() const {
      return *table.get([&](auto& made) { made.emplace(body.tree, rotation_axis); });
    }
  };

  JointKind kind;
  CoordinateSystem system;
  Mesh whole_mobile;
  BearingRule bearing_rule;
  BearingFinding bearing;
  LeftOut left_out;
  IncludedBody fixed;
  MobilePart impinging;  ///< the part whose contact ends motions
  Points impinging_vertices;
  std::unique_ptr<MobilePart> bearing_part;  ///< the bearing surface, if it does not count
  motion::RotationTable flexion_table;

  /// Storage of one thread: bodies ready to rotate, and the table of the flexion of its last adduction.
  struct Worker {
    motion::RotatingBody fixed, impinging;
    std::optional<motion::RotatingBody> bearing_part;
    std::optional<Angle> flexion;
    std::unique_ptr<motion::RotationTable> adduction_table;
    /// The fixed body's about the axis whose contacts it last collected.
    std::optional<RingTable> rings;

    explicit Worker(const Parts& parts) : fixed(parts.fixed.tree), impinging(parts.impinging.body.tree) {
      if (parts.bearing_part) bearing_part.emplace(parts.bearing_part->body.tree);
    }
  };
  mutable core::PerThread<Worker> workers;

  Parts(const Joint& joint, BearingFinding found, BearingRule rule, motion::PartsOfJoint included)
      : kind(joint.kind),
        system(joint.coordinates()),
        whole_mobile(joint.mobile.mesh),
        bearing_rule(rule),
        bearing(std::move(found)),
        left_out(included.left_out),
        fixed(std::move(included.fixed)),
        impinging(std::move(included.mobile), system),
        impinging_vertices(impinging.body.spread_vertices(probed_vertices)),
        bearing_part(included.bearing ? std::make_unique<MobilePart>(std::move(*included.bearing), system)
                                      : nullptr),
        flexion_table(fixed.tree, flexion_axis(system)),
        workers([this] { return Worker(*this); }) {}

  const motion::RotationTable& adduction_table(Worker& worker, const JointAngles& start) const {
    if (worker.flexion != start.flexion) {
      worker.adduction_table = std::make_unique<motion::RotationTable>(
          fixed.tree, AxisFrame(Vec3::Zero(), axis_of(JointAngle::adduction, system, start)));
      worker.flexion = start.flexion;
    }
    return *worker.adduction_table;
  }

  /// The fixed body and one part of the mobile one, ready to turn by an angle from its start: whichever has the axis at rest
  /// has its table.
  struct Rotation {
    const motion::RotationTable& stationary;
    motion::RotatingBody& rotating;
  };
  Rotation rotation_of(Worker& worker, const MobilePart& part, motion::RotatingBody& rotating,
                       JointAngle vary, const JointAngles& start) const {
    const Pose X_FM = pose_at(system, start);
    const auto started = [&](const motion::RotationTable& table, motion::RotatingBody& body, const Pose& X) {
      body.start_at(table.frame(), X);
      return Rotation{table, body};
    };
    return vary == JointAngle::internal_rotation
               ? started(part.rotation_table(), worker.fixed, inverted(X_FM))
           : vary == JointAngle::adduction ? started(adduction_table(worker, start), rotating, X_FM)
                                           : started(flexion_table, rotating, X_FM);
  }

  /// First contact of the fixed body and one part of the mobile one.
  RotationLimits first_contact(Worker& worker, const MobilePart& part, motion::RotatingBody& rotating,
                               JointAngle vary, const JointAngles& start, const RotationRange& range) const {
    const Rotation rotation = rotation_of(worker, part, rotating, vary, start);
    RotationLimits limits = motion::first_contact(rotation.stationary, rotation.rotating, range);
    for (Limit* limit : {&limits.negative, &limits.positive})
      if (limit->contact)
        finish(*limit->contact, part,
               vary == JointAngle::internal_rotation ? Rotating::fixed : Rotating::mobile);
    return limits;
  }

  /// As the search reports it, in terms of the whole bodies and labelled.
  void finish(ContactWitness& contact, const MobilePart& part, Rotating rotating) const {
    if (rotating == Rotating::fixed) contact = exchanged(contact);
    contact.fixed_feature = fixed.in_whole(contact.fixed_feature);
    contact.mobile_feature = part.body.in_whole(contact.mobile_feature);
    // With its parts searched apart, a contact is of the kind of its part.
    contact.kind = bearing_rule == BearingRule::count ? bearing.kind_of(whole_mobile, contact)
                   : bearing.is_on_cut(contact)       ? ContactKind::cut
                   : &part == bearing_part.get()      ? ContactKind::bearing
                                                      : ContactKind::impingement;
  }

  /// Angles at which the impinging part meets the fixed body's surface, over a full turn, and those at which one of its
  /// vertices is inside. Angles in `known` are not evaluated and are in the answer.
  core::ArcSet contact_angles(Worker& worker, JointAngle vary, const JointAngles& start,
                              std::vector<core::Arc> known) const {
    const AxisFrame axis(Vec3::Zero(), axis_of(vary, system, start));
    const bool has_rings = worker.rings && worker.rings->frame().direction() == axis.direction();
    if (fixed.mesh.is_closed() && !has_rings) worker.rings.emplace(fixed.mesh, axis, coarse_rings);
    // A vertex inside is contact: its surface crosses the fixed one, or all of it is inside. Vertices detect most
    // contact, without a pair of triangles; the ends of intervals remain.
    if (worker.rings) {
      const OccupiedArcs arcs =
          worker.rings->occupied_arcs(posed(pose_at(system, start), impinging_vertices.view()));
      for (std::size_t v = 0; v < arcs.size(); ++v)
        for (const OccupiedArc& arc : arcs.of(v)) {
          const Angle width = arc.end - arc.begin - arc_slack * 2;
          if (width > narrowest_arc) known.push_back({arc.begin + arc_slack, width});
        }
    }
    const Rotation rotation = rotation_of(worker, impinging, worker.impinging, vary, start);
    return motion::contact_set(rotation.stationary, rotation.rotating, core::ArcSet(known));
  }

  HeadAtLimit head_at(const JointAngles& angles) const {
    const BearingSurface& surface = *bearing.surface;
    const Pose X_FM = pose_at(system, angles);
    HeadAtLimit head;
    if (surface.socket)
      head.centre_distance_mm = (posed(X_FM, surface.head.centre) - surface.socket->centre).norm();
    if (!bearing_part) return head;
    if (const auto nearest =
            mesh::closest_points(fixed.tree.triangle_tree(), bearing_part->body.tree.triangle_tree(), X_FM))
      head.joint_space_mm = nearest->distance_mm;
    return head;
  }
};

namespace {

/// Bearing contact before the limit.
std::optional<BearingContact> before(const Limit& limit, const Limit& bearing) {
  if (bearing.reason == LimitReason::end_of_range || !(bearing.turned < limit.turned)) return std::nullopt;
  return BearingContact{bearing.turned, bearing.contact, bearing.error_bound};
}

}  // namespace

RangeOfMotion::RangeOfMotion(const Joint& joint, const RangeOptions& options) {
  BearingFinding bearing = find_bearing_surface(joint, options.bearing);
  const BearingRule rule = bearing.surface ? options.bearing.rule : BearingRule::count;
  motion::PartsOfJoint included = motion::parts_that_count(joint, options.overlap, bearing.surface, rule);
  parts_ = std::make_unique<Parts>(joint, std::move(bearing), rule, std::move(included));
  const OverlapOptions& overlap = options.overlap;
  if (overlap.reference_contact == ReferenceContact::accept) return;
  if (!both_limits(JointAngle::flexion, overlap.reference_pose, {Angle(), Angle()}).free_at_start())
    throw ReferenceContactError(motion::explain_overlap(joint, overlap.reference_pose));
}

RangeOfMotion::~RangeOfMotion() = default;

RotationLimits RangeOfMotion::both_limits(JointAngle vary, const JointAngles& start,
                                          const RotationRange& range) const {
  assert(kind() != JointKind::hinge || vary == JointAngle::flexion);
  Parts::Worker& worker = parts_->workers.local();
  RotationLimits limits =
      parts_->first_contact(worker, parts_->impinging, worker.impinging, vary, start, range);
  if (!worker.bearing_part || !limits.free_at_start()) return limits;
  const RotationLimits bearing =
      parts_->first_contact(worker, *parts_->bearing_part, *worker.bearing_part, vary, start,
                            {-limits.negative.turned, limits.positive.turned});
  limits.negative.bearing_contact = before(limits.negative, bearing.negative);
  limits.positive.bearing_contact = before(limits.positive, bearing.positive);
  limits.work += bearing.work;
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
  Parts::Worker& worker = parts_->workers.local();
  const Angle full_turn = Angle::radians(two_pi);
  for (const core::Arc& gap :
       parts_->contact_angles(worker, vary, start, std::move(known)).complement().arcs()) {
    for (const Angle shift : {-full_turn, Angle()}) {
      const Angle low = std::max(gap.start + shift, range.negative);
      const Angle high = std::min(gap.start + gap.width + shift, range.positive);
      if (!(high - low > narrowest_interval)) continue;
      // The gap is free or, one body inside the other, all contact; its ends are computed as limits are.
      const Angle middle = low + (high - low) * 0.5;
      const RotationLimits both = parts_->first_contact(worker, parts_->impinging, worker.impinging, vary,
                                                        turned_by(start, vary, middle),
                                                        {range.negative - middle, range.positive - middle});
      if (both.free_at_start())
        free.intervals.push_back(
            {middle - both.negative.turned, middle + both.positive.turned, both.negative, both.positive});
    }
  }
  std::sort(free.intervals.begin(), free.intervals.end(),
            [](const FreeInterval& a, const FreeInterval& b) { return a.low < b.low; });
  return free;
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

JointKind RangeOfMotion::kind() const noexcept {
  return parts_->kind;
}
CoordinateSystem RangeOfMotion::coordinates() const noexcept {
  return parts_->system;
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

}  // namespace condyle
