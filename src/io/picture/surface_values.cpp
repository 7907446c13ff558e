#include "io/picture/surface_values.hpp"

#include <utility>

#include "condyle/answer.hpp"
#include "mesh/require_solid.hpp"

namespace condyle::io {
namespace {

/// The distance, below zero inside.
std::vector<double> signed_distances(std::vector<double> distances,
                                     const std::optional<radial::RadialResults>& results) {
  if (results)
    for (std::size_t v = 0; v < distances.size(); ++v)
      if (results->state[v] == PointState::inside) distances[v] = -distances[v];
  return distances;
}

SurfaceValues depths_of(std::optional<contact::ReliableDepths> depths, std::vector<double> outside) {
  SurfaceValues values{.mm = std::move(depths->depth_mm), .outside = std::move(outside), .is_bound = {}};
  values.is_bound.reserve(values.mm.size());
  for (const contact::DepthKind kind : depths->kind)
    values.is_bound.push_back(kind == contact::DepthKind::nearest ? 1 : 0);
  return values;
}

}  // namespace

BothValues surface_values(PictureColour colour, const Joint& joint, const JointAngles& at, const Pose& X_FM) {
  if (colour == PictureColour::none) return {};
  if (colour != PictureColour::nearest) {
    mesh::require_solid(joint.fixed.mesh, joint.fixed.name);
    mesh::require_solid(joint.mobile.mesh, joint.mobile.name);
  }
  const contact::JointContact bodies(joint);
  if (colour == PictureColour::gap) {
    contact::RadialContact contact = bodies.radial(X_FM);
    return {
        .fixed = {.mm = std::move(contact.fixed_in_mobile->radial_gap_mm), .outside = {}, .is_bound = {}},
        .mobile = {.mm = std::move(contact.mobile_in_fixed->radial_gap_mm), .outside = {}, .is_bound = {}}};
  }
  const DepthMethod method = colour == PictureColour::nearest ? DepthMethod::radial : DepthMethod::reliable;
  DepthAnswer answer = answer_depth(bodies, joint,
                                    {.X_FM = X_FM,
                                     .pose = at,
                                     .method = method,
                                     .distances = contact::DistancesOf::all_vertices,
                                     .measures = MeasuresOf::distances_only});
  auto& [contact, reliable] = std::get<RayDepths>(answer.depths);
  contact::NearestDistances& distances = answer.measures.distances;
  auto of_fixed = signed_distances(std::move(distances.fixed), contact.fixed_in_mobile);
  auto of_mobile = signed_distances(std::move(distances.mobile), contact.mobile_in_fixed);
  if (colour == PictureColour::nearest)
    return {.fixed = {.mm = std::move(of_fixed), .outside = {}, .is_bound = {}},
            .mobile = {.mm = std::move(of_mobile), .outside = {}, .is_bound = {}}};
  return {.fixed = depths_of(std::move(reliable.fixed), std::move(of_fixed)),
          .mobile = depths_of(std::move(reliable.mobile), std::move(of_mobile))};
}

}  // namespace condyle::io
