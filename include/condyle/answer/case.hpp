#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/hip_measures.hpp"
#include "condyle/joint.hpp"
#include "condyle/limit_band.hpp"
#include "condyle/make_joint.hpp"
#include "condyle/range_of_motion.hpp"

namespace condyle {

/// A joint, and what was said about it beside its bones: by a joint file, a model, a description in Python, the block of a page. What a
/// request leaves open is as its case has it. Parts, their parameters and an implant are in the joint.
struct Case {
  Joint joint;
  JointPlacement placement = {};
  std::vector<motion::Motion> own_motions = {};  ///< besides the built-in ones of the joint's kind
  motion::Uncertainty uncertainty = {};
  std::uint64_t band_seed = 1;
  std::string pelvis_frame = {};  ///< measure::pelvis_frame_of() its description; empty: not stated

  /// Motions that can be requested: the built-in ones and its own.
  [[nodiscard]] std::vector<motion::Motion> motions() const;
  /// Those of these names, as motion_named() finds them; all if there are no names.
  [[nodiscard]] std::vector<motion::Motion> motions(std::span<const std::string> names) const;
  /// How its shape is measured: in the frame that its axes are from, the ischiofemoral distance in its reference pose.
  [[nodiscard]] measure::MeasureOptions measure_options(Angle pelvic_tilt = {}) const;
};

// One rule for what a pose is to the limits of its joint, for every shell.

enum class PoseState : std::uint8_t {
  free,
  at_limit,   ///< One angle is within at_limit_within of an end that contact or a ligament makes.
  bearing,    ///< Only surfaces meet whose contact ends no motion.
  impinging,  ///< Surfaces meet whose contact ends motions.
  strained,   ///< A ligament has more than the strain that ends a motion, and no such surfaces meet.
  contact,    ///< In contact, and nothing distinguishes bearing contact: PoseStanding::why_unknown.
};
/// As in files: "at_limit".
[[nodiscard]] std::string_view name_of(PoseState state) noexcept;

/// A field of angles shows a tenth of a degree: so near to an end a pose is at it.
inline constexpr Angle at_limit_within = Angle::degrees(0.05);

/// How a pose stands to the ends of motions.
struct PoseStanding {
  /// Whether the nearest end is looked for at all, or only where the pose may be at one: else `nearest` is empty.
  enum class FindNearest : std::uint8_t { always, at_limits };

  PoseState state = PoseState::free;
  /// The end that is nearest: how far one angle alone turns to it. Empty if the pose is beyond one, and if none is within half a turn.
  std::optional<motion::NearestEnd> nearest = {};
  double clearance_mm = 0;       ///< RangeOfMotion::clearance_mm()
  std::string why_unknown = {};  ///< of PoseState::contact, why no bearing contact is known

  /// Degrees to the nearest end, 0 beyond one; NaN if none is within half a turn.
  [[nodiscard]] double to_limit_deg() const noexcept;
};

/// The limits by which poses of a joint are judged, whatever is in contact in the reference pose; null if no contact ends a motion.
[[nodiscard]] std::shared_ptr<const motion::RangeOfMotion> limits_of_poses(const Joint& joint);

/// `at` and the translation make X_FM, about whose origin angles then turn; `in_contact` is whether any surfaces meet. Some
/// hundred microseconds, and as RangeOfMotion::nearest_end() where that is asked.
[[nodiscard]] PoseStanding pose_standing(const motion::RangeOfMotion& limits, const JointAngles& at,
                                         const Vec3& translation_mm, bool in_contact,
                                         PoseStanding::FindNearest find = PoseStanding::FindNearest::always);

/// A band of displaced joints, and how they are displaced. What is left open is as the case has it.
struct BandRequest {
  std::size_t samples = motion::BandOptions{}.samples;
  std::optional<std::uint64_t> seed = {};
  /// Standard deviations: of each coordinate of the centre, of the rotation about each axis, and of each surface along its normals.
  std::optional<double> centre_mm = {}, axes_deg = {}, surface_mm = {};

  [[nodiscard]] bool any_sigma() const noexcept { return centre_mm || axes_deg || surface_mm; }
};

/// The one place where a request and what a case says about its uncertainty meet. A surface with a standard deviation in mm has none
/// in voxels.
[[nodiscard]] motion::BandOptions band_options(const Case& joint, const BandRequest& request);

}  // namespace condyle
