#pragma once

#include <optional>
#include <span>
#include <vector>

#include "condyle/contact.hpp"

/// How much of two bodies is in contact at one pose: areas, volume, distances. docs/mathematics.md, section 3.

namespace condyle {

/// From every vertex of one body to the nearest point of the other body's surface, mm, >= 0 inside and outside: the
/// shortest way out, or in, by translation.
struct NearestDistances {
  std::vector<double> mobile, fixed;
};

/// Where two surfaces are nearest to each other.
struct NearestPoints {
  double distance_mm;        ///< 0 where they meet
  Vec3 on_fixed, on_mobile;  ///< in F; where they meet, points of triangles that do
};

/// Of a body's surface, the part inside the other body.
struct ContactPatch {
  double area_mm2 = 0;
  /// Mean over the patch of the distance to the other body's surface; empty where there is no patch.
  std::optional<double> mean_depth_mm;
  std::optional<Vec3> centroid;  ///< in F
};

/// The gap of a vertex is its nearest distance, negative inside; over a triangle it is taken as linear, and the patch
/// is where it is negative. For smooth surfaces areas, means and volume err by the square of the edge length. What is
/// narrower than a triangle is not seen: a corner that stands in the middle of a large face gives a patch of its own
/// body, and none of the face. A mesh that overlaps itself counts the overlap twice.
struct ContactMeasures {
  NearestDistances distances;
  NearestPoints nearest;
  /// Empty where the other mesh is open and nothing can be inside it.
  std::optional<ContactPatch> mobile, fixed;
  /// Of the space that is inside both; empty where either mesh is open.
  std::optional<double> volume_mm3;
  /// Of the patches of both; in F, empty where there is none.
  std::optional<Vec3> centroid;
};

/// Which vertices are inside the other body, as ContactResults have it; empty where that is open. Without any the
/// measures are distances only.
struct VertexStates {
  std::optional<std::span<const PointState>> mobile, fixed;

  VertexStates() = default;
  template <class VertexResults>
  explicit VertexStates(const ContactResults<VertexResults>& of) {
    if (of.mobile_in_fixed) mobile = of.mobile_in_fixed->state;
    if (of.fixed_in_mobile) fixed = of.fixed_in_mobile->state;
  }
};

/// `states` are of all vertices at this pose, from JointContact::radial() or tangential(). Both meshes must have a
/// triangle. Some microseconds a vertex, on all threads.
ContactMeasures measure_contact(const JointContact& joint, const Pose& X_FM, const VertexStates& states);

}  // namespace condyle
