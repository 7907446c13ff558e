#include "condyle/first_contact.hpp"

#include <cmath>

#include "condyle/error.hpp"
#include "fuzz/brute_contact.hpp"
#include "fuzz/fuzz_input.hpp"
#include "fuzz/one_line.hpp"
#include "fuzz/targets.hpp"

namespace condyle::test {
namespace {

constexpr double largest_bound = 4e-12;  // rad, as promised

bool names_a_feature(const motion::Feature& feature, const Mesh& mesh) {
  const std::size_t vertices = mesh.vertices().size();
  switch (feature.kind) {
    case motion::FeatureKind::vertex:
      return feature.id < vertices;
    case motion::FeatureKind::edge:
      return feature.id < feature.other_end && feature.other_end < vertices;
    default:
      return feature.id < mesh.triangles().size();
  }
}

std::string fault_of(const motion::Limit& limit, double most, const Mesh& fixed, const Mesh& mobile) {
  const double turned = limit.turned.radians(), bound = limit.error_bound.radians();
  if (!(turned >= 0 && turned <= most)) return "a limit out of its range";
  if (!(bound >= 0 && bound <= largest_bound)) return "an error bound that is none";
  if (limit.reason == motion::LimitReason::contact && !limit.contact) return "a contact without a witness";
  if (!limit.contact) return {};
  if (!names_a_feature(limit.contact->fixed_feature, fixed) ||
      !names_a_feature(limit.contact->mobile_feature, mobile))
    return "a witness that is no feature";
  if (!limit.contact->fixed_point.allFinite() || !limit.contact->mobile_point.allFinite())
    return "a point of contact that is not finite";
  return {};
}

/// Half of the free rotation must be free, and must be reported as free if the range ends there.
std::string fault_of_half(const motion::FirstContact& bodies, const Pose& X,
                          const motion::RotationLimits& whole) {
  const motion::RotationRange half{whole.negative.turned * -0.5, whole.positive.turned * 0.5};
  const motion::RotationLimits again = bodies.limits(X, half);
  for (const motion::Limit* limit : {&again.negative, &again.positive}) {
    if (limit->reason != motion::LimitReason::end_of_range) return "contact on half of a free way";
  }
  if (again.negative.turned != -half.negative || again.positive.turned != half.positive)
    return "a range that is not reached";
  return {};
}

/// About the z axis through the origin nothing is rounded at the start, and no heights are on the way.
std::string fault_of_poses(const motion::RotationLimits& limits, const TriMesh& fixed,
                           const TriMesh& mobile) {
  const bool meets = surfaces_meet(fixed, mobile, Pose::Identity());
  if (meets && limits.free_at_start()) return "free at the start, where surfaces meet";
  if (!meets && limits.positive.reason == motion::LimitReason::contact_at_start && limits.positive.contact)
    return "in contact at the start by surfaces that do not meet";
  if (!limits.free_at_start()) return {};
  // Poses near each other: what rounding makes of one that is missed by a hair it does not make of all.
  const auto meets_at = [&](double angle) {
    Pose X = Pose::Identity();
    X.linear() = Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
    return surfaces_meet(fixed, mobile, X);
  };
  for (const double end : {-limits.negative.turned.radians(), limits.positive.turned.radians()}) {
    if (std::abs(end) < 1e-6) continue;
    if (meets_at(0.5 * end) && meets_at(0.499 * end) && meets_at(0.501 * end))
      return "surfaces that meet on a free way";
  }
  return {};
}

bool is_z_through_origin(const AxisFrame& axis) {
  return axis.point() == Vec3::Zero() && axis.direction() == Vec3(Vec3::UnitZ());
}

}  // namespace

std::string fuzz_first_contact(std::string_view bytes) {
  FuzzInput input(bytes);
  try {
    const AxisFrame axis = input.axis();
    const Mesh fixed = input.mesh(), mobile = input.mesh();
    const Pose X = input.pose();
    const motion::FirstContact bodies(fixed, mobile, axis);
    const motion::RotationLimits limits = bodies.limits(X);
    for (const motion::Limit* limit : {&limits.negative, &limits.positive}) {
      const std::string fault = fault_of(*limit, two_pi, fixed, mobile);
      if (!fault.empty()) return fault;
    }
    if (!limits.free_at_start() && limits.negative.reason != motion::LimitReason::contact_at_start)
      return "in contact at the start on one side only";
    std::string fault = limits.free_at_start() ? fault_of_half(bodies, X, limits) : "";
    if (fault.empty() && is_z_through_origin(axis) && X.matrix() == Pose::Identity().matrix())
      fault = fault_of_poses(limits, fixed, mobile);
    return fault;
  } catch (const MeshError& error) {
    return fault_of_message(error.what());
  } catch (const UsageError& error) {
    return fault_of_message(error.what());
  }
}

}  // namespace condyle::test
