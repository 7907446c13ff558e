#include "condyle/range_of_motion.hpp"

#include <tbb/enumerable_thread_specific.h>

#include <cassert>
#include <cmath>

#include "condyle/error.hpp"
#include "core/parallel.hpp"
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
          contact.articular};
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
  JointKind kind;
  Side side;
  LeftOut left_out;
  std::optional<ArticularRegion> articular;
  CountingBody fixed, mobile;
  motion::RotationTable flexion_table, rotation_table;

  /// What one thread keeps: both bodies ready to turn, and the table of the flexion it last adducted at.
  struct Worker {
    motion::TurningBody fixed, mobile;
    std::optional<Angle> flexion;
    std::unique_ptr<motion::RotationTable> adduction_table;

    explicit Worker(const Parts& parts) : fixed(parts.fixed.tree), mobile(parts.mobile.tree) {}
  };
  mutable tbb::enumerable_thread_specific<Worker> workers;

  Parts(const Joint& joint, motion::PartsOfJoint counting)
      : kind(joint.kind),
        side(joint.side),
        left_out{counting.fixed.left_out(joint.fixed.mesh), counting.mobile.left_out(joint.mobile.mesh)},
        fixed(std::move(counting.fixed)),
        mobile(std::move(counting.mobile)),
        flexion_table(fixed.tree, flexion_axis(side)),
        rotation_table(mobile.tree, rotation_axis_in_M(side)),
        workers([this] { return Worker(*this); }) {}

  const motion::RotationTable& adduction_table(Worker& worker, const JointAngles& start) const {
    if (worker.flexion != start.flexion) {
      worker.adduction_table = std::make_unique<motion::RotationTable>(
          fixed.tree, AxisFrame(Vec3::Zero(), axis_of(JointAngle::adduction, side, start)));
      worker.flexion = start.flexion;
    }
    return *worker.adduction_table;
  }

  /// As the search reports it, in terms of the whole bodies and labelled.
  void finish(Limit& limit, JointAngle vary) const {
    if (!limit.contact) return;
    ContactWitness& contact = *limit.contact;
    if (vary == JointAngle::internal_rotation) contact = exchanged(contact);
    contact.fixed_feature = fixed.in_whole(contact.fixed_feature);
    contact.mobile_feature = mobile.in_whole(contact.mobile_feature);
    contact.articular = articular && articular->holds(contact.fixed_point);
  }
};

RangeOfMotion::RangeOfMotion(const Joint& joint, const RangeOptions& options)
    : parts_(std::make_unique<Parts>(joint, motion::parts_that_count(joint, options.overlap))) {
  parts_->articular = options.articular ? options.articular : find_articular_region(joint);
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
  const Pose X_FM = pose_at(side(), start);
  const auto search = [&](const motion::RotationTable& table, motion::TurningBody& body, const Pose& X) {
    body.start_at(table.frame(), X);
    return motion::first_contact(table, body, range);
  };
  RotationLimits limits =
      vary == JointAngle::internal_rotation ? search(parts_->rotation_table, worker.fixed, X_FM.inverse())
      : vary == JointAngle::adduction ? search(parts_->adduction_table(worker, start), worker.mobile, X_FM)
                                      : search(parts_->flexion_table, worker.mobile, X_FM);
  parts_->finish(limits.negative, vary);
  parts_->finish(limits.positive, vary);
  return limits;
}

MotionLimit RangeOfMotion::limit(const Motion& motion) const {
  check_motion(motion, kind());
  const bool grows = motion.sense == RotationSense::positive;
  const RotationRange range{.negative = grows ? Angle() : -motion.range,
                            .positive = grows ? motion.range : Angle()};
  RotationLimits both = both_limits(motion.vary, motion.start, range);
  return {motion, std::move(grows ? both.positive : both.negative)};
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
const std::optional<ArticularRegion>& RangeOfMotion::articular_region() const noexcept {
  return parts_->articular;
}
const LeftOut& RangeOfMotion::left_out() const noexcept {
  return parts_->left_out;
}

}  // namespace condyle
