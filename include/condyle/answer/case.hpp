#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
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
