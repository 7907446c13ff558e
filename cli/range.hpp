#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "condyle/depth_limit.hpp"
#include "condyle/impingement_zone.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/limit_band.hpp"
#include "condyle/motion_map.hpp"

/// The range of motion of a joint as commands compute it, with its progress on standard error.

namespace condyle::cli {

/// The limits of a joint and what contacts are told apart by.
struct RangeFound {
  std::vector<MotionLimit> limits;
  std::vector<DepthLimit> depths;  ///< with a depth allowed
  BearingFinding bearing;
  BearingRule bearing_rule = BearingRule::count;
  std::vector<std::string> terms;  ///< what the answer must be read with
  std::optional<MotionMap> map;
  std::vector<LimitBand> bands;
};

/// The built-in motions of a joint with those of its file.
std::vector<Motion> motions_of(const LoadedJoint& loaded);

/// The translation that a free joint keeps in all its motions: that of its reference pose unless `given` as for a pose.
/// Empty for joints that do not translate. Throws UsageError.
std::optional<Vec3> held_translation(const std::string& given, const LoadedJoint& loaded);

/// Of each limit its zone, where it has one; none where `finder` is nothing.
std::vector<std::optional<ImpingementZone>> zones_of(const std::optional<ZoneFinder>& finder,
                                                     std::span<const MotionLimit> limits);

/// Exact limits, a map where there is a grid, and bands where there are samples. Throws ReferenceContactError
/// where the bodies are in contact in the reference pose, Interrupted on SIGINT or SIGTERM.
RangeFound exact_range(const Joint& joint, std::span<const Motion> motions, const RangeOptions& asked,
                       const std::optional<MapGrid>& grid, const BandOptions& band);

}  // namespace condyle::cli
