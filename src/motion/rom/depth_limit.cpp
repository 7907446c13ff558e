#include "condyle/range_of_motion.hpp"

#include <cmath>

#include "condyle/contact.hpp"
#include "condyle/error.hpp"
#include "motion/rom/ligament_limits.hpp"
#include "radial/exact/ray_scan.hpp"

namespace condyle::motion {
namespace {

/// Parts of the first too deep step that are tried before halving.
constexpr int parts_of_step = 10;

void check(const AllowedDepth& allowed) {
  if (!(allowed.depth_mm >= 0) || !std::isfinite(allowed.depth_mm))
    throw UsageError("allowed depth: must be 0 mm or more");
  if (!(allowed.tolerance.radians() > 0) || !(allowed.step >= allowed.tolerance) ||
      !std::isfinite(allowed.step.radians()))
    throw UsageError("allowed depth: the tolerance must be above 0 and at most the step");
}

/// A vertex of one body in the other, and the triangle that it leaves through.
struct DeepVertex {
  Index vertex, triangle;
  double depth_mm;
};

/// The first in number of those that are deepest.
std::optional<DeepVertex> deepest_vertex(const radial::Penetrations& inside) {
  std::optional<DeepVertex> deepest;
  for (std::size_t i = 0; i < inside.size(); ++i) {
    if (inside.state[i] != PointState::inside) continue;
    const DeepVertex at{inside.point[i], inside.triangle[i], inside.depth_mm[i]};
    if (!deepest || std::pair(-at.depth_mm, at.vertex) < std::pair(-deepest->depth_mm, deepest->vertex))
      deepest = at;
  }
  return deepest;
}

Angle angle_to_ray(const Vec3& v, const TriMesh& mesh, Index triangle) {
  return triangle == no_index ? Angle() : radial::angle_to_normal(v, radial::cone_of(mesh, triangle));
}

/// How far along its motion a search got: allowed at `free`, too deep at `deep`.
struct Bracket {
  Angle free, deep;
};
enum class EndOfBracket { unknown, too_deep };

}  // namespace

struct DepthRange::Parts {
  JointKind kind;
  CoordinateSystem system;
  AllowedDepth allowed;
  BearingFinding bearing;
  contact::JointContact contact;
};

DepthRange::DepthRange(const Joint& joint, const AllowedDepth& allowed) {
  check(allowed);
  motion::refuse_ending_ligaments(joint, "a range with an allowed depth");
  parts_ = std::make_unique<Parts>(Parts{joint.kind, joint.coordinates(), allowed,
                                         find_bearing_surface(joint), contact::JointContact(joint)});
  for (const auto& [body, table] : {std::pair{&joint.fixed, &parts_->contact.fixed_table()},
                                    std::pair{&joint.mobile, &parts_->contact.mobile_table()}})
    if (!table->is_closed()) throw MeshError(body->name + ": is open: depth needs an inside");
}

DepthRange::~DepthRange() = default;

DeepestPlace DepthRange::deepest(const JointAngles& at) const {
  const Pose X = pose_at(parts_->system, at);
  DeepestPlace deepest;
  const Pose X_MF = inverted(X);
  const TriMesh &fixed = parts_->contact.fixed(), &mobile = parts_->contact.mobile();
  radial::Penetrations found;
  parts_->contact.mobile_in_fixed(X, found);
  const auto m = deepest_vertex(found);
  parts_->contact.fixed_in_mobile(X, found);
  const auto f = deepest_vertex(found);
  if (m && (!f || m->depth_mm >= f->depth_mm)) {
    const Vec3 p = mobile.vertices[m->vertex], in_fixed = posed(X, p);
    deepest.depth_mm = m->depth_mm;
    deepest.ray_to_normal = angle_to_ray(in_fixed, fixed, m->triangle);
    deepest.contact =
        ContactWitness{{FeatureKind::face, m->triangle}, {FeatureKind::vertex, m->vertex}, in_fixed, p};
  } else if (f) {
    const Vec3 p = fixed.vertices[f->vertex], in_mobile = posed(X_MF, p);
    deepest.depth_mm = f->depth_mm;
    deepest.ray_to_normal = angle_to_ray(in_mobile, mobile, f->triangle);
    deepest.contact =
        ContactWitness{{FeatureKind::vertex, f->vertex}, {FeatureKind::face, f->triangle}, p, in_mobile};
  }
  return deepest;
}

DepthLimit DepthRange::limit(const Motion& motion) const {
  check_motion(motion, parts_->kind);
  const AllowedDepth& allowed = parts_->allowed;
  const double sign = sign_of(motion.sense);
  const auto at = [&](Angle by) { return deepest(turned_by(motion.start, motion.vary, by * sign)); };

  DepthLimit out;
  out.limit.motion = motion;
  out.limit.end.error_bound = allowed.tolerance;
  out.at_limit = at(Angle());
  out.start_depth_mm = out.at_limit.depth_mm;
  const auto finish = [&](LimitReason reason, Angle turned) {
    Limit& end = out.limit.end;
    end.reason = reason, end.turned = turned;
    if (reason == LimitReason::end_of_range) return out;
    end.contact = out.at_limit.contact;
    if (end.contact)
      end.contact->kind =
          parts_->bearing.kind_of(parts_->contact.fixed(), parts_->contact.mobile(), *end.contact);
    return out;
  };
  if (out.start_depth_mm > allowed.depth_mm) return finish(LimitReason::contact_at_start, Angle());

  // Moves the bracket to the first of `count` equal parts whose end is too deep; false if none is.
  const auto narrow = [&](Bracket& bracket, int count, EndOfBracket end) {
    const Angle from = bracket.free, width = bracket.deep - bracket.free;
    const int tried = end == EndOfBracket::too_deep ? count - 1 : count;
    for (int k = 1; k <= tried; ++k) {
      const Angle by = k == count ? bracket.deep : from + width * (static_cast<double>(k) / count);
      DeepestPlace place = at(by);
      if (end == EndOfBracket::too_deep && place.depth_mm < out.at_limit.depth_mm) out.depth_grows = false;
      if (place.depth_mm > allowed.depth_mm) {
        bracket.deep = by;
        return true;
      }
      bracket.free = by;
      out.at_limit = std::move(place);
    }
    return end == EndOfBracket::too_deep;
  };
  const int steps = static_cast<int>(std::ceil(motion.range.radians() / allowed.step.radians()));
  Bracket bracket{Angle(), motion.range};
  if (!narrow(bracket, steps, EndOfBracket::unknown)) return finish(LimitReason::end_of_range, motion.range);
  narrow(bracket, parts_of_step, EndOfBracket::too_deep);
  while (bracket.deep - bracket.free > allowed.tolerance) narrow(bracket, 2, EndOfBracket::too_deep);
  if (!out.at_limit.contact) out.at_limit.contact = at(bracket.deep).contact;
  return finish(LimitReason::contact, bracket.free);
}

std::vector<DepthLimit> DepthRange::limits(std::span<const Motion> motions) const {
  std::vector<DepthLimit> out;
  for (const Motion& motion : motions) out.push_back(limit(motion));
  return out;
}

const BearingFinding& DepthRange::bearing() const noexcept {
  return parts_->bearing;
}

}  // namespace condyle::motion
