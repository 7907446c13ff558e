#include "range_options.hpp"

#include <CLI/App.hpp>

#include "choice.hpp"
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
  auto* map = add_value(command, "--map", given.map, "AXIS=FIRST:LAST:STEP AXIS=FIRST:LAST:STEP",
                        "Compute limits over a grid of two held angles, in degrees, such as "
                        "flexion=-20:120:1 adduction=-40:30:1, or of x, y or z of a free joint, in mm. The "
                        "first one runs to the right. One more, such as flexion=30, is held there")
                  // One is refused below, and a file that was taken for the second one: with words that help.
                  ->expected(1, 4)
                  ->check(
                      [](const std::string& axis) {
                        return axis.find('=') == axis.npos ? "'" + axis + "' is no axis: " + map_needs
                                                           : std::string();
                      },
                      "");
  add_value(command, "--vary", given.vary, "AXIS (the third angle)",
            "With --map: the angle that turns over the grid, or the translation x, y or z");
  return map;
}

CLI::Option* add_translation(CLI::App& command, RangeArguments& given) {
  return add_value(command, "--translation", given.translation, "\"x=X y=Y z=Z\"",
                   "Hold a free joint here in all motions, in mm. Default: the reference pose's place");
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
  return add_flag(
      command, "--accept-reference-contact", given.reference_contact, motion::ReferenceContact::accept,
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
  for_band(add_value(command, "--seed", given.band.seed, "N (1)",
                     "With --band: the seed of the displacements, instead of that of the joint file")
               ->check(seed_number()));
  for_band(add_value(command, "--sigma-centre", given.band.centre_mm, "MM (0.5)",
                     "With --band: the standard deviation of each coordinate of the centre, instead of "
                     "that of the joint file. 1.9 answers for the centre about which a living hip turns"));
  for_band(add_value(command, "--sigma-axes", given.band.axes_deg, "DEG (1)",
                     "With --band: the same of the rotation about each axis"));
  for_band(add_value(command, "--sigma-surface", given.band.surface_mm,
                     "MM (0.25, of a label map 0.25 voxels)",
                     "With --band: the same of each surface along its normals"));
  return band;
}

CLI::Option* add_past(CLI::App& command, RangeArguments& given) {
  return add_value(command, "--past", given.past_deg, "DEG",
                   "Find the impingement zones this far past each limit");
}

void add_motions(CLI::App& command, std::vector<std::string>& lists) {
  add_value(command, "--motion", lists, "NAME[,NAME...] (all)",
            "Compute the limits of this motion only, or of these, with commas between their names: those of "
            "condyle rom --list-motions")
      ->expected(1)
      ->take_all();
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
