#include "io/picture/surface_values.hpp"

#include <algorithm>
#include <utility>

#include "condyle/answer.hpp"
#include "core/parallel.hpp"
#include "mesh/require_solid.hpp"
#include "mesh/surface_distance.hpp"

namespace condyle::io {
namespace {

/// Between the corners of a triangle a colour depends on how far outside they are only if not all are outside: those of such triangles.
std::vector<char> beside_the_inside(const TriMesh& mesh, const std::vector<PointState>& states) {
  std::vector<char> is_beside(states.size());
  for (const Triangle& triangle : mesh.triangles)
    if (std::any_of(triangle.begin(), triangle.end(),
                    [&](Index v) { return states[v] != PointState::outside; }))
      for (const Index v : triangle) is_beside[v] = 1;
  return is_beside;
}

/// Stands for the distance of a vertex outside that changes no colour.
constexpr double somewhere_outside_mm = 1;

/// The distance of each vertex to the other body's surface, below zero inside. `distances` has those of vertices inside, `X` takes vertices
/// into the other body's frame.
std::vector<double> signed_distances(const Mesh& mesh, const Mesh& other, const Pose& X,
                                     const std::optional<radial::RadialResults>& results,
                                     PictureColour colour, std::vector<double> distances) {
  const std::vector<char> is_beside = colour == PictureColour::depth
                                          ? beside_the_inside(mesh.arrays(), results->state)
                                          : std::vector<char>(distances.size(), 1);
  const auto tree = mesh::tree_of(other);
  const mesh::DistancesToSurface distance(*tree);
  core::parallel_chunks(distances.size(), 256, [&](std::size_t first, std::size_t last) {
    Index nearest = no_index;
    for (std::size_t v = first; v < last; ++v)
      if (results && results->state[v] == PointState::inside)
        distances[v] = -distances[v];
      else
        distances[v] = is_beside[v] ? distance(posed(X, mesh.vertices()[v]), nearest) : somewhere_outside_mm;
  });
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
  DepthAnswer answer = answer_depth(
      bodies, joint, {.X_FM = X_FM, .pose = at, .method = method, .measures = MeasuresOf::distances_only});
  auto& [contact, reliable] = std::get<RayDepths>(answer.depths);
  contact::NearestDistances& distances = answer.measures.distances;
  auto of_fixed = signed_distances(joint.fixed.mesh, joint.mobile.mesh, inverted(X_FM),
                                   contact.fixed_in_mobile, colour, std::move(distances.fixed));
  auto of_mobile = signed_distances(joint.mobile.mesh, joint.fixed.mesh, X_FM, contact.mobile_in_fixed,
                                    colour, std::move(distances.mobile));
  if (colour == PictureColour::nearest)
    return {.fixed = {.mm = std::move(of_fixed), .outside = {}, .is_bound = {}},
            .mobile = {.mm = std::move(of_mobile), .outside = {}, .is_bound = {}}};
  return {.fixed = depths_of(std::move(reliable.fixed), std::move(of_fixed)),
          .mobile = depths_of(std::move(reliable.mobile), std::move(of_mobile))};
}

}  // namespace condyle::io
