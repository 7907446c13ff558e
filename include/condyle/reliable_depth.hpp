#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "condyle/contact.hpp"
#include "condyle/contact_measures.hpp"

/// The depth to read of each vertex: of several ways out the one that means a depth there. docs/depths.md.

namespace condyle {

/// Kind of a depth: the line or arc along which it is measured.
enum class DepthWay : std::uint8_t {
  none,               ///< not inside: 0
  radial,             ///< along the ray from the joint centre
  flexion,            ///< along the arc about the axis of this angle
  adduction,          ///<
  internal_rotation,  ///<
  nearest,            ///< to the nearest point of the surface, a lower bound of what a joint must move
};

/// A rotation by which a vertex leaves.
struct WayOut {
  Angle angle;
  double arc_mm;  ///< at the vertex's own radius
};

/// The vertex of one body that is deepest by the depth to read.
struct DeepestReliable {
  Index vertex;
  DepthWay way;
  double depth_mm;
  double nearest_distance_mm;
  double radial_depth_mm;  ///< whether or not it is a depth
  Angle ray_to_normal;
  /// About the axes of flexion, adduction and internal rotation; empty if none sets it free, or none was requested.
  std::array<std::optional<WayOut>, 3> rotations;
};

/// Reliable depths of one body's vertices.
struct ReliableDepths {
  std::vector<DepthWay> way;
  std::vector<double> depth_mm;  ///< 0 for vertices that are not inside; always finite
  /// Deepest of the vertices inside whose kind is other than nearest.
  std::optional<DeepestReliable> deepest;
  std::size_t without = 0;  ///< vertices inside of which neither ray nor arc is a depth
};

/// Both bodies; empty if the other mesh is open.
struct ReliableContact {
  std::optional<ReliableDepths> mobile, fixed;
};

/// A vertex's radial depth if that is a depth (DeepestVertex::applies); else the shortest arc about one of the
/// joint's axes at this pose, of those that set it free; else its nearest distance. `contact` and `distances` are those
/// of the same pose. Builds ring tables only if a vertex needs them.
ReliableContact reliable_depths(const JointContact& joint, JointKind kind, CoordinateSystem system,
                                const JointAngles& pose, const RadialContact& contact,
                                const NearestDistances& distances);

/// The same without rotations: radial depths, and nearest distances where those are none.
ReliableContact reliable_radial_depths(const RadialContact& contact, const NearestDistances& distances);

/// The deepest vertex of either body; of two as deep the mobile one.
struct DeepestOfBoth {
  bool is_mobile;
  DeepestReliable vertex;
};

/// Empty if no vertex has a depth other than its nearest distance.
std::optional<DeepestOfBoth> deepest_of(const ReliableContact& contact);

/// Vertices inside of either body of which neither ray nor arc is a depth.
std::size_t without_depth(const ReliableContact& contact) noexcept;

}  // namespace condyle
