#pragma once

#include <optional>
#include <span>
#include <vector>

#include "condyle/io/motion_result.hpp"
#include "contact_options.hpp"

namespace condyle::cli {

/// Contact as frames of a recorded motion are asked for it.
ContactEntry motion_contact_of(const ContactChanges& options, const JointFile& file, bool with_pressure);

/// The bodies and surfaces of a recorded motion, made ready to be asked at any pose; by depth, or with pressure.
class MotionSurfaces {
 public:
  /// Throws what ElasticContact and NormalDepth throw.
  explicit MotionSurfaces(const MotionQuestion& question);
  MotionSurfaces(const MotionSurfaces&) = delete;
  MotionSurfaces& operator=(const MotionSurfaces&) = delete;

  const JointContact& bodies() const noexcept { return bodies_; }
  /// Null without pressure.
  const ElasticContact* elastic() const noexcept { return elastic_ ? &*elastic_ : nullptr; }

  /// contact_along() with its progress on standard error. Throws Interrupted on SIGINT or SIGTERM.
  std::vector<std::optional<FrameContact>> frames(std::span<const std::optional<Pose>> X_FM) const;

 private:
  JointContact bodies_;
  BodyRole casting_;
  std::optional<ElasticContact> elastic_;
  std::optional<NormalDepth> depth_;
};

}  // namespace condyle::cli
