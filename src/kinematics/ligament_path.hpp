#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "condyle/joint.hpp"

namespace condyle::kinematics {

/// The part of a ligament between its two last points.
struct Crossing {
  double length_mm = 0;
  bool wraps = false;
  /// Unit, from the fixed body to the mobile one along the straight piece that joins them; zero if it has no length.
  Vec3 direction = Vec3::Zero();
  Vec3 on_mobile = Vec3::Zero();  ///< where that piece meets the mobile body, in F
};

/// With its last points and its wrap in one frame; empty where it is not known, as ligament_state().
std::optional<Crossing> crossing(const Vec3& fixed, const Vec3& mobile, const LigamentWrap* wrap) noexcept;

/// The path from insertion to insertion, in F; where it lies on a wrap some tenths of a radian apart. Straight where its length is not known.
std::vector<Vec3> ligament_points(const Ligament& ligament, const Pose& X_FM);

/// No ligament bears more.
inline constexpr double largest_strain = 0.5;

/// How a ligament is shown.
enum class LigamentStretch { slack, taut, at_end, unknown };
/// At its end from the strain on at which it ends motions; unknown where its length is not known.
LigamentStretch stretch_of(const Ligament& ligament, const std::optional<LigamentState>& state) noexcept;

/// The wrap in the fixed body's frame; null if there is none.
const LigamentWrap* wrap_in_fixed(const Ligament& ligament, const Pose& X_FM, LigamentWrap& storage) noexcept;

/// Length of the parts that no pose changes.
double constant_length_mm(const Ligament& ligament) noexcept;

/// What is not known exactly of the ligaments that end motions: "NAME.slack_length" and "NAME.points", its standard deviation, and how many
/// numbers have it. In the order of their draws.
struct LigamentSigma {
  std::string name;
  double sigma_mm = 0;
  std::size_t numbers = 0;
};
std::vector<LigamentSigma> ligament_sigmas(const Joint& joint);

/// Moves its points and its wrap with their bodies, in the frame of each.
void shift(Ligament& ligament, const Vec3& fixed_by, const Vec3& mobile_by) noexcept;

/// How far a point is from the centre of a sphere, or the axis of a cylinder.
double distance_from_middle(const LigamentWrap& wrap, const Vec3& point) noexcept;

}  // namespace condyle::kinematics
