#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "condyle/contact_measures.hpp"
#include "condyle/joint.hpp"
#include "condyle/normal_depth.hpp"
#include "condyle/pressure.hpp"

/// How deep the bodies of a joint are in each other at one pose.

namespace condyle {

enum class DepthMethod : std::uint8_t {
  reliable,  ///< Along rays from the centre if that is a depth, else along the arc that frees a vertex soonest.
  radial,    ///< Along rays only.
  tangential,  ///< Along arcs about one axis of the joint.
  normal,      ///< Along normals of triangles, open meshes too.
};

/// Which measures an answer has beside its depths.
enum class MeasuresOf : std::uint8_t {
  contact,         ///< Areas, volume, centroids and nearest points too: most of the time of a deep pose.
  distances_only,  ///< Nearest distances of vertices; the other measures stay as they are made.
};

/// Options of a request at one pose, with their defaults.
struct DepthRequest {
  Pose X_FM = Pose::Identity();
  /// The angles that X_FM was made of, about whose axes arcs go; default: those that it has, which rounding may change.
  std::optional<JointAngles> pose = {};
  DepthMethod method = DepthMethod::reliable;
  /// With DepthMethod::tangential the angle about whose axis arcs go; default: flexion.
  std::optional<JointAngle> about = {};
  /// With DepthMethod::normal the body whose triangles cast, and how; defaults: both, NormalDepthOptions{}.
  std::optional<contact::Casting> casting = {};
  std::optional<contact::NormalDepthOptions> rays = {};
  contact::DistancesOf distances = contact::DistancesOf::vertices_inside;
  MeasuresOf measures = MeasuresOf::contact;
};

/// DepthMethod::reliable and radial: every vertex along its ray, and the depth to read of each. With `radial` that is its radial
/// depth, or its nearest distance if that is none.
struct RayDepths {
  contact::RadialContact contact;
  contact::ReliableContact reliable;
};

/// A rotation axis, by its joint angle and as a direction in F.
struct RotationAxis {
  JointAngle about;
  Vec3 direction_F;
};

/// DepthMethod::tangential: every vertex along its circle.
struct ArcDepths {
  RotationAxis axis;
  contact::TangentialContact contact;
};

struct DepthAnswer {
  DepthRequest request;
  contact::ContactMeasures measures;  ///< with DepthMethod::normal nearest distances and points only
  std::variant<RayDepths, ArcDepths, contact::NormalContact> depths;
  std::vector<std::string> caveats = {};  ///< what the depths must be read with, a sentence each

  [[nodiscard]] bool in_contact() const noexcept;
};

/// Throws UsageError for options of another method, arcs at a pose that translates, and angles that are not those of X_FM.
void check_depth_request(const Joint& joint, const DepthRequest& request);

/// Depths at one pose. `bodies` are those of `joint`, and keep their tables for the next pose: the first call builds them, later
/// ones take some milliseconds in contact, arcs more.
///
/// Throws UsageError as check_depth_request(), MeshError as JointContact::radial() does. Open meshes have no inside: what lacks
/// an answer for that is empty.
[[nodiscard]] DepthAnswer answer_depth(const contact::JointContact& bodies, const Joint& joint,
                                       const DepthRequest& request);
[[nodiscard]] DepthAnswer answer_depth(const Joint& joint, const DepthRequest& request);

}  // namespace condyle
