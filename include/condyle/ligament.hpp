#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "condyle/joint_coordinates.hpp"
#include "condyle/pose.hpp"

/// Ligaments as strings: their length, strain, tension and load in a pose. docs/mathematics/14-ligaments.md.

namespace condyle {

enum class WrapShape : std::uint8_t {
  sphere,
  cylinder,  ///< without ends
  ellipsoid,  ///< Geodesics on it are not computed: where the straight line meets it, the ligament's length is not known.
};
/// As in files: "sphere".
[[nodiscard]] std::string_view name_of(WrapShape shape) noexcept;

/// A surface that a ligament lies on where the straight line would go through it.
struct LigamentWrap {
  WrapShape shape = WrapShape::sphere;
  BodyRole body = BodyRole::mobile;  ///< that it is fixed to
  Vec3 centre = Vec3::Zero();        ///< in that body's frame, mm; of a cylinder any point of its axis
  Vec3 axis = Vec3::UnitZ();         ///< of a cylinder, unit
  double radius_mm = 0;              ///< of a sphere or a cylinder
  /// Of an ellipsoid: columns are its axes, unit, in the body's frame, and half its size along each.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  Vec3 radii_mm = Vec3::Zero();
};

/// A string of no mass and no width from one body to the other, along the shortest path that its points and its wrap leave it:
///
///     fixed.front() --- fixed.back() ~ ~ ~ mobile.back() --- mobile.front()
///       insertion        crosses from one body to the other      insertion
///
/// Only the part between the two last points changes its length with the pose, and only that part wraps.
struct Ligament {
  std::string name = {};
  std::vector<Vec3> fixed = {},
                    mobile = {};  ///< one or more of each, from the insertion on, in the body's frame, mm
  std::optional<LigamentWrap> wrap = {};
  double slack_length_mm = 0;  ///< above 0: longer it is taut
  double stiffness_n =
      0;  ///< k, the slope of tension over strain once all fibres carry; 0: it has no tension
  double transition_strain = 0.06;  ///< above which they do, 0 or more
  /// Above 0: a motion ends where the strain reaches this.
  std::optional<double> ends_at_strain = {};
};

/// The tension at a strain e, after Blankevoort et al. 1991, and the work that stretched it so far: with the transition strain c
///
///     0  for e <= 0,   k e^2 / (2 c)  up to c,   k (e - c / 2)  beyond.
[[nodiscard]] double tension_n(const Ligament& ligament, double strain) noexcept;
[[nodiscard]] double energy_nmm(const Ligament& ligament, double strain) noexcept;

/// A ligament in a pose.
struct LigamentState {
  double length_mm = 0;
  double strain = 0;  ///< (length - slack length) / slack length, negative while it is slack
  double tension_n = 0, energy_nmm = 0;
  bool wraps = false;
  /// On the mobile body, in the fixed body's frame; the moment about that frame's origin. The fixed body has the opposite.
  Vec3 force_n = Vec3::Zero(), moment_nmm = Vec3::Zero();
};
/// Closed form; the path has the length of the shortest one. Empty where its length is not known: an end of the part that crosses the joint lies
/// inside its wrap, or the straight line meets an ellipsoid. No allocation.
[[nodiscard]] std::optional<LigamentState> ligament_state(const Ligament& ligament,
                                                          const Pose& X_FM) noexcept;

/// A ligament in every frame; empty for gaps, and where its length is not known.
struct LigamentAlong {
  std::string name;
  double slack_length_mm = 0;
  std::vector<std::optional<LigamentState>> frames = {};
};
[[nodiscard]] std::vector<LigamentAlong> ligaments_along(const std::vector<Ligament>& ligaments,
                                                         const std::vector<std::optional<Pose>>& X_FM);

}  // namespace condyle
