#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "condyle/impingement_zone.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/io/study.hpp"
#include "condyle/limit_band.hpp"
#include "condyle/motion_map.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

/// Options on limits, their bands and maps, shared by the commands that compute them.

namespace condyle::cli {

struct RangeGiven {
  std::vector<std::string> map;
  std::string vary, translation;
  BearingOptions bearing;
  ReferenceContact reference_contact = ReferenceContact::refuse;
  std::size_t band_samples = 0;  ///< 0: no bands
  std::optional<std::uint64_t> seed;
  std::optional<double> past_deg;  ///< nothing: no impingement zones
  StudyUncertainty sigma;
};

/// Each adds the options of one question and returns the first of them. `given` is written while arguments are read.
CLI::Option* add_map(CLI::App& command, const std::shared_ptr<RangeGiven>& given);
CLI::Option* add_bearing(CLI::App& command, const std::shared_ptr<RangeGiven>& given);
CLI::Option* add_accept(CLI::App& command, const std::shared_ptr<RangeGiven>& given);
CLI::Option* add_band(CLI::App& command, const std::shared_ptr<RangeGiven>& given);
CLI::Option* add_past(CLI::App& command, const std::shared_ptr<RangeGiven>& given);

/// Nothing where no map was asked for. Throws UsageError.
std::optional<MapGrid> grid_of(const RangeGiven& given, JointKind kind, Anatomy anatomy);
/// Nothing where no zones were asked for. Throws UsageError.
std::optional<ZoneFinder> zone_finder_of(const RangeGiven& given, const Joint& joint,
                                         const ClockFace& socket_clock = sagittal_clock());
RangeOptions range_options_of(const RangeGiven& given, const JointAngles& reference_pose);
/// What was given, else what the joint file says, else what is usual.
BandOptions band_options_of(const RangeGiven& given, const JointFile& file);

}  // namespace condyle::cli
