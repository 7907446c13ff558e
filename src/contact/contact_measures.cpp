#include "condyle/contact_measures.hpp"

#include <limits>
#include <optional>

#include "contact/body_pair.hpp"
#include "contact/overlap.hpp"
#include "core/coordinate_range.hpp"
#include "core/parallel.hpp"
#include "mesh/enclosed_volume.hpp"
#include "mesh/surface_distance.hpp"
#include "mesh/surface_to_surface.hpp"

namespace condyle::contact {
namespace {

/// `vertices` are in the frame of the tree.
std::vector<double> distances_of(const Points& vertices,
                                 const std::optional<std::span<const PointState>>& states, DistancesOf which,
                                 const mesh::TriangleTree& tree) {
  std::vector<double> distances(vertices.size(), std::numeric_limits<double>::quiet_NaN());
  std::optional<mesh::DistancesToSurface> all;
  if (which == DistancesOf::all_vertices) all.emplace(tree);
  core::parallel_chunks(distances.size(), 256, [&](std::size_t first, std::size_t last) {
    Index nearest = no_index;
    for (std::size_t v = first; v < last; ++v)
      if (all)
        distances[v] = (*all)(vertices[v], nearest);
      else if (states && (*states)[v] == PointState::inside)
        distances[v] = mesh::distance_to_surface(tree, vertices[v]);
  });
  return distances;
}

/// Sums over the parts of a patch.
struct Sums {
  mesh::CompensatedSum area, depth;
  Vec3 moment = Vec3::Zero();
};

Sums sums_of(const std::vector<PatchPart>& patch, const auto& distance) {
  std::vector<double> depths(patch.size());
  core::parallel_chunks(patch.size(), 64, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) depths[i] = distance(patch[i].centroid);
  });
  Sums sums;
  for (std::size_t i = 0; i < patch.size(); ++i) {
    sums.area.add(patch[i].area);
    sums.depth.add(patch[i].area * depths[i]);
    sums.moment += patch[i].area * patch[i].centroid;
  }
  return sums;
}

ContactPatch patch_from(const Sums& sums) {
  ContactPatch patch{sums.area.value(), {}, {}};
  if (patch.area_mm2 > 0) {
    patch.mean_depth_mm = sums.depth.value() / patch.area_mm2;
    patch.centroid = sums.moment / patch.area_mm2;
  }
  return patch;
}

NearestDistances distances_at(const BodyPair& bodies, const JointContact& joint, const Pose& X_FM,
                              const Points& mobile_in_F, const MeasuredContact& meeting, DistancesOf which) {
  return {distances_of(mobile_in_F, meeting.mobile, which, bodies.fixed_tree()),
          distances_of(posed(inverted(X_FM), joint.fixed().vertices()), meeting.fixed, which,
                       bodies.mobile_tree())};
}

}  // namespace

NearestDistances nearest_distances(const JointContact& joint, const Pose& X_FM,
                                   const MeasuredContact& meeting, DistancesOf which) {
  core::require_rotation(X_FM);
  return distances_at(contact::body_pair_of(joint), joint, X_FM, posed(X_FM, joint.mobile().vertices()),
                      meeting, which);
}

ContactMeasures measure_contact(const JointContact& joint, const Pose& X_FM, const MeasuredContact& meeting,
                                DistancesOf which) {
  core::require_rotation(X_FM);
  const BodyPair& bodies = contact::body_pair_of(joint);
  const Pose X_MF = inverted(X_FM);
  const auto to_fixed = [&](const Vec3& p_F) { return mesh::distance_to_surface(bodies.fixed_tree(), p_F); };
  const auto to_mobile = [&](const Vec3& p_M) {
    return mesh::distance_to_surface(bodies.mobile_tree(), p_M);
  };
  const TriMesh mobile_in_F = posed(X_FM, joint.mobile());
  ContactMeasures out;
  out.distances = distances_at(bodies, joint, X_FM, mobile_in_F.vertices, meeting, which);
  const mesh::ClosestPoints closest = *mesh::closest_points(bodies.fixed_tree(), bodies.mobile_tree(), X_FM);
  out.nearest = {closest.distance_mm, closest.a_point, closest.b_point};
  if (!meeting.mobile && !meeting.fixed) return out;

  const auto states_of = [](const std::optional<std::span<const PointState>>& states) {
    return states ? *states : std::span<const PointState>();
  };
  const Overlap overlap = contact::overlap_of({joint.fixed(), states_of(meeting.fixed)},
                                              {mobile_in_F, states_of(meeting.mobile)}, meeting.pairs);
  const Sums of_mobile = sums_of(overlap.mobile, to_fixed);
  const Sums of_fixed = sums_of(overlap.fixed, [&](const Vec3& p_F) { return to_mobile(posed(X_MF, p_F)); });
  if (meeting.mobile) out.mobile = patch_from(of_mobile);
  if (meeting.fixed) out.fixed = patch_from(of_fixed);
  if (meeting.mobile && meeting.fixed && overlap.has_volume()) {
    out.volume_mm3 = overlap.volume;
    out.volume_error_mm3 = overlap.volume_error;
    out.mobile_covered_again_mm3 = overlap.mobile_covered_again;
    out.fixed_covered_again_mm3 = overlap.fixed_covered_again;
  }
  const double area = of_mobile.area.value() + of_fixed.area.value();
  if (area > 0) out.centroid = (of_mobile.moment + of_fixed.moment) / area;
  return out;
}

}  // namespace condyle::contact
