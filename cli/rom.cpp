#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "answer.hpp"
#include "condyle/core/error.hpp"
#include "condyle/io/grid_text.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/io/map_checkpoint.hpp"
#include "condyle/io/map_result.hpp"
#include "condyle/io/output_folder.hpp"
#include "condyle/io/plot_limits.hpp"
#include "condyle/io/pose_text.hpp"
#include "condyle/io/rom_result.hpp"
#include "condyle/io/whole_file.hpp"
#include "condyle/motion/motion_map.hpp"
#include "interrupt.hpp"
#include "progress.hpp"
#include "verbs.hpp"

namespace condyle::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* checkpoint_name = "map.checkpoint";

enum class RestContacts { count, leave_out };

struct Options {
  std::string joint, out, vary;
  std::vector<std::string> motions, map;
  std::optional<double> exclude_radius_mm;
  RestContacts rest_contacts = RestContacts::count;
  ContactAtRest contact_at_rest = ContactAtRest::refuse;
  AnswerForm form = AnswerForm::text;
};

/// The motions asked for, all where none was.
std::vector<Motion> chosen_motions(const std::vector<Motion>& known, const std::vector<std::string>& names) {
  if (names.empty()) return known;
  std::vector<Motion> chosen;
  for (const std::string& name : names) chosen.push_back(motion_named(known, name));
  return chosen;
}

/// The angle that is neither.
JointAngle third_angle(JointAngle a, JointAngle b) {
  for (const JointAngle angle : {JointAngle::flexion, JointAngle::adduction, JointAngle::internal_rotation})
    if (angle != a && angle != b) return angle;
  return JointAngle::internal_rotation;
}

std::optional<MapGrid> grid_of(const Options& options, JointKind kind) {
  if (options.map.empty()) {
    if (!options.vary.empty()) throw UsageError("--vary: is for --map");
    return std::nullopt;
  }
  MapGrid grid;
  grid.column = parse_grid_axis(options.map[0]);
  grid.row = parse_grid_axis(options.map[1]);
  grid.vary =
      options.vary.empty() ? third_angle(grid.column.angle, grid.row.angle) : joint_angle_named(options.vary);
  check_grid(grid, kind);
  return grid;
}

RangeOptions range_options(const Options& options, const JointAngles& rest) {
  RangeOptions range;
  range.overlap.rest = rest;
  range.overlap.contact_at_rest = options.contact_at_rest;
  if (options.exclude_radius_mm) range.overlap.leave_out_region = ArticularRegion{*options.exclude_radius_mm};
  if (options.rest_contacts == RestContacts::leave_out) range.overlap.leave_out_rest_contacts.emplace();
  return range;
}

/// What the answer must be read with.
std::vector<std::string> terms_of(const RangeOptions& options, const RangeOfMotion& range) {
  std::vector<std::string> terms;
  const OverlapOptions& overlap = options.overlap;
  if (overlap.leave_out_region)
    terms.push_back(fmt::format("left out: triangles within {:g} mm of the joint centre",
                                overlap.leave_out_region->radius_mm));
  if (overlap.leave_out_rest_contacts)
    terms.push_back(fmt::format("left out: triangles in contact at rest and {} rings of neighbours",
                                overlap.leave_out_rest_contacts->rings));
  if (overlap.leaves_out())
    terms.push_back(fmt::format("left out in all: {} triangles of the fixed body, {} of the mobile one",
                                range.left_out().fixed_triangles, range.left_out().mobile_triangles));
  if (overlap.contact_at_rest == ContactAtRest::accept)
    terms.emplace_back("contact at rest is accepted: motions that start in contact say so");
  return terms;
}

/// Computes the map, from where it was interrupted if it was. Throws Interrupted.
MotionMap computed_map(const MapGrid& grid, const LoadedJoint& loaded, const RangeOptions& range_options,
                       const RangeOfMotion& range, const fs::path& checkpoint) {
  MotionMap map(grid);
  const MapKey key = map_key(loaded.joint, range_options, grid);
  if (!checkpoint.empty() && read_checkpoint(checkpoint, key, map) == Resumed::other_question)
    note(checkpoint.string() + ": is of another joint, mesh, grid or option; the map starts anew");

  const InterruptWatch watch;
  std::stop_source stop;
  {
    Progress progress("map points", map.done());
    fill(map, range,
         {.progress =
              [&](std::size_t done, std::size_t total) {
                progress.update(done, total);
                if (watch.interrupted()) stop.request_stop();
              },
          .stop = stop.get_token()});
  }
  if (map.complete()) return map;
  const std::string done =
      fmt::format("interrupted, {} of {} map points done", map.done(), map.points.size());
  if (checkpoint.empty()) throw Interrupted(done + "; nothing is kept without --out");
  std::error_code why_not_is_told_when_writing;
  fs::create_directories(checkpoint.parent_path(), why_not_is_told_when_writing);
  write_checkpoint(checkpoint, map, key);
  throw Interrupted(
      fmt::format("{} and kept in {}; the same command goes on from there", done, checkpoint.string()));
}

