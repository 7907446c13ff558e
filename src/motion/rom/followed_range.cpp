#include <algorithm>
#include <cmath>
#include <utility>

#include "condyle/error.hpp"
#include "condyle/range_of_motion.hpp"
#include "mesh/surface_to_surface.hpp"
#include "motion/rom/ligament_limits.hpp"
#include "motion/rom/overlap.hpp"
#include "motion/search/path_clearance.hpp"

namespace condyle::motion {
namespace {

/// Finer ones would run into the rounding that clearance() allows for.
constexpr Angle finest = Angle::degrees(1e-6);

/// Contact is searched this many tolerances past the end of the search.
constexpr int most_tolerances_past = 64;

using Knots = std::span<const TranslationKnot>;

/// The path of the mobile body along one motion.
class FollowedTranslation {
 public:
  FollowedTranslation(const Joint& joint, const Motion& motion)
      : system_(joint.coordinates()), frame_(joint.translation_frame), motion_(motion) {}

  Pose pose(const TranslationKnot& at) const {
    const Angle by = at.turned * sign_of(motion_.sense);
    return pose_at(system_, JointCoordinates{turned_by(motion_.start, motion_.vary, by), at.translation_mm},
                   frame_);
  }
  /// How fast the body moves between two knots, per radian. Axes turn no faster than the angle, and a translation along them with them.
  Speed speed(const TranslationKnot& from, const TranslationKnot& to) const {
    const Vec3 &a = from.translation_mm, &b = to.translation_mm;
    const double along = (b - a).norm() / (to.turned - from.turned).radians();
    const double about =
        frame_ == TranslationFrame::fixed ? 0 : a.cwiseAbs().sum() + (b - a).cwiseAbs().sum();
    return {.rotation = 1 + motion::step_slack, .origin_mm = (along + about) * (1 + motion::step_slack)};
  }

 private:
  CoordinateSystem system_;
  TranslationFrame frame_;
  const Motion& motion_;
};

TranslationKnot between(const TranslationKnot& from, const TranslationKnot& to, Angle turned) {
  const double share = (turned - from.turned).radians() / (to.turned - from.turned).radians();
  return {turned, from.translation_mm + share * (to.translation_mm - from.translation_mm)};
}

/// Where knots, as far as they are known, bring the body; the last one beyond their end.
TranslationKnot knot_at(Knots knots, Angle turned) {
  for (std::size_t i = 1; i < knots.size(); ++i)
    if (turned <= knots[i].turned) return between(knots[i - 1], knots[i], turned);
  return knots.back();
}

}  // namespace

struct FollowedRange::Parts {
  Joint joint;
  BearingFinding bearing;
  BearingRule rule;
  PartsOfJoint included;
  std::vector<FeatureTree> fixed = {}, mobile = {};

  Parts(const Joint& of, const BearingOptions& options)
      : joint(of),
        bearing(find_bearing_surface(of, options)),
        rule(bearing.roles.distinguish_bearing() ? options.rule : BearingRule::count),
        included(motion::parts_that_count(of, {}, bearing, rule)) {
    for (const PartOfMesh& part : included.fixed) fixed.emplace_back(part.mesh);
    for (const PartOfMesh& part : included.mobile) mobile.emplace_back(part.mesh);
  }

  /// Two triangles that less than the tolerance brings together.
  struct Met {
    Angle turned;
    Clearance clearance;
    PairOfParts parts;
    Pose X_FM;
  };

  using PartPairs = std::span<const PairOfParts>;

  /// The pair of parts that the motion can bring together first.
  std::optional<std::pair<Clearance, PairOfParts>> nearest(PartPairs pairs, const Pose& X_FM,
                                                           const Speed& speed) const {
    std::optional<std::pair<Clearance, PairOfParts>> found;
    for (const PairOfParts& pair : pairs) {
      const double least = found ? found->first.free_for : motion::far_enough;
      const auto near = motion::clearance(fixed[pair.fixed], mobile[pair.mobile], X_FM, least, speed);
      if (near) found = {*near, pair};
    }
    return found;
  }

  /// First contact of these between two knots; empty if there is none, or it was stopped.
  std::optional<Met> first_met(PartPairs pairs, const FollowedTranslation& path, const TranslationKnot& from,
                               const TranslationKnot& to, Angle tolerance, const std::stop_token& stop,
                               std::size_t& poses) const {
    const Speed speed = path.speed(from, to);
    for (Angle turned = from.turned; turned < to.turned && !stop.stop_requested();) {
      const Pose X_FM = path.pose(between(from, to, turned));
      const auto near = nearest(pairs, X_FM, speed);
      ++poses;
      if (near && near->first.free_for < tolerance.radians())
        return Met{turned, near->first, near->second, X_FM};
      const Angle free =
          Angle::radians((near ? near->first.free_for : motion::far_enough) * (1 - motion::step_slack));
      turned = free < to.turned - turned ? turned + free : to.turned;
    }
    return std::nullopt;
  }

  ContactWitness witness(const Met& met) const {
    const auto& [turned, near, parts, X_FM] = met;
    const Index of_fixed = fixed[parts.fixed].mesh_triangle(near.fixed_triangle);
    const Index of_mobile = mobile[parts.mobile].mesh_triangle(near.mobile_triangle);
    ContactWitness contact{{FeatureKind::face, included.fixed[parts.fixed].triangle_in_whole[of_fixed]},
                           {FeatureKind::face, included.mobile[parts.mobile].triangle_in_whole[of_mobile]},
                           near.fixed_point,
                           posed(inverted(X_FM), near.mobile_point)};
    contact.kind = parts.kind == ContactKind::soft || parts.kind == ContactKind::bearing
                       ? parts.kind
                       : bearing.kind_of(joint.fixed.mesh, joint.mobile.mesh, contact);
    return contact;
  }

