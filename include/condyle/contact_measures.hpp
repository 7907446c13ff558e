#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "condyle/contact.hpp"

/// How much of two bodies is in contact at one pose: areas, volume, distances. docs/mathematics/03-both-directions.md.

namespace condyle::contact {

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
  /// The space that is inside both counts, each point as often as the bodies cover it; empty if either mesh is open, or is
  /// inside out there because it crosses itself.
  std::optional<double> volume_mm3;
  /// No more than this is the volume off by what the computation rounds; vertices as placed in F are taken as exact.
  double volume_error_mm3 = 0;
  /// How much of that volume is counted again, mm^3, because the body covers it more than once: it crosses itself, has triangles twice
  /// or one component in another.
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
[[nodiscard]] ContactMeasures measure_contact(const JointContact& joint, const Pose& X_FM,
                                              const MeasuredContact& contact, DistancesOf distances);

/// The distances of measure_contact() only.
[[nodiscard]] NearestDistances nearest_distances(const JointContact& joint, const Pose& X_FM,
                                                 const MeasuredContact& contact, DistancesOf distances);

/// summarise() with nearest distances that are known already; those of vertices inside are enough.
[[nodiscard]] RadialSummary summarise(const RadialContact& contact, const NearestDistances& distances);

// The depth to read of each vertex: of several ways out the one that means a depth there. docs/depths.md.

/// Kind of a depth: the line or arc along which it is measured. Depths are comparable within their kind only.
enum class DepthKind : std::uint8_t {
  none,               ///< not inside: 0
  radial,             ///< along the ray from the joint centre
  flexion,            ///< along the arc about the axis of this angle
  adduction,          ///<
  internal_rotation,  ///<
  nearest,            ///< to the nearest point of the surface, a lower bound of what a joint must move
};

/// A rotation by which a vertex leaves.
struct ExitRotation {
  Angle angle;
  double arc_mm;  ///< at the vertex's own radius
};

/// The vertex of one body that is deepest by the depth to read.
struct DeepestReliable {
  Index vertex;
  DepthKind kind;
  double depth_mm;
  double nearest_distance_mm;
  double radial_depth_mm;  ///< whether or not it is a depth
  Angle ray_to_normal;
  /// About the axes of flexion, adduction and internal rotation; empty if none sets it free, or none was requested.
  std::array<std::optional<ExitRotation>, 3> rotations;
};

/// Reliable depths of one body's vertices.
struct ReliableDepths {
  std::vector<DepthKind> kind;
  std::vector<double> depth_mm;  ///< 0 for vertices that are not inside; always finite
  /// Deepest of the vertices inside whose kind is other than nearest.
  std::optional<DeepestReliable> deepest;
  std::size_t without = 0;  ///< vertices inside of which neither ray nor arc is a depth
};

/// Both bodies; empty if the other mesh is open.
struct ReliableContact {
  std::optional<ReliableDepths> mobile, fixed;
};

/// A vertex's radial depth if that is a depth (DeepestVertex::radial_is_depth); else the shortest arc about one of the
/// joint's axes at this pose, of those that set it free; else its nearest distance. `contact` and `distances` are those
/// of the same pose. Builds ring tables only if a vertex needs them.
[[nodiscard]] ReliableContact reliable_depths(const JointContact& joint, JointKind kind,
                                              CoordinateSystem system, const JointAngles& pose,
                                              const RadialContact& contact,
                                              const NearestDistances& distances);

/// The same without rotations: radial depths, and nearest distances where those are none.
[[nodiscard]] ReliableContact reliable_radial_depths(const RadialContact& contact,
                                                     const NearestDistances& distances);

/// The deepest vertex of either body; of two as deep the mobile one.
struct DeepestOfBoth {
  bool is_mobile;
  DeepestReliable vertex;
};

/// Empty if no vertex has a depth other than its nearest distance.
[[nodiscard]] std::optional<DeepestOfBoth> deepest_of(const ReliableContact& contact);

/// Vertices inside of either body of which neither ray nor arc is a depth.
[[nodiscard]] std::size_t without_depth(const ReliableContact& contact) noexcept;

}  // namespace condyle::contact
