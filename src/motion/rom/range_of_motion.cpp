#include "condyle/range_of_motion.hpp"

#include <tbb/enumerable_thread_specific.h>

#include <cassert>
#include <utility>

#include "condyle/error.hpp"
#include "core/parallel.hpp"
#include "mesh/surface_to_surface.hpp"
#include "motion/rom/overlap.hpp"
#include "motion/search/first_contact.hpp"

namespace condyle {
namespace {

/// One body as it counts: its features, and the numbers its triangles have in the whole mesh.
struct CountingBody {
  motion::FeatureTree tree;
  std::vector<Index> triangle_in_whole;

  explicit CountingBody(motion::PartOfMesh part)
      : tree(std::move(part.mesh)), triangle_in_whole(std::move(part.triangle_in_whole)) {}

  Feature in_whole(Feature feature) const noexcept {
    if (feature.kind == FeatureKind::face) feature.id = triangle_in_whole[feature.id];
    return feature;
  }
};

/// With the bodies in each other's role.
ContactWitness exchanged(const ContactWitness& contact) {
  return {contact.mobile_feature, contact.fixed_feature, contact.mobile_point, contact.fixed_point,
          contact.kind};
}

/// The axis of internal rotation as seen in M, for F turning about it: adding d to the angle turns M by d
/// about e3, and so F, seen from M, by -d about e3, which is d about -e3.
AxisFrame rotation_axis_in_M(Side side) {
  return {Vec3::Zero(), -axis_of(JointAngle::internal_rotation, side, {})};
}

AxisFrame flexion_axis(Side side) {
  return {Vec3::Zero(), axis_of(JointAngle::flexion, side, {})};
}

}  // namespace

struct RangeOfMotion::Parts {
  /// A part of the mobile body, resting about the axis of internal rotation.
  struct MobilePart {
    CountingBody body;
    motion::RotationTable rotation_table;

    MobilePart(motion::PartOfMesh part, Side side)
        : body(std::move(part)), rotation_table(body.tree, rotation_axis_in_M(side)) {}
  };

  JointKind kind;
  Side side;
  Mesh whole_mobile;
  BearingRule bearing_rule;
  BearingFinding bearing;
  LeftOut left_out;
  CountingBody fixed;
  MobilePart ending;                    ///< what ends motions
  std::unique_ptr<MobilePart> sliding;  ///< the bearing surface, where it does not count
  motion::RotationTable flexion_table;

  /// What one thread keeps: bodies ready to turn, and the table of the flexion it last adducted at.
  struct Worker {
    motion::TurningBody fixed, ending;
    std::optional<motion::TurningBody> sliding;
    std::optional<Angle> flexion;
    std::unique_ptr<motion::RotationTable> adduction_table;

    explicit Worker(const Parts& parts) : fixed(parts.fixed.tree), ending(parts.ending.body.tree) {
      if (parts.sliding) sliding.emplace(parts.sliding->body.tree);
    }
  };
  mutable tbb::enumerable_thread_specific<Worker> workers;

  Parts(const Joint& joint, BearingFinding found, BearingRule rule, motion::PartsOfJoint counting)
      : kind(joint.kind),
        side(joint.side),
        whole_mobile(joint.mobile.mesh),
        bearing_rule(rule),
        bearing(std::move(found)),
        left_out(counting.left_out),
        fixed(std::move(counting.fixed)),
        ending(std::move(counting.mobile), side),
        sliding(counting.bearing ? std::make_unique<MobilePart>(std::move(*counting.bearing), side)
                                 : nullptr),
        flexion_table(fixed.tree, flexion_axis(side)),
        workers([this] { return Worker(*this); }) {}

  const motion::RotationTable& adduction_table(Worker& worker, const JointAngles& start) const {
    if (worker.flexion != start.flexion) {
      worker.adduction_table = std::make_unique<motion::RotationTable>(
          fixed.tree, AxisFrame(Vec3::Zero(), axis_of(JointAngle::adduction, side, start)));
      worker.flexion = start.flexion;
    }
    return *worker.adduction_table;
  }

  /// First contact of the fixed body and one part of the mobile one.
  RotationLimits first_contact(Worker& worker, const MobilePart& part, motion::TurningBody& turning,
                               JointAngle vary, const JointAngles& start, const RotationRange& range) const {
    const Pose X_FM = pose_at(side, start);
    const auto search = [&](const motion::RotationTable& table, motion::TurningBody& body, const Pose& X) {
      body.start_at(table.frame(), X);
      return motion::first_contact(table, body, range);
    };
    RotationLimits limits =
        vary == JointAngle::internal_rotation ? search(part.rotation_table, worker.fixed, X_FM.inverse())
        : vary == JointAngle::adduction       ? search(adduction_table(worker, start), turning, X_FM)
                                              : search(flexion_table, turning, X_FM);
    for (Limit* limit : {&limits.negative, &limits.positive})
      if (limit->contact) finish(*limit->contact, part, vary);
    return limits;
  }

  /// As the search reports it, in terms of the whole bodies and labelled.
  void finish(ContactWitness& contact, const MobilePart& part, JointAngle vary) const {
    if (vary == JointAngle::internal_rotation) contact = exchanged(contact);
    contact.fixed_feature = fixed.in_whole(contact.fixed_feature);
    contact.mobile_feature = part.body.in_whole(contact.mobile_feature);
    if (!bearing.surface) return;
    const bool slides = bearing_rule == BearingRule::leave_out
                            ? &part == sliding.get()
                            : bearing.surface->holds(whole_mobile, contact.mobile_feature);
    contact.kind = slides ? ContactKind::bearing : ContactKind::impingement;
  }

  HeadAtLimit head_at(const JointAngles& angles) const {
    const BearingSurface& surface = *bearing.surface;
    const Pose X_FM = pose_at(side, angles);
    HeadAtLimit head;
    if (surface.socket)
      head.centre_distance_mm = (posed(X_FM, surface.head.centre) - surface.socket->centre).norm();
    if (!sliding) return head;
    if (const auto nearest =
            mesh::closest_points(fixed.tree.triangle_tree(), sliding->body.tree.triangle_tree(), X_FM))
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
  motion::PartsOfJoint counting = motion::parts_that_count(joint, options.overlap, bearing.surface, rule);
  parts_ = std::make_unique<Parts>(joint, std::move(bearing), rule, std::move(counting));
  const OverlapOptions& overlap = options.overlap;
  if (overlap.reference_contact == ReferenceContact::accept) return;
  if (!both_limits(JointAngle::flexion, overlap.reference_pose, {Angle(), Angle()}).free_at_start())
    throw ReferenceContactError(motion::explain_overlap(joint, overlap.reference_pose));
}

RangeOfMotion::~RangeOfMotion() = default;

RotationLimits RangeOfMotion::both_limits(JointAngle vary, const JointAngles& start,
                                          const RotationRange& range) const {
  assert(kind() == JointKind::ball || vary == JointAngle::flexion);
  Parts::Worker& worker = parts_->workers.local();
  RotationLimits limits = parts_->first_contact(worker, parts_->ending, worker.ending, vary, start, range);
  if (!worker.sliding || !limits.free_at_start()) return limits;
  const RotationLimits bearing = parts_->first_contact(worker, *parts_->sliding, *worker.sliding, vary, start,
                                                       {-limits.negative.turned, limits.positive.turned});
  limits.negative.bearing_contact = before(limits.negative, bearing.negative);
  limits.positive.bearing_contact = before(limits.positive, bearing.positive);
  limits.work += bearing.work;
  return limits;
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
Side RangeOfMotion::side() const noexcept {
  return parts_->side;
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
