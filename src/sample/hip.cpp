#include "condyle/sample/hip.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "condyle/error.hpp"
#include "sample/checked_mesh.hpp"
#include "sample/femur_shape.hpp"
#include "sample/hip_bone_shape.hpp"
#include "sample/parameter_checks.hpp"
#include "sample/solid_mesh.hpp"
#include "sample/stoppable.hpp"

namespace condyle::sample {
namespace {

using sample::Meshing;
using sample::Solid;

/// Vertices of one bone stay at least this far from the other solid in the neutral pose, mm: what the
/// coarsest triangles sag into head and socket together, rounded up.
constexpr double least_clearance = 1;

/// Wanted edge lengths, relative to the smooth parts far from the joint. Edges about three quarters as long
/// in the joint: flat triangles cut corners off head and socket, which are only some millimetres apart. Half
/// as long at small details: a cap that a single triangle covers would never be found by midpoints laid on
/// the surface.
Meshing meshing_for(const Solid& solid, double sphere_radius, double contour_spacing,
                    std::size_t least_base) {
  const auto sizing = [details = solid.details, sphere_radius](const Vec3& p) {
    constexpr double in_joint = 0.75, at_detail = 0.5, transition_mm = 20, rim_mm = 5;
    const auto grown = [](double from, double distance) {
      return from + (1 - from) * std::clamp(distance / transition_mm, 0.0, 1.0);
    };
    double size = grown(in_joint, p.norm() - sphere_radius - rim_mm);
    for (const auto& [centre, radius] : details) {
      size = std::min(size, grown(at_detail, (p - centre).norm() - radius));
    }
    return size;
  };
  return {sizing, contour_spacing, least_base};
}

TriangleCounts counts(const Resolution& resolution, const Solid& hip_bone, const Meshing& hip_bone_meshing,
                      const Solid& femur, const Meshing& femur_meshing) {
  if (const auto* scenario = std::get_if<Scenario>(&resolution)) {
    const int level = static_cast<int>(*scenario) - 1;
    return {std::size_t{2442} << 2 * level, std::size_t{1542} << 2 * level};
  }
  if (const auto* counts = std::get_if<TriangleCounts>(&resolution)) return *counts;
  const double edge = std::get<EdgeLength>(resolution).mm;
  sample::require_range("edge_length_mm", edge, 0.3, 9, "mm");
  return {sample::triangles_for(hip_bone, hip_bone_meshing, edge),
          sample::triangles_for(femur, femur_meshing, edge)};
}

/// The vertex that comes nearest to the other bone's solid, by that bone's field.
std::pair<double, Vec3> least_value(const Solid& solid, const TriMesh& mesh) {
  std::pair<double, Vec3> least = {std::numeric_limits<double>::infinity(), Vec3::Zero()};
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const double value = solid.field(mesh.vertices[v]).value;
    if (value < least.first) least = {value, mesh.vertices[v]};
  }
  return least;
}

/// Throws sample::Stopped.
SampleHip made(const HipParameters& parameters, const Resolution& resolution, const std::stop_token& stop) {
  sample::require_valid(parameters);
  const Solid hip_bone = sample::stoppable(sample::hip_bone_shape(parameters), stop),
              femur = sample::stoppable(sample::femur_shape(parameters), stop);
  // The thinnest parts, the wing and the ischial spine, are three times as thick as the lattice is wide.
  const double contour_spacing = 2.5 * parameters.head_radius_mm / 24;
  const Meshing hip_bone_meshing =
      meshing_for(hip_bone, parameters.head_radius_mm + parameters.joint_space_mm, contour_spacing, 2000);
  const Meshing femur_meshing = meshing_for(femur, parameters.head_radius_mm, contour_spacing, 1200);

  const TriangleCounts count = counts(resolution, hip_bone, hip_bone_meshing, femur, femur_meshing);
  sample::require_count("hip bone", count.hip_bone, 1600);
  sample::require_count("femur", count.femur, 600);
  SampleHip hip = {sample::checked_mesh("hip bone", hip_bone, hip_bone_meshing, count.hip_bone, 1),
                   sample::checked_mesh("femur", femur, femur_meshing, count.femur, 0)};

  for (const auto& [value, at] : {least_value(femur, hip.hip_bone), least_value(hip_bone, hip.femur)}) {
    if (value < least_clearance) {
      throw UsageError(
          fmt::format("sample hip: with these parameters the bones touch in the neutral pose, near {}",
                      sample::place(at)));
    }
  }
  return hip;
}

}  // namespace

SampleHip sample_hip(const HipParameters& parameters, const Resolution& resolution) {
  return made(parameters, resolution, {});
}

std::optional<SampleHip> sample_hip(const HipParameters& parameters, const Resolution& resolution,
                                    const std::stop_token& stop) {
  try {
    return made(parameters, resolution, stop);
  } catch (const Stopped&) {
    return std::nullopt;
  }
}

TriMesh mirrored(const TriMesh& mesh) {
  TriMesh other = mesh;
  for (double& z : other.vertices.z) z = -z;
  for (auto& triangle : other.triangles) std::swap(triangle[1], triangle[2]);
  return other;
}

SampleHip mirrored(const SampleHip& hip) {
  return {mirrored(hip.hip_bone), mirrored(hip.femur)};
}

}  // namespace condyle::sample
