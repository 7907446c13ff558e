#include "io/picture/surface_values.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "condyle/answer.hpp"
#include "condyle/error.hpp"
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
template <class Results>
std::vector<double> signed_distances(const Mesh& mesh, const Mesh& other, const Pose& X,
                                     const std::optional<Results>& results, PictureColour colour,
                                     std::vector<double> distances) {
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

/// Where no arc frees a vertex inside its nearest distance is a bound.
SurfaceValues arcs_of(const tangential::TangentialResults& results, std::vector<double> outside) {
  SurfaceValues values{.mm = std::vector<double>(outside.size()),
                       .outside = std::move(outside),
                       .is_bound = std::vector<double>(results.size())};
  for (std::size_t v = 0; v < results.size(); ++v) {
    if (results.state[v] != PointState::inside) continue;
    values.is_bound[v] = std::isfinite(results.arc_gap_mm[v]) ? 0 : 1;
    values.mm[v] = values.is_bound[v] == 0 ? -results.arc_gap_mm[v] : -values.outside[v];
  }
  return values;
}

}  // namespace

BothValues surface_values(PictureColour colour, const Joint& joint, const JointAngles& at, const Pose& X_FM,
                          const std::optional<contact::ArcsAbout>& about) {
  if (about && colour != PictureColour::depth) throw UsageError("about: is for the colours of depths");
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
  const DepthMethod method = colour == PictureColour::nearest ? DepthMethod::radial
                             : about                          ? DepthMethod::tangential
                                                              : DepthMethod::reliable;
  DepthAnswer answer = answer_depth(
      bodies, joint,
      {.X_FM = X_FM, .pose = at, .method = method, .about = about, .measures = MeasuresOf::distances_only});
  contact::NearestDistances& distances = answer.measures.distances;
  const auto outside = [&](const auto& contact) {
    return std::pair(signed_distances(joint.fixed.mesh, joint.mobile.mesh, inverted(X_FM),
                                      contact.fixed_in_mobile, colour, std::move(distances.fixed)),
                     signed_distances(joint.mobile.mesh, joint.fixed.mesh, X_FM, contact.mobile_in_fixed,
                                      colour, std::move(distances.mobile)));
  };
  if (const auto* arcs = std::get_if<ArcDepths>(&answer.depths)) {
    auto [of_fixed, of_mobile] = outside(arcs->contact);
    return {.fixed = arcs_of(*arcs->contact.fixed_in_mobile, std::move(of_fixed)),
            .mobile = arcs_of(*arcs->contact.mobile_in_fixed, std::move(of_mobile))};
  }
  auto& [contact, reliable] = std::get<RayDepths>(answer.depths);
  auto [of_fixed, of_mobile] = outside(contact);
  if (colour == PictureColour::nearest)
    return {.fixed = {.mm = std::move(of_fixed), .outside = {}, .is_bound = {}},
            .mobile = {.mm = std::move(of_mobile), .outside = {}, .is_bound = {}}};
  return {.fixed = depths_of(std::move(reliable.fixed), std::move(of_fixed)),
          .mobile = depths_of(std::move(reliable.mobile), std::move(of_mobile))};
}

}  // namespace condyle::io
