#pragma once

#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "condyle/contact.hpp"
#include "condyle/control.hpp"
#include "condyle/load_balance.hpp"
#include "condyle/normal_depth.hpp"
#include "condyle/pressure.hpp"

/// Contact in every frame of a recorded motion.
///
///     const JointContact joint(femur, tibia);
///     const ElasticContact surfaces(femur, tibia, options);
///     const auto frames = contact_along(joint, &surfaces, X_FM);  // one entry per pose, empty if that is a gap

namespace condyle {

/// Results requested of the surfaces: pressure and depths, or depths with one of the bodies casting.
using SurfaceQuestion = std::variant<const ElasticContact*, const NormalDepth*>;

/// Contact of one frame.
struct FrameContact {
  Pose X_FM;
  bool in_contact = false;             ///< the surfaces meet, or one body is inside the other
  std::size_t intersecting_pairs = 0;  ///< of triangles
  double smallest_gap_mm = 0;          ///< between the surfaces; 0 if they meet
  /// Results of the casting surface, in its body's frame: the mobile one's if both are cast.
  SurfaceContact surface = {};
  Wrench on_mobile = {};  ///< by the fixed body, in F, about the origin of M; with pressure only
  /// Rays that a longer reach would find in contact: NormalDepth::cut_off_by_reach(). That costs as much as the
  /// depths, so it is computed only if depths near the reach or their absence give reason to: the largest is beyond
  /// half of it, or no ray ends in contact though bodies meet or one is open. Else 0, as the depth does not go from
  /// below a half to beyond the whole of the reach from one ray to the next, steps of a surface aside.
  std::size_t cut_off_by_reach = 0;
};

/// `casting` is the body that casts in a NormalDepth, which does not know; it means nothing to an ElasticContact.
///
/// One entry per pose, empty for gaps; frames in parallel, with the same answers on any number of threads. The outer
/// optional is empty if the work was stopped before its end. Raises what ElasticContact::at() raises, with the
/// frame's number before the message.
std::optional<std::vector<std::optional<FrameContact>>> contact_along(
    const JointContact& joint, const SurfaceQuestion& surfaces, std::span<const std::optional<Pose>> X_FM,
    BodyRole casting = BodyRole::mobile, const Control& control = {});

/// The poses that balance a load, frame after frame: rotations are the recorded ones, and each frame starts from its
/// translation as the last frame that carries its load has moved its own, and on as that changed between two balanced frames
/// next to each other. One load for all frames, or one for each. Frames that do not carry it say so in their outcome and hand
/// nothing on; gaps stay gaps. Not parallel.
std::optional<std::vector<std::optional<BalancedPose>>> balance_along(
    const ElasticContact& surfaces, std::span<const std::optional<Pose>> X_FM, std::span<const Load> loads,
    const BalanceOptions& balance = {}, const Control& control = {});

}  // namespace condyle
