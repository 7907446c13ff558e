#include "condyle/range_of_motion.hpp"

#include <cmath>

#include "condyle/error.hpp"
#include "core/trigonometry.hpp"
#include "motion/rom/ligament_limits.hpp"
#include "motion/rom/overlap.hpp"
#include "motion/search/path_clearance.hpp"

namespace condyle::motion {
namespace {

/// Finer ones would run into the rounding that clearance() allows for.
constexpr Angle finest_tolerance = Angle::degrees(1e-6);

void check_path(std::span<const JointAngles> waypoints, Angle tolerance, JointKind kind) {
  if (waypoints.size() < 2) throw UsageError("path: needs two waypoints or more");
  if (!(tolerance >= finest_tolerance) || !std::isfinite(tolerance.radians()))
    throw UsageError("path: the tolerance must be 1e-6 degrees or more");
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    for (const JointAngle angle : all_joint_angles) {
      const double value = angle_of(waypoints[i], angle).radians();
      if (!std::isfinite(value)) throw UsageError("path: an angle is not finite");
      if (kind == JointKind::hinge && angle != JointAngle::flexion && value != 0)
        throw UsageError("path: a hinge turns only in flexion");
      if (i > 0 && std::abs(value - angle_of(waypoints[i - 1], angle).radians()) > two_pi)
        throw UsageError("path: an angle changes by more than a full turn between two waypoints");
    }
  }
}

JointAngles between(const JointAngles& from, const JointAngles& to, double fraction) noexcept {
  JointAngles at = from;
  for (const JointAngle angle : all_joint_angles)
    at = turned_by(at, angle, (angle_of(to, angle) - angle_of(from, angle)) * fraction);
  return at;
}

/// At least the angle by which M turns on the way.
double largest_rotation(const JointAngles& from, const JointAngles& to) noexcept {
  const auto change = [&](JointAngle angle) {
    return std::abs((angle_of(to, angle) - angle_of(from, angle)).radians());
  };
  return core::hypotenuse(change(JointAngle::adduction),
                          change(JointAngle::flexion) + change(JointAngle::internal_rotation));
}

}  // namespace

struct PathFinder::Parts {
  RangeOfMotion range;
  PartsOfJoint included;
  Mesh whole_fixed, whole_mobile;
  std::vector<FeatureTree> fixed = {}, mobile = {};

  Parts(const Joint& joint, const RangeOptions& options)
      : range(joint, options),
        included(motion::parts_that_count(joint, options.overlap, range.bearing(), range.bearing_rule())),
        whole_fixed(joint.fixed.mesh),
        whole_mobile(joint.mobile.mesh) {
    for (const PartOfMesh& part : included.fixed) fixed.emplace_back(part.mesh);
    for (const PartOfMesh& part : included.mobile) mobile.emplace_back(part.mesh);
  }

  /// The clearance of the parts that are free for least.
  struct Nearest {
    Clearance clearance;
    PairOfParts parts;
  };
  std::optional<Nearest> nearest_at(const Pose& X_FM) const {
    std::optional<Nearest> nearest;
    for (const PairOfParts& pair : included.impinging) {
      const auto found = motion::clearance(fixed[pair.fixed], mobile[pair.mobile], X_FM, motion::far_enough);
      if (found && (!nearest || found->free_for < nearest->clearance.free_for)) nearest = {*found, pair};
    }
    return nearest;
  }

  ContactWitness witness(const Nearest& nearest, const Pose& X_FM) const {
    const auto& [near, parts] = nearest;
    const Index of_fixed = fixed[parts.fixed].mesh_triangle(near.fixed_triangle);
    const Index of_mobile = mobile[parts.mobile].mesh_triangle(near.mobile_triangle);
    ContactWitness contact{{FeatureKind::face, included.fixed[parts.fixed].triangle_in_whole[of_fixed]},
                           {FeatureKind::face, included.mobile[parts.mobile].triangle_in_whole[of_mobile]},
                           near.fixed_point,
                           posed(inverted(X_FM), near.mobile_point)};
    contact.kind = range.bearing().kind_of(whole_fixed, whole_mobile, contact);
    return contact;
  }
};

PathFinder::PathFinder(const Joint& joint, const RangeOptions& options) {
  motion::refuse_ending_ligaments(joint, "a path");
  parts_ = std::make_unique<Parts>(joint, options);
}

PathFinder::~PathFinder() = default;

PathLimit PathFinder::limit(std::span<const JointAngles> waypoints, Angle tolerance) const {
  const RangeOfMotion& range = parts_->range;
  check_path(waypoints, tolerance, range.kind());
  PathLimit out;
  out.at = waypoints.front();
  const Limit start = range.both_limits(JointAngle::flexion, out.at, {Angle(), Angle()}).positive;
  if (start.reason == LimitReason::contact_at_start) {
    out.reason = start.reason, out.contact = start.contact;
    return out;
  }
  for (out.segment = 0; out.segment + 1 < waypoints.size(); ++out.segment) {
    const JointAngles &from = waypoints[out.segment], &to = waypoints[out.segment + 1];
    const double rotation = largest_rotation(from, to) * (1 + motion::step_slack);
    for (out.fraction = 0; out.fraction < 1;) {
      out.at = between(from, to, out.fraction);
      const Pose X_FM = pose_at(range.coordinates(), out.at);
      const auto nearest = parts_->nearest_at(X_FM);
      ++out.poses;
      if (nearest && nearest->clearance.free_for < tolerance.radians()) {
        out.reason = LimitReason::contact;
        out.contact = parts_->witness(*nearest, X_FM);
        out.distance_mm = nearest->clearance.distance_mm;
        return out;
      }
      const double free = nearest ? nearest->clearance.free_for : motion::far_enough;
      out.fraction = free < rotation * (1 - out.fraction)
                         ? out.fraction + free / rotation * (1 - motion::step_slack)
                         : 1;
    }
  }
  out.segment = waypoints.size() - 2;
  out.at = waypoints.back();
  return out;
}

}  // namespace condyle::motion
