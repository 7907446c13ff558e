#pragma once

#include <optional>
#include <span>
#include <vector>

#include "condyle/contact.hpp"

/// How much of two bodies is in contact at one pose: areas, volume, distances. docs/mathematics/03-both-directions.md.

namespace condyle {

/// Distances from vertices of one body to the nearest point of the other body's surface, mm, >= 0 inside and outside:
/// the shortest translation out, or in. One element per vertex; NaN for vertices whose distance was not requested.
struct NearestDistances {
  std::vector<double> mobile, fixed;
};

/// Where two surfaces are nearest to each other.
struct NearestPoints {
  double distance_mm;        ///< 0 if they meet
  Vec3 on_fixed, on_mobile;  ///< in F; where they meet, points of triangles that do
};

/// The part of a body's surface inside the other body.
struct ContactPatch {
  double area_mm2 = 0;
  /// Mean over the patch of the distance to the other body's surface; empty if there is no patch.
  std::optional<double> mean_depth_mm;
  std::optional<Vec3> centroid;  ///< in F
};

/// Areas, centroids and the volume are those of the meshes, to rounding, however thin the overlap. The mean depth takes the distance at
/// the centroid of each triangle's part in contact, and errs by the square of the edge length on smooth surfaces.
///
/// Where the two surfaces coincide, a part of one belongs to its patch if its own body's inner side is inside the other body: bodies
/// that touch along a face have no patch and no volume there.
struct ContactMeasures {
  NearestDistances distances;
  NearestPoints nearest;
  /// Empty if the other mesh is open and nothing can be inside it.
  std::optional<ContactPatch> mobile, fixed;
  /// The space that is inside both counts, each point as often as the bodies cover it; empty if either mesh is open.
  std::optional<double> volume_mm3;
  /// No more than this is the volume off by what the computation rounds; vertices as placed in F are taken as exact.
  double volume_error_mm3 = 0;
  /// By how much the body covers the surroundings of the overlap more than once, mm^3: above 0 if it crosses itself or has
  /// components one in another, and the volume may count space more than once.
  double mobile_covered_again_mm3 = 0, fixed_covered_again_mm3 = 0;
  /// Centroid of both patches; in F, empty if there is none.
  std::optional<Vec3> centroid;
};

/// Which vertices are inside the other body, empty if that is open, and which triangles meet. Without any the measures are
/// distances only.
struct MeasuredContact {
  std::optional<std::span<const PointState>> mobile, fixed;
  std::span<const TrianglePair> pairs;

  MeasuredContact() = default;
  template <class VertexResults>
  explicit MeasuredContact(const ContactResults<VertexResults>& of) : pairs(of.pairs) {
    if (of.mobile_in_fixed) mobile = of.mobile_in_fixed->state;
    if (of.fixed_in_mobile) fixed = of.fixed_in_mobile->state;
  }
};

/// Which vertices have nearest distances: those inside the other body, as the depth to read needs them, or all, as files and colours
/// show them.
enum class DistancesOf { vertices_inside, all_vertices };

/// `contact` is of all vertices at this pose, from JointContact::radial() or tangential(). Both meshes must have a
/// triangle. A few milliseconds for bones in contact, and some microseconds for each vertex that has a distance, on all threads.
ContactMeasures measure_contact(const JointContact& joint, const Pose& X_FM, const MeasuredContact& contact,
                                DistancesOf distances);

/// The distances of measure_contact() only.
NearestDistances nearest_distances(const JointContact& joint, const Pose& X_FM,
                                   const MeasuredContact& contact, DistancesOf distances);

/// summarise() with nearest distances that are known already; those of vertices inside are enough.
RadialSummary summarise(const RadialContact& contact, const NearestDistances& distances);

}  // namespace condyle
