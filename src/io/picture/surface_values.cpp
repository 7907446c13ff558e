#include "io/picture/surface_values.hpp"

#include <utility>

#include "condyle/contact_measures.hpp"
#include "condyle/reliable_depth.hpp"
#include "mesh/require_solid.hpp"

namespace condyle::io {
namespace {

/// The distance, below zero inside.
std::vector<double> signed_distances(std::vector<double> distances,
                                     const std::optional<RadialResults>& results) {
  if (results)
    for (std::size_t v = 0; v < distances.size(); ++v)
      if (results->state[v] == PointState::inside) distances[v] = -distances[v];
  return distances;
}

SurfaceValues depths_of(std::optional<ReliableDepths> depths, std::vector<double> outside) {
  SurfaceValues values{.mm = std::move(depths->depth_mm), .outside = std::move(outside), .is_bound = {}};
  values.is_bound.reserve(values.mm.size());
  for (const DepthWay way : depths->way) values.is_bound.push_back(way == DepthWay::nearest ? 1 : 0);
  return values;
}

}  // namespace

BothValues surface_values(PictureColour colour, const Joint& joint, const JointAngles& at, const Pose& X_FM) {
  if (colour == PictureColour::none) return {};
  if (colour != PictureColour::nearest) {
    mesh::require_solid(joint.fixed.mesh, joint.fixed.name);
    mesh::require_solid(joint.mobile.mesh, joint.mobile.name);
  }
  const JointContact bodies(joint);
  RadialContact contact = bodies.radial(X_FM);
  if (colour == PictureColour::gap)
    return {
        .fixed = {.mm = std::move(contact.fixed_in_mobile->radial_gap_mm), .outside = {}, .is_bound = {}},
        .mobile = {.mm = std::move(contact.mobile_in_fixed->radial_gap_mm), .outside = {}, .is_bound = {}}};
  const ContactMeasures measures = measure_contact(bodies, X_FM, VertexStates(contact));
  auto of_fixed = signed_distances(measures.distances.fixed, contact.fixed_in_mobile);
  auto of_mobile = signed_distances(measures.distances.mobile, contact.mobile_in_fixed);
  if (colour == PictureColour::nearest)
    return {.fixed = {.mm = std::move(of_fixed), .outside = {}, .is_bound = {}},
            .mobile = {.mm = std::move(of_mobile), .outside = {}, .is_bound = {}}};
  // About which axis a pose that translates would turn depends on how it got there.
  ReliableContact reliable =
      X_FM.translation() == Vec3::Zero()
          ? reliable_depths(bodies, joint.kind, joint.coordinates(), at, contact, measures.distances)
          : reliable_radial_depths(contact, measures.distances);
  return {.fixed = depths_of(std::move(reliable.fixed), std::move(of_fixed)),
          .mobile = depths_of(std::move(reliable.mobile), std::move(of_mobile))};
}

}  // namespace condyle::io
