#include "range_options.hpp"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "condyle/error.hpp"
#include "condyle/io/pose_text.hpp"
#include "io/joint/grid_text.hpp"
#include "whole_number.hpp"

namespace condyle::cli {
namespace {

/// "count", or a margin in mm.
motion::BearingOptions parse_bearing(const std::string& text) {
  motion::BearingOptions bearing;
  if (text == "count") {
    bearing.rule = motion::BearingRule::count;
  } else if (!CLI::detail::lexical_cast(text, bearing.margin_mm.emplace())) {
    throw UsageError("--bearing: '" + text + "' is neither a margin in mm nor count");
  }
  return bearing;
}

constexpr const char* map_needs = "a map needs two angles, such as --map flexion=0:120:5 adduction=-30:30:5";

/// The pose's syntax, with translations only. A joint that does not translate is left to the request's check.
std::optional<Vec3> translation_of(const std::string& text, const Joint& joint) {
  if (text.empty()) return std::nullopt;
  if (joint.kind != JointKind::free) return Vec3::Zero();
  const io::PoseDegrees pose = io::parse_pose(text, joint.kind, joint.anatomy);
  if (pose.angles() != JointAngles{}) throw UsageError("--translation: takes x, y and z only");
  return pose.translation_mm;
}

}  // namespace

CLI::Option* add_map(CLI::App& command, RangeArguments& given) {
  auto* map =
      command
          .add_option("--map", given.map,
                      "Compute limits over a grid of two held angles, in degrees, such as "
                      "flexion=-20:120:1 adduction=-40:30:1, or of x, y or z of a free joint, in mm. The "
                      "first one runs to the right. One more, such as flexion=30, is held there")
          ->option_text("AXIS=FIRST:LAST:STEP AXIS=FIRST:LAST:STEP")
          // One is refused below, and a file that was taken for the second one: with words that help.
          ->expected(1, 4)
          ->check(
              [](const std::string& axis) {
                return axis.find('=') == axis.npos ? "'" + axis + "' is no axis: " + map_needs
                                                   : std::string();
              },
              "");
  command
      .add_option("--vary", given.vary,
                  "With --map: the angle that turns over the grid, or the translation x, y or z")
      ->option_text("AXIS (the third angle)");
  return map;
}

CLI::Option* add_translation(CLI::App& command, RangeArguments& given) {
  return command
      .add_option("--translation", given.translation,
                  "Hold a free joint here in all motions, in mm. Default: the reference pose's place")
      ->option_text("\"x=X y=Y z=Z\"");
}

CLI::Option* add_bearing(CLI::App& command, RangeArguments& given) {
  return command
      .add_option_function<std::string>(
          "--bearing", [&given](const std::string& text) { given.bearing = parse_bearing(text); },
          "Contact this near to the head's sphere is bearing contact and ends no motion; with count every "
          "contact ends a motion. Default: 2 mm, or less if the rim is near")
      ->option_text("MM|count (2)");
}

CLI::Option* add_accept(CLI::App& command, RangeArguments& given) {
  return command.add_flag_callback(
      "--accept-reference-contact", [&given] { given.reference_contact = motion::ReferenceContact::accept; },
      "Answer although the bodies are in contact in the reference pose. Motions that start in contact report "
      "so");
}

CLI::Option* add_band(CLI::App& command, RangeArguments& given, std::uint64_t fewest) {
  const std::string band_help =
      "Compute how far each limit moves within its uncertainty: from 5 to 95 % of N varied joints";
  auto* band = command.add_flag("--band{200}", band_help)
                   ->check(whole_number(fewest))
                   ->each([&given](const std::string& text) { given.band.samples = std::stoull(text); })
                   ->option_text("[=N] (200)");
  const auto for_band = [&](CLI::Option* option) { option->needs(band); };
  for_band(command
               .add_option("--seed", given.band.seed,
                           "With --band: the seed of the displacements, instead of that of the joint file")
               ->check(seed_number())
               ->option_text("N (1)"));
  for_band(
      command
          .add_option("--sigma-centre", given.band.centre_mm,
                      "With --band: the standard deviation of each coordinate of the centre, instead of "
                      "that of the joint file. 1.9 answers for the centre about which a living hip turns")
          ->option_text("MM (0.5)"));
  for_band(command
               .add_option("--sigma-axes", given.band.axes_deg,
                           "With --band: the same of the rotation about each axis")
               ->option_text("DEG (1)"));
  for_band(command
               .add_option("--sigma-surface", given.band.surface_mm,
                           "With --band: the same of each surface along its normals")
               ->option_text("MM (0.25, of a label map 0.25 voxels)"));
  return band;
}

CLI::Option* add_past(CLI::App& command, RangeArguments& given) {
  return command.add_option("--past", given.past_deg, "Find the impingement zones this far past each limit")
      ->option_text("DEG");
}

void add_motions(CLI::App& command, std::vector<std::string>& lists) {
  command
      .add_option(
          "--motion", lists,
          "Compute the limits of this motion only, or of these, with commas between their names: those of "
          "condyle rom --list-motions")
      ->expected(1)
      ->take_all()
      ->option_text("NAME[,NAME...] (all)");
}

std::vector<std::string> names_in(const std::vector<std::string>& lists) {
  std::vector<std::string> names;
  for (const std::string& list : lists)
    for (std::string& name : CLI::detail::split(list, ',')) names.push_back(std::move(name));
  return names;
}

std::optional<motion::MapGrid> grid_of(const RangeArguments& given, JointKind kind, Anatomy anatomy) {
  if (given.map.empty()) {
    if (!given.vary.empty()) throw UsageError("--vary: is for --map");
    return std::nullopt;
  }
  if (given.map.size() < 2) throw UsageError("--map: only " + given.map[0] + " is given: " + map_needs);
  motion::MapGrid grid = io::parse_grid(given.map, given.vary, anatomy);
  motion::check_grid(grid, kind);
  return grid;
}

std::optional<BandRequest> band_of(const RangeArguments& given) {
  return given.band.samples > 0 ? std::optional(given.band) : std::nullopt;
}

RangeRequest range_request_of(const RangeArguments& given, const io::LoadedJoint& loaded,
                              std::vector<motion::Motion> motions) {
  const Joint& joint = loaded.joint;
  RangeRequest request{.motions = std::move(motions)};
  request.range.bearing = given.bearing;
  request.range.overlap.reference_contact = given.reference_contact;
  request.translation_mm = translation_of(given.translation, joint);
  request.map = grid_of(given, joint.kind, joint.anatomy);
  if (given.past_deg) request.zones_past = Angle::degrees(*given.past_deg);
  request.bands = band_of(given);
  return request;
}

}  // namespace condyle::cli
