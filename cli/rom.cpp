#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "answer.hpp"
#include "command_line.hpp"
#include "commands.hpp"
#include "condyle/depth_limit.hpp"
#include "condyle/error.hpp"
#include "condyle/held_translation.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/io/pose_text.hpp"
#include "condyle/io/rom_files.hpp"
#include "condyle/io/rom_result.hpp"
#include "notes.hpp"
#include "range.hpp"
#include "range_options.hpp"

namespace condyle::cli {
namespace {

enum class Task { limits, list_motions };
enum class ReferenceContacts { count, leave_out };

struct Options {
  std::string joint, out;
  std::vector<std::string> motions;
  std::optional<double> allow_depth_mm;
  ReferenceContacts reference_contacts = ReferenceContacts::count;
  std::shared_ptr<RangeGiven> range = std::make_shared<RangeGiven>();
  Task task = Task::limits;
  ClockPlane clock = ClockPlane::sagittal;
  Strictness strictness = Strictness::notes;
  std::shared_ptr<WhereOptions> where = std::make_shared<WhereOptions>();
  AnswerForm form = AnswerForm::text;
};

/// The motions named, all where none is. A name may be a list parted by commas.
std::vector<Motion> chosen_motions(const std::vector<Motion>& known, const std::vector<std::string>& names) {
  if (names.empty()) return known;
  std::vector<Motion> chosen;
  for (const std::string& list : names)
    for (const std::string& name : CLI::detail::split(list, ',')) chosen.push_back(motion_named(known, name));
  return chosen;
}

/// One line per motion: its name, what varies and how far, and what is held.
std::string list_of(const std::vector<Motion>& motions, Anatomy joint) {
  std::size_t widest = 0;
  for (const Motion& motion : motions) widest = std::max(widest, motion.name.size());
  std::string text;
  for (const Motion& motion : motions) {
    const auto degrees = [&](JointAngle angle) { return angle_of(motion.start, angle).degrees() + 0.0; };
    const double from = degrees(motion.vary), to = from + sign_of(motion.sense) * motion.range.degrees();
    text += fmt::format("{:<{}}  {} from {:g} to {:g}", motion.name, widest, name_of(motion.vary, joint),
                        from, to);
    for (const JointAngle angle : all_joint_angles)
      if (angle != motion.vary && degrees(angle) != 0)
        text += fmt::format(", {} {:g}", name_of(angle, joint), degrees(angle));
    text += "\n";
  }
  return text;
}

RangeOptions range_options(const Options& options, const JointAngles& reference_pose) {
  RangeOptions range = range_options_of(*options.range, reference_pose);
  if (options.reference_contacts == ReferenceContacts::leave_out)
    range.overlap.leave_out_reference_contacts.emplace();
  return range;
}

/// The exact answer; where the bodies are in contact in the reference pose, the error names the options there are.
RangeFound exact_limits(const Joint& joint, const std::vector<Motion>& motions, const RangeOptions& asked,
                        const std::optional<MapGrid>& grid, const BandOptions& band) {
  try {
    return exact_range(joint, motions, asked, grid, band);
  } catch (const ReferenceContactError& error) {
    throw ReferenceContactError(std::string(error.what()) +
                                " (--allow-depth, --exclude-reference-contacts, "
                                "[reference_pose] in the joint file, --accept-reference-contact)");
  }
}

/// Where the deepest depth exceeds the allowed one.
RangeFound depth_limits(const Options& options, const Joint& joint, const std::vector<Motion>& motions) {
  AllowedDepth allowed;
  allowed.depth_mm = *options.allow_depth_mm;
  const DepthRange range(joint, allowed);
  RangeFound found;
  found.depths = range.limits(motions);
  found.bearing = range.bearing();
  for (const DepthLimit& depth : found.depths) found.limits.push_back(depth.limit);
  found.terms.push_back(fmt::format("allowed: a radial depth of {:g} mm; limits are searched for, not exact",
                                    allowed.depth_mm));
  return found;
}

/// The clock that is wanted; throws MeshError where the socket has none.
ClockFace clock_of(const Options& options, const Joint& joint) {
  if (options.clock == ClockPlane::sagittal) return sagittal_clock();
  const auto bearing = find_bearing_surface(joint, options.range->bearing).surface;
  const auto clock = bearing ? find_rim_clock(joint.fixed.mesh, bearing->head) : std::nullopt;
  if (!clock)
    throw MeshError(joint.fixed.name + ": no rim with a notch was found: there is only the sagittal clock");
  return *clock;
}

void run(const Options& options, const CLI::App& command) {
  const LoadedJoint loaded = read_joint(options.joint);
  const std::optional<Vec3> translation = held_translation(options.range->translation, loaded);
  const Joint joint = held_at(loaded.joint, translation.value_or(Vec3::Zero()));
  const std::vector<Motion> motions = chosen_motions(motions_of(loaded), options.motions);
  if (options.task == Task::list_motions) return print(list_of(motions, joint.anatomy));
  const std::optional<MapGrid> grid = grid_of(*options.range, joint.kind, joint.anatomy);
  const RangeOptions asked = range_options(options, loaded.report.placement.reference_pose.angles);
  const std::vector<JointNote> notes = noted(loaded, options.strictness);
  const ClockFace clock = clock_of(options, joint);
  const std::optional<ZoneFinder> finder = zone_finder_of(*options.range, joint, clock);
  Provenance from = provenance_of(loaded, words_of(command), options.where->frame);
  // A folder that cannot be written to is reported before the work, not after it.
  if (!options.out.empty()) check_rom_folder(options.out, &from);

  const BandOptions band = band_options_of(*options.range, loaded.report.file);
  RangeFound found = options.allow_depth_mm ? depth_limits(options, joint, motions)
                                            : exact_limits(joint, motions, asked, grid, band);
  if (translation) found.terms.push_back(term_of_held(*translation));
  const std::vector<std::optional<ImpingementZone>> zones = zones_of(finder, found.limits);

  if (translation) from.frame = from.frame.of_held(*translation);
  const RomResult result{.joint = joint,
                         .limits = found.limits,
                         .bearing = found.bearing,
                         .bearing_rule = found.bearing_rule,
                         .clock = clock,
                         .clock_plane = options.clock,
                         .terms = found.terms,
                         .held_translation_mm = translation,
                         .notes = notes,
                         .depths = found.depths,
                         .zones = zones,
                         .map = found.map ? &*found.map : nullptr,
                         .bands = found.bands,
                         .band_options = band,
                         .provenance = &from,
                         .vtp_encoding = options.where->vtp_encoding};
  if (!options.out.empty()) say_written(write_rom(options.out, result));
  print(options.form == AnswerForm::json ? rom_json(result) : rom_text(result));
}

}  // namespace

void add_rom(CLI::App& app) {
  auto* command = app.add_subcommand("rom", "How far a joint turns before bone meets bone, where, and why");
  command->footer(
      "Example: condyle sample hip --out sample\n"
      "         condyle rom sample/hip.toml --motion flexion --motion fadir\n"
      "         condyle rom sample/hip.toml --map flexion=0:120:10 adduction=-30:20:10 --out range\n"
      "Exit code 6: the bodies are in contact in the reference pose and no option says what to do about it.");
  auto options = std::make_shared<Options>();
  command->add_option("JOINT", options->joint, "Joint file (TOML)")->required();
  command
      ->add_option("--motion", options->motions,
                   "A motion by its name, or several parted by commas; all if not given")
      ->expected(1)
      ->take_all();
  command->add_flag_callback(
      "--list-motions", [options] { options->task = Task::list_motions; },
      "Say which motions there are, degrees from where to where, and end");
  auto* map = add_map(*command, options->range);
  add_past(*command, options->range);
  auto* bearing = add_bearing(*command, options->range);
  auto* contacts = command->add_flag_callback(
      "--exclude-reference-contacts",
      [options] { options->reference_contacts = ReferenceContacts::leave_out; },
      "Leave out what is in contact in the reference pose");
  auto* depth =
      command->add_option("--allow-depth", options->allow_depth_mm,
                          "End a motion where the radial depth exceeds this many mm, for meshes that "
                          "overlap wherever they are: searched for, not exact");
  auto* accept = add_accept(*command, options->range);
  auto* band = add_band(*command, options->range);
  for (CLI::Option* other : {map, bearing, contacts, accept, band}) depth->excludes(other);
  command
      ->add_option_function<std::string>(
          "--clock",
          [options](const std::string& name) {
            options->clock = name == "rim" ? ClockPlane::rim : ClockPlane::sagittal;
          },
          "Where contacts are read on the socket's clock: in the sagittal plane, or in that of the rim with "
          "6 at the notch")
      ->check(CLI::IsMember({"sagittal", "rim"}))
      ->option_text("sagittal|rim (sagittal)");
  command->add_option(
      "--out", options->out,
      "Folder for rom.json, limits.csv and bearing.vtp, map.csv, map_intervals.csv and map.vtp of a "
      "map, zone_*.vtp of zones; python3 -m condyle.plot draws what is in it");
  add_where(*command, options->where);
  command->add_flag_callback(
      "--json", [options] { options->form = AnswerForm::json; }, "Answer in JSON");
  add_strict(*command, options->strictness);
  command->callback([options, command] { run(*options, *command); });
}

}  // namespace condyle::cli
