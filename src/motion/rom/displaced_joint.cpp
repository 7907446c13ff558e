#include "motion/rom/displaced_joint.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "core/parallel.hpp"
#include "motion/rom/ligament_limits.hpp"
#include "motion/rom/overlap.hpp"
#include "motion/search/first_contact.hpp"

namespace condyle::motion {
namespace {

/// Motions that one search about one axis answers: those with the same start that vary the same angle.
struct Group {
  JointAngle vary;
  JointAngles start;
  RotationRange range{Angle(), Angle()};
  std::vector<std::size_t> motions;

  /// Whether the axis is the same in the body that rests.
  bool shares_axis(const Group& other) const noexcept {
    return vary == other.vary && (vary != JointAngle::adduction || start.flexion == other.start.flexion);
  }
};

/// Groups about one axis follow each other.
std::vector<Group> grouped(std::span<const Motion> motions) {
  std::vector<Group> groups;
  std::map<std::tuple<JointAngle, Angle, Angle, Angle>, std::size_t> places;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const Motion& motion = motions[i];
    const JointAngles& start = motion.start;
    const auto [known, is_new] = places.try_emplace(
        {motion.vary, start.flexion, start.adduction, start.internal_rotation}, groups.size());
    if (is_new) groups.push_back({motion.vary, start, {Angle(), Angle()}, {}});
    Group& group = groups[known->second];
    Angle& end = motion.sense == RotationSense::positive ? group.range.positive : group.range.negative;
    const Angle asked = motion.range * sign_of(motion.sense);
    if (std::abs(asked.radians()) > std::abs(end.radians())) end = asked;
    group.motions.push_back(i);
  }
  std::stable_sort(groups.begin(), groups.end(), [](const Group& a, const Group& b) {
    return std::pair(a.vary, a.start.flexion) < std::pair(b.vary, b.start.flexion);
  });
  return groups;
}

/// A body as its search reads it, its surface movable along its normals.
class Surface {
 public:
  Surface(const Joint& joint, BodyRole role, const Mesh& part, const Uncertainty& sigma,
          const kinematics::DisplacedParts& parts)
      : vertices_(joint, role, sigma), parts_(parts), tree_(part) {}

  /// Where its vertices lie: so many times their directions from where they are, or, if its parts move too, here.
  struct Placed {
    double along;
    std::optional<Points> moved;
  };
  Placed moved_by(double standard_deviations, std::span<const double> parameters) const {
    const auto along = vertices_.along_directions(standard_deviations, parts_, parameters);
    return along ? Placed{*along, {}}
                 : Placed{0, vertices_.moved_by(standard_deviations, parts_, parameters)};
  }
  RotatingBody body(const Placed& placed) const {
    return placed.moved ? RotatingBody(tree_, *placed.moved)
           : placed.along == 0
               ? RotatingBody(tree_)
               : RotatingBody(tree_, vertices_.directions(), vertices_.longest_direction(), placed.along);
  }

 private:
  MovableSurface vertices_;
  const kinematics::DisplacedParts& parts_;
  FeatureTree tree_;
};

}  // namespace

struct DisplacedJoint::Parts {
  Parts(const Joint& joint, const PartsOfJoint& parts, const JointAngles& reference,
        std::span<const Motion> motions, const Uncertainty& sigma)
      : system_(joint.coordinates()),
        X_ref_(pose_at(joint.coordinates(), reference)),
        motions_(motions),
        groups_(grouped(motions)),
        impinging_(parts.impinging),
        ligaments_(joint),
        fixed_parts_(joint, BodyRole::fixed),
        mobile_parts_(joint, BodyRole::mobile) {
    for (const PartOfMesh& part : parts.fixed)
      fixed_.emplace_back(joint, BodyRole::fixed, part.mesh, sigma, fixed_parts_);
    for (const PartOfMesh& part : parts.mobile)
      mobile_.emplace_back(joint, BodyRole::mobile, part.mesh, sigma, mobile_parts_);
    met_.resize(impinging_.size() * groups_.size());
  }

  void learn() {
    std::vector<DisplacedLimit> limits(motions_.size());
    take_contacts({}, met_, limits);
  }

  /// Writes one outcome per motion. The frame G of the displaced joint lies at X_FG in F; with both bodies where the
  /// reference pose q0 has them, the mobile body at the angles q is at
  ///
  ///     X_FM = X_FG R(q) A^-1,   A = R(q0)^-1 X_FG R(q0), where G's mobile frame lies in M
  void limits(const Displacement& d, std::span<DisplacedLimit> out) const {
    std::vector<LeavesAtEnds> met = met_;
    take_contacts(d, met, out);
    if (!ligaments_.empty()) take_ligaments(d, out);
  }

