#include "condyle/contact_measures.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "contact/chosen_arcs.hpp"

namespace condyle::contact {
namespace {

DepthKind kind_about(std::size_t axis) noexcept {
  constexpr std::array kinds{DepthKind::flexion, DepthKind::adduction, DepthKind::internal_rotation};
  return kinds[axis];
}

bool radial_is_depth(const radial::RadialResults& radial, std::span<const double> nearest, Index v) noexcept {
  const DeepestVertex vertex{v, -radial.radial_gap_mm[v], nearest[v], radial.ray_to_normal[v]};
  return vertex.radial_is_depth();
}

/// Vertices of one body whose arcs are read: those inside of which the radial depth is none, and of the others the deepest.
struct RotatedVertices {
  std::vector<Index> vertices;  ///< ascending
  bool any_needs_it = false;
};

RotatedVertices rotated_vertices(const std::optional<radial::RadialResults>& radial,
                                 std::span<const double> nearest) {
  RotatedVertices rotated;
  if (!radial) return rotated;
  std::optional<Index> deepest;
  for (Index v = 0; v < radial->size(); ++v) {
    if (radial->state[v] != PointState::inside) continue;
    if (!radial_is_depth(*radial, nearest, v))
      rotated.vertices.push_back(v);
    else if (!deepest || radial->radial_gap_mm[v] < radial->radial_gap_mm[*deepest])
      deepest = v;
  }
  rotated.any_needs_it = !rotated.vertices.empty();
  auto& vertices = rotated.vertices;
  if (deepest) vertices.insert(std::lower_bound(vertices.begin(), vertices.end(), *deepest), *deepest);
  return rotated;
}

/// Arcs of some vertices of one body about each axis that was asked; none about the others.
struct Rotations {
  std::vector<Index> vertices;
  std::array<tangential::TangentialResults, 3> about;
};

std::array<std::optional<ExitRotation>, 3> exit_rotations(const Rotations& rotations, Index v) {
  std::array<std::optional<ExitRotation>, 3> exits;
  const auto at = std::lower_bound(rotations.vertices.begin(), rotations.vertices.end(), v);
  if (at == rotations.vertices.end() || *at != v) return exits;
  const auto i = static_cast<std::size_t>(at - rotations.vertices.begin());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const tangential::TangentialResults& about = rotations.about[axis];
    if (about.size() == 0 || about.state[i] != PointState::inside) continue;
    const Angle angle = -about.angular_gap[i];
    if (std::isfinite(angle.radians())) exits[axis] = ExitRotation{angle, -about.arc_gap_mm[i]};
  }
  return exits;
}

ReliableDepths depths_of(const radial::RadialResults& radial, std::span<const double> nearest,
                         const Rotations& rotations) {
  ReliableDepths out;
  out.kind.assign(radial.size(), DepthKind::none);
  out.depth_mm.assign(radial.size(), 0);
  for (Index v = 0; v < radial.size(); ++v) {
    if (radial.state[v] != PointState::inside) continue;
    DeepestReliable vertex{v,
                           DepthKind::nearest,
                           nearest[v],
                           nearest[v],
                           -radial.radial_gap_mm[v],
                           radial.ray_to_normal[v],
                           exit_rotations(rotations, v)};
    if (radial_is_depth(radial, nearest, v)) {
      vertex.kind = DepthKind::radial, vertex.depth_mm = vertex.radial_depth_mm;
    } else {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto& rotation = vertex.rotations[axis];
        if (!rotation || (vertex.kind != DepthKind::nearest && rotation->arc_mm >= vertex.depth_mm)) continue;
        vertex.kind = kind_about(axis), vertex.depth_mm = rotation->arc_mm;
      }
    }
    out.kind[v] = vertex.kind;
    out.depth_mm[v] = vertex.depth_mm;
    if (vertex.kind == DepthKind::nearest)
      ++out.without;
    else if (!out.deepest || vertex.depth_mm > out.deepest->depth_mm)
      out.deepest = vertex;
  }
  return out;
}

ReliableContact both(const RadialContact& contact, const NearestDistances& distances,
                     const Rotations& of_mobile, const Rotations& of_fixed) {
  ReliableContact out;
  if (contact.mobile_in_fixed) out.mobile = depths_of(*contact.mobile_in_fixed, distances.mobile, of_mobile);
  if (contact.fixed_in_mobile) out.fixed = depths_of(*contact.fixed_in_mobile, distances.fixed, of_fixed);
  return out;
}

}  // namespace

ReliableContact reliable_depths(const JointContact& joint, JointKind kind, CoordinateSystem system,
                                const JointAngles& pose, const RadialContact& contact,
                                const NearestDistances& distances) {
  RotatedVertices of_mobile = rotated_vertices(contact.mobile_in_fixed, distances.mobile),
                  of_fixed = rotated_vertices(contact.fixed_in_mobile, distances.fixed);
  if (!of_mobile.any_needs_it && !of_fixed.any_needs_it) return reliable_radial_depths(contact, distances);
  const ChosenVertices chosen{std::move(of_mobile.vertices), std::move(of_fixed.vertices)};
  Rotations mobile{chosen.mobile, {}}, fixed{chosen.fixed, {}};
  const std::size_t axes = kind == JointKind::hinge ? 1 : 3;
  for (std::size_t axis = 0; axis < axes; ++axis) {
    ChosenArcs arcs =
        contact::arcs_of(joint, pose_at(system, pose), axis_of(all_joint_angles[axis], system, pose), chosen);
    mobile.about[axis] = std::move(arcs.mobile);
    fixed.about[axis] = std::move(arcs.fixed);
  }
  return both(contact, distances, mobile, fixed);
}

ReliableContact reliable_radial_depths(const RadialContact& contact, const NearestDistances& distances) {
  return both(contact, distances, {}, {});
}

std::optional<DeepestOfBoth> deepest_of(const ReliableContact& contact) {
  std::optional<DeepestOfBoth> deepest;
  const auto offer = [&](bool is_mobile, const std::optional<ReliableDepths>& depths) {
    if (!depths || !depths->deepest) return;
    if (!deepest || depths->deepest->depth_mm > deepest->vertex.depth_mm)
      deepest = {is_mobile, *depths->deepest};
  };
  offer(true, contact.mobile);
  offer(false, contact.fixed);
  return deepest;
}

std::size_t without_depth(const ReliableContact& contact) noexcept {
  return (contact.mobile ? contact.mobile->without : 0) + (contact.fixed ? contact.fixed->without : 0);
}

}  // namespace condyle::contact