  /// How far past it these parts meet, or the tolerance.
  Angle error_bound(const Met& met, const FollowedTranslation& path, Knots knots, Angle tolerance) const {
    for (int past = 1; past <= most_tolerances_past; past *= 2) {
      const Pose X_FM = path.pose(knot_at(knots, met.turned + tolerance * past));
      const auto points = mesh::closest_points(fixed[met.parts.fixed].triangle_tree(),
                                               mobile[met.parts.mobile].triangle_tree(), X_FM);
      if (points && points->distance_mm == 0) return tolerance * past;
    }
    return tolerance;
  }

  /// Whether bodies are in contact where a motion starts: exactly, as seen from the mobile body's origin.
  Limit start_of(const Motion& motion, const FollowedTranslation& path, const TranslationKnot& start) const {
    RangeOptions options{.bearing = {.rule = rule, .surface = bearing.surface, .roles = bearing.roles}};
    options.overlap.reference_contact = ReferenceContact::accept;
    const Vec3 origin = path.pose(start).translation();
    Limit limit = RangeOfMotion(held_at(joint, origin), options)
                      .both_limits(motion.vary, motion.start, {Angle(), Angle()})
                      .positive;
    if (limit.contact) limit.contact->fixed_point += origin;
    return limit;
  }

  /// The first contact of one kind that ends nothing, up to the limit.
  std::optional<EarlierContact> earlier(ContactKind kind, const FollowedTranslation& path, Knots knots,
                                        Angle limit, Angle tolerance, const std::stop_token& stop,
                                        std::size_t& poses) const {
    std::vector<PairOfParts> pairs;
    for (const PairOfParts& pair : included.earlier)
      if (pair.kind == kind) pairs.push_back(pair);
    for (std::size_t i = 1; !pairs.empty() && i < knots.size() && knots[i - 1].turned < limit; ++i) {
      const auto met = first_met(pairs, path, knots[i - 1], knots[i], tolerance, stop, poses);
      if (!met) continue;
      if (!(met->turned < limit)) return std::nullopt;
      return EarlierContact{met->turned, witness(*met), error_bound(*met, path, knots, tolerance)};
    }
    return std::nullopt;
  }
};

FollowedRange::FollowedRange(const Joint& joint, const BearingOptions& bearing) {
  if (joint.kind != JointKind::free) throw UsageError("only a free joint translates");
  motion::refuse_ending_ligaments(joint, "a range whose translation follows");
  parts_ = std::make_unique<Parts>(joint, bearing);
}
FollowedRange::~FollowedRange() = default;

const BearingFinding& FollowedRange::bearing() const noexcept {
  return parts_->bearing;
}
BearingRule FollowedRange::bearing_rule() const noexcept {
  return parts_->rule;
}

std::optional<FollowedLimit> FollowedRange::limit(const Motion& motion, const NextKnot& next,
                                                  const std::stop_token& stop, Angle tolerance) const {
  check_motion(motion, parts_->joint.kind);
  if (!(tolerance >= finest) || !std::isfinite(tolerance.radians()))
    throw UsageError("the tolerance of a limit must be 1e-6 degrees or more");
  std::vector<TranslationKnot> knots;
  // False where the knots end.
  const auto take_next = [&] {
    const std::optional<TranslationKnot> knot = next(knots);
    if (!knot) return false;
    if (!(knots.empty() ? knot->turned == Angle() : knot->turned > knots.back().turned) ||
        !std::isfinite(knot->turned.radians()) || !knot->translation_mm.allFinite())
      throw UsageError("the knots of a translation begin at the motion's start and ascend");
    knots.push_back(*knot);
    return true;
  };
  const FollowedTranslation path(parts_->joint, motion);
  FollowedLimit out{.limit = {.motion = motion}};
  Limit& end = out.limit.end;
  if (!take_next()) {
    out.limit.motion.range = Angle();
    return out;
  }
  out.limit.translation_mm = knots.front().translation_mm;
  if (Limit start = parts_->start_of(motion, path, knots.front());
      start.reason == LimitReason::contact_at_start) {
    end = std::move(start);
    return out;
  }
  while (end.reason == LimitReason::end_of_range && end.turned < motion.range && take_next()) {
    const auto met = parts_->first_met(parts_->included.impinging, path, knots[knots.size() - 2],
                                       knots.back(), tolerance, stop, out.poses);
    if (stop.stop_requested()) return std::nullopt;
    const Angle reached = met ? met->turned : knots.back().turned;
    if (!(reached < motion.range)) {
      end.turned = motion.range;
    } else if (met) {
      end.reason = LimitReason::contact, end.turned = reached, end.contact = parts_->witness(*met);
      end.error_bound = parts_->error_bound(*met, path, knots, tolerance);
      out.distance_mm = met->clearance.distance_mm;
    } else {
      end.turned = reached;
    }
  }
  if (end.reason == LimitReason::end_of_range) out.limit.motion.range = end.turned;
  out.limit.translation_mm = knot_at(knots, end.turned).translation_mm;
  end.bearing_contact =
      parts_->earlier(ContactKind::bearing, path, knots, end.turned, tolerance, stop, out.poses);
  end.soft_contact = parts_->earlier(ContactKind::soft, path, knots, end.turned, tolerance, stop, out.poses);
  return stop.stop_requested() ? std::nullopt : std::optional(std::move(out));
}

}  // namespace condyle::motion