 private:
  /// Where surfaces end a motion; by pair and group the leaves to compare first, and then those that met.
  void take_contacts(const Displacement& d, std::span<LeavesAtEnds> met,
                     std::span<DisplacedLimit> out) const {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = {motions_[i].range, LimitReason::end_of_range};
    for (std::size_t pair = 0; pair < impinging_.size(); ++pair)
      take_contacts(d, pair, met.subspan(pair * groups_.size()), out);
  }
  void take_contacts(const Displacement& d, std::size_t pair, std::span<LeavesAtEnds> met,
                     std::span<DisplacedLimit> out) const {
    const Surface &of_fixed = fixed_[impinging_[pair].fixed], &of_mobile = mobile_[impinging_[pair].mobile];
    const Surface::Placed fixed = of_fixed.moved_by(d.fixed_surface, d.parameters),
                          mobile = of_mobile.moved_by(d.mobile_surface, d.parameters);
    // Only those that a motion turns or lets rest are made.
    std::optional<RotatingBody> stationary_fixed, stationary_mobile, rotating_fixed, rotating_mobile;
    const auto made = [](std::optional<RotatingBody>& body, const Surface& of,
                         const Surface::Placed& placed) -> RotatingBody& {
      return body ? *body : body.emplace(of.body(placed));
    };

    const Pose X_FG = displaced_frame(d);
    const Pose A = inverted(X_ref_) * X_FG * X_ref_;

    const Group* before = nullptr;
    for (const Group& group : groups_) {
      const Pose X_FM = X_FG * pose_at(system_, group.start) * inverted(A);
      const bool turns_fixed = group.vary == JointAngle::internal_rotation;
      RotatingBody& stationary =
          turns_fixed ? made(stationary_mobile, of_mobile, mobile) : made(stationary_fixed, of_fixed, fixed);
      RotatingBody& rotating =
          turns_fixed ? made(rotating_fixed, of_fixed, fixed) : made(rotating_mobile, of_mobile, mobile);
      const AxisFrame axis =
          turns_fixed
              ? AxisFrame(A.translation(), A.linear() * -axis_of(group.vary, system_, {}))
              : AxisFrame(X_FG.translation(), X_FG.linear() * axis_of(group.vary, system_, group.start));
      if (!before || !before->shares_axis(group)) stationary.start_at(axis, Pose::Identity());
      before = &group;
      rotating.start_at(axis, turns_fixed ? inverted(X_FM) : X_FM);
      const RotationLimits both =
          first_contact(stationary, rotating, group.range, &met[&group - groups_.data()]);
      for (const std::size_t i : group.motions) {
        const Limit& end = motions_[i].sense == RotationSense::positive ? both.positive : both.negative;
        if (end.turned < out[i].turned) out[i] = {end.turned, end.reason};
      }
    }
  }

  /// Where a ligament ends a motion sooner than noted: its points stay on the bodies as given, its slack length may be displaced.
  void take_ligaments(const Displacement& d, std::span<DisplacedLimit> out) const {
    const Pose X_FG = displaced_frame(d);
    const Pose A = inverted(X_ref_) * X_FG * X_ref_;
    const LigamentLimits ligaments = ligaments_.displaced(d.parameters);
    for (const Group& group : groups_) {
      RotationLimits both;
      for (const std::size_t i : group.motions) {
        Limit& end = motions_[i].sense == RotationSense::positive ? both.positive : both.negative;
        end.turned = std::max(end.turned, out[i].turned);
      }
      ligaments.take_sooner(both,
                            {X_FG.translation(), X_FG.linear() * axis_of(group.vary, system_, group.start)},
                            X_FG * pose_at(system_, group.start) * inverted(A), group.range);
      for (const std::size_t i : group.motions) {
        const Limit& end = motions_[i].sense == RotationSense::positive ? both.positive : both.negative;
        if (end.ligament && end.turned < out[i].turned) out[i] = {end.turned, end.reason};
      }
    }
  }

  CoordinateSystem system_;
  Pose X_ref_;
  std::span<const Motion> motions_;
  std::vector<Group> groups_;
  std::vector<PairOfParts> impinging_;
  LigamentLimits ligaments_;
  kinematics::DisplacedParts fixed_parts_, mobile_parts_;
  std::vector<Surface> fixed_, mobile_;
  std::vector<LeavesAtEnds> met_;  ///< by the joint as given if that is learnt, by pair and group
};

DisplacedJoint::DisplacedJoint(const Joint& joint, std::span<const Motion> motions, const RangeOptions& range,
                               const Uncertainty& sigma)
    : parts_(std::make_unique<Parts>(
          joint,
          parts_that_count(joint, range.overlap, find_bearing_surface(joint, range.bearing),
                           range.bearing.rule),
          range.overlap.reference_pose, motions, sigma)) {}
DisplacedJoint::~DisplacedJoint() = default;

void DisplacedJoint::learn() {
  parts_->learn();
}

void DisplacedJoint::limits(const Displacement& by, std::span<DisplacedLimit> out) const {
  parts_->limits(by, out);
}

std::vector<DisplacedLimit> limits_about(const Joint& joint, std::span<const Motion> motions,
                                         const RangeOptions& range, std::span<const Vec3> centres) {
  for (const Motion& motion : motions) check_motion(motion, joint.kind);
  const DisplacedJoint displaced(joint, motions, range, {});
  std::vector<DisplacedLimit> limits(centres.size() * motions.size());
  core::parallel_chunks(centres.size(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      displaced.limits({.centre = centres[i]}, std::span(limits).subspan(i * motions.size(), motions.size()));
  });
  return limits;
}

}  // namespace condyle::motion