/// The map is complete and written: the checkpoint, if there was one, has nothing to add.
void remove_checkpoint(const fs::path& checkpoint) {
  std::error_code error;
  fs::remove(checkpoint, error);
  if (error) note(fmt::format("{}: cannot be removed: {}", checkpoint.string(), error.message()));
}

void write_results(const fs::path& folder, const RomResult& result) {
  OutputFolder out(folder);
  write_whole_file(out.file("rom.json"), rom_json(result));
  write_whole_file(out.file("limits.csv"), rom_csv(result));
  write_whole_file(
      out.file("limits.svg"),
      limits_plot({result.joint.name, "How far each motion turns from its start"}, result.limits));
  if (result.map) {
    const JointAngle varied = result.map->grid.vary;
    const auto draw = [&](std::string_view name, MapView view) {
      write_whole_file(out.file(fmt::format("map_{}.svg", name)),
                       map_plot(plot_of(*result.map, view, result.joint.name)));
    };
    write_whole_file(out.file("map.csv"), map_csv(*result.map));
    draw(movement_name(varied, TurnSense::positive), MapView::positive_limit);
    draw(movement_name(varied, TurnSense::negative), MapView::negative_limit);
    draw("free_range", MapView::free_range);
  }
  out.commit();
}

void run(const Options& options) {
  const LoadedJoint loaded = read_joint(options.joint);
  const Joint& joint = loaded.joint;
  const std::vector<Motion> motions = chosen_motions(
      with_own_motions(built_in_motions(joint.kind), loaded.report.file.motions), options.motions);
  const std::optional<MapGrid> grid = grid_of(options, joint.kind);
  const RangeOptions asked = range_options(options, loaded.report.file.rest);
  // A folder that cannot be written to is told before the work, not after it.
  if (!options.out.empty()) OutputFolder{fs::path(options.out)};

  const RangeOfMotion range(joint, asked);
  const std::vector<MotionLimit> limits = range.limits(motions);
  const fs::path checkpoint = options.out.empty() ? fs::path() : fs::path(options.out) / checkpoint_name;
  std::optional<MotionMap> map;
  if (grid) map = computed_map(*grid, loaded, asked, range, checkpoint);

  const RomResult result{joint, limits, range.articular_region(), terms_of(asked, range),
                         map ? &*map : nullptr};
  if (!options.out.empty()) {
    write_results(options.out, result);
    if (map) remove_checkpoint(checkpoint);
  }
  print(options.form == AnswerForm::json ? rom_json(result) : rom_text(result));
}

}  // namespace

void add_rom(CLI::App& app) {
  auto* verb = app.add_subcommand("rom", "How far a joint turns before bone meets bone, where, and why");
  verb->footer(
      "Example: condyle sample hip --out sample\n"
      "         condyle rom sample/hip.toml --motion flexion --motion fadir\n"
      "         condyle rom sample/hip.toml --map flexion=0:120:10 adduction=-30:20:10 --out range\n"
      "An interrupted map (exit code 130) is kept in the --out folder; the same command goes on with it.");
  auto options = std::make_shared<Options>();
  verb->add_option("JOINT", options->joint, "Joint file (TOML)")->required();
  verb->add_option("--motion", options->motions, "A motion by its name; all if not given")
      ->expected(1)
      ->take_all();
  verb->add_option("--map", options->map,
                   "Limits over two held angles, first:last:step in degrees each, such as flexion=-20:120:1 "
                   "adduction=-40:30:1; the first one runs to the right")
      ->expected(2);
  verb->add_option("--vary", options->vary, "The angle that turns in the map: the third one");
  verb->add_option(
      "--exclude-radius", options->exclude_radius_mm,
      "Leave out what lies within this many mm of the joint centre: sliding surfaces that overlap");
  verb->add_flag_callback(
      "--exclude-rest", [options] { options->rest_contacts = RestContacts::leave_out; },
      "Leave out what is in contact at rest");
  verb->add_flag_callback(
      "--accept-rest", [options] { options->contact_at_rest = ContactAtRest::accept; },
      "Answer although the bodies are in contact at rest: motions that start in contact say so");
  verb->add_option("--out", options->out,
                   "Folder for rom.json, limits.csv and limits.svg, and map.csv and map_*.svg of a map");
  verb->add_flag_callback(
      "--json", [options] { options->form = AnswerForm::json; }, "Answer in JSON");
  verb->callback([options] { run(*options); });
}

}  // namespace condyle::cli
