#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "condyle/answer.hpp"
#include "condyle/io/joint_file.hpp"

/// Options on limits, their bands and maps, shared by the commands that compute them.

namespace condyle::cli {

struct RangeArguments {
  std::vector<std::string> map;
  std::string vary, translation;
  motion::BearingOptions bearing;
  motion::ReferenceContact reference_contact = motion::ReferenceContact::refuse;
  std::optional<double> past_deg;  ///< nothing: no impingement zones
  BandRequest band{.samples = 0};  ///< of no samples: no bands
};

/// Each adds the options of one question and returns the first of them. `given` is written while arguments are read.
CLI::Option* add_map(CLI::App& command, RangeArguments& given);
CLI::Option* add_translation(CLI::App& command, RangeArguments& given);
CLI::Option* add_bearing(CLI::App& command, RangeArguments& given);
CLI::Option* add_accept(CLI::App& command, RangeArguments& given);
/// Fewest joints 0: no band.
CLI::Option* add_band(CLI::App& command, RangeArguments& given, std::uint64_t fewest = 1);
CLI::Option* add_past(CLI::App& command, RangeArguments& given);

/// --motion, which may be given often.
void add_motions(CLI::App& command, std::vector<std::string>& lists);
/// What lists with commas between their names have together.
std::vector<std::string> names_in(const std::vector<std::string>& lists);

/// Nothing if no map is requested. Throws UsageError.
std::optional<motion::MapGrid> grid_of(const RangeArguments& given, JointKind kind, Anatomy anatomy);
/// Nothing if no bands are requested.
std::optional<BandRequest> band_of(const RangeArguments& given);
/// The request; check_range_request() is for the command, once it is whole. Throws UsageError for what is no request.
RangeRequest range_request_of(const RangeArguments& given, const io::LoadedJoint& loaded,
                              std::vector<motion::Motion> motions);

}  // namespace condyle::cli
