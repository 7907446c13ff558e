#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <filesystem>
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
#include "condyle/impingement_zone.hpp"
#include "condyle/io/grid_text.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/io/output_folder.hpp"
#include "condyle/io/pose_text.hpp"
#include "condyle/io/rom_files.hpp"
#include "condyle/io/rom_result.hpp"
#include "condyle/motion_map.hpp"
#include "map.hpp"
#include "notes.hpp"

namespace condyle::cli {
namespace {

namespace fs = std::filesystem;

enum class Task { limits, list_motions };
enum class ReferenceContacts { count, leave_out };

struct Options {
  std::string joint, out, vary, translation;
  std::vector<std::string> motions, map;
  std::optional<double> allow_depth_mm, past_deg;
  std::size_t band_samples = 0;  ///< 0: no bands
  std::uint64_t seed = 1;
  std::optional<double> sigma_centre_mm, sigma_axes_deg, sigma_surface_mm;
  BearingOptions bearing;
  ReferenceContacts reference_contacts = ReferenceContacts::count;
  ReferenceContact reference_contact = ReferenceContact::refuse;
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
    const auto degrees = [&](JointAngle angle) { return angle_of(motion.start, angle).degrees(); };
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

/// The angle that is neither.
JointAngle third_angle(JointAngle a, JointAngle b) {
  for (const JointAngle angle : all_joint_angles)
    if (angle != a && angle != b) return angle;
  return JointAngle::internal_rotation;
}

std::optional<MapGrid> grid_of(const Options& options, const Joint& joint) {
  if (options.map.empty()) {
    if (!options.vary.empty()) throw UsageError("--vary: is for --map");
    return std::nullopt;
  }
  MapGrid grid;
  grid.column = parse_grid_axis(options.map[0], joint.anatomy);
  grid.row = parse_grid_axis(options.map[1], joint.anatomy);
  grid.vary = options.vary.empty() ? third_angle(grid.column.angle, grid.row.angle)
                                   : joint_angle_named(options.vary, joint.anatomy);
  check_grid(grid, joint.kind);
  return grid;
}

/// "count", or a margin in mm.
BearingOptions parse_bearing(const std::string& text) {
  BearingOptions bearing;
  if (text == "count") {
    bearing.rule = BearingRule::count;
  } else if (!CLI::detail::lexical_cast(text, bearing.margin_mm.emplace())) {
    throw UsageError("--bearing: '" + text + "' is neither a margin in mm nor count");
  }
  return bearing;
}

RangeOptions range_options(const Options& options, const JointAngles& reference_pose) {
  RangeOptions range;
  range.bearing = options.bearing;
  range.overlap.reference_pose = reference_pose;
  range.overlap.reference_contact = options.reference_contact;
  if (options.reference_contacts == ReferenceContacts::leave_out)
    range.overlap.leave_out_reference_contacts.emplace();
  return range;
}

/// What the options say, else the joint file, else what is usual.
BandOptions band_options(const Options& options, const Uncertainty& of_file) {
  BandOptions band{.sigma = of_file, .samples = options.band_samples, .seed = options.seed};
  if (options.sigma_centre_mm) band.sigma.centre_mm = *options.sigma_centre_mm;
  if (options.sigma_axes_deg) band.sigma.axes = Angle::degrees(*options.sigma_axes_deg);
  if (options.sigma_surface_mm) band.sigma.surface_mm = *options.sigma_surface_mm;
  return band;
}

/// The limits and what contacts are told apart by.
struct Limits {
  std::vector<MotionLimit> limits;
  std::vector<DepthLimit> depths;  ///< with a depth allowed
  BearingFinding bearing;
  BearingRule bearing_rule = BearingRule::count;
  std::vector<std::string> terms;
};

/// Where the deepest depth exceeds the allowed one.
Limits depth_limits(const Options& options, const Joint& joint, const std::vector<Motion>& motions) {
  AllowedDepth allowed;
  allowed.depth_mm = *options.allow_depth_mm;
  const DepthRange range(joint, allowed);
  Limits found{{}, range.limits(motions), range.bearing(), BearingRule::count, {}};
  for (const DepthLimit& depth : found.depths) found.limits.push_back(depth.limit);
  found.terms.push_back(fmt::format("allowed: a radial depth of {:g} mm; limits are searched for, not exact",
                                    allowed.depth_mm));
  return found;
}

/// What the answer must be read with.
std::vector<std::string> terms_of(const RangeOptions& options, const RangeOfMotion& range) {
  std::vector<std::string> terms;
  const OverlapOptions& overlap = options.overlap;
  if (overlap.leave_out_reference_contacts)
    terms.push_back(
        fmt::format("left out: triangles in contact in the reference pose and {} rings of neighbours, {} of "
                    "the fixed body and {} "
                    "of the mobile one",
                    overlap.leave_out_reference_contacts->rings, range.left_out().fixed_triangles,
                    range.left_out().mobile_triangles));
  if (overlap.reference_contact == ReferenceContact::accept)
    terms.emplace_back("contact in the reference pose is accepted: motions that start in contact say so");
  return terms;
}

/// The joint made ready; where its bodies are in contact in the reference pose, the error names the options
/// there are.
std::unique_ptr<RangeOfMotion> ready(const Joint& joint, const RangeOptions& options) {
  try {
    return std::make_unique<RangeOfMotion>(joint, options);
  } catch (const ReferenceContactError& error) {
    throw ReferenceContactError(std::string(error.what()) +
                                " (--allow-depth, --exclude-reference-contacts, "
                                "[reference_pose] in the joint file, --accept-reference-contact)");
  }
}

/// The translation that a free joint keeps in all its motions: that of its reference pose unless told otherwise. Empty
/// for joints that do not translate.
std::optional<Vec3> held_translation(const Options& options, const LoadedJoint& loaded) {
  const Joint& joint = loaded.joint;
  if (joint.kind != JointKind::free) {
    if (!options.translation.empty()) throw UsageError("--translation: only a free joint translates");
    return std::nullopt;
  }
  const PoseDegrees pose = parse_pose(options.translation, joint.kind, joint.anatomy);
  if (pose.angles() != JointAngles{}) throw UsageError("--translation: takes x, y and z only");
  const Vec3 held = options.translation.empty() ? loaded.report.placement.reference_pose.translation_mm
                                                : pose.translation_mm;
  if (joint.translation_frame == TranslationFrame::joint_axes && held != Vec3::Zero())
    throw UsageError(
        "--translation: held along the joint's axes it would turn with them: motions need \"x=0\" or "
        "translation_frame = \"fixed\"");
  return held;
}

/// The clock that is wanted; throws MeshError where the socket has none.
ClockFace clock_of(const Options& options, const Joint& joint, const BearingFinding& bearing) {
  if (options.clock == ClockPlane::sagittal) return sagittal_clock();
  const auto clock = bearing.surface ? find_rim_clock(joint.fixed.mesh, bearing.surface->head) : std::nullopt;
  if (!clock)
    throw MeshError(joint.fixed.name + ": no rim with a notch was found: there is only the sagittal clock");
  return *clock;
}

void run(const Options& options, const CLI::App& command) {
  const LoadedJoint loaded = read_joint(options.joint);
  const std::optional<Vec3> translation = held_translation(options, loaded);
  const Joint joint = held_at(loaded.joint, translation.value_or(Vec3::Zero()));
  const std::vector<Motion> known =
      with_own_motions(built_in_motions(joint.kind, joint.anatomy), loaded.report.file.motions);
  const std::vector<Motion> motions = chosen_motions(known, options.motions);
  if (options.task == Task::list_motions) return print(list_of(motions, joint.anatomy));
  const std::optional<MapGrid> grid = grid_of(options, joint);
  const RangeOptions asked = range_options(options, loaded.report.placement.reference_pose.angles);
  const std::vector<JointNote> notes = noted(loaded, options.strictness);
  std::optional<ZoneFinder> finder;
  if (options.past_deg)
    finder.emplace(joint, ZoneOptions{.bearing = options.bearing, .past = Angle::degrees(*options.past_deg)});
  // A folder that cannot be written to is reported before the work, not after it.
  if (!options.out.empty()) OutputFolder{fs::path(options.out)};

  Limits found;
  std::optional<MotionMap> map;
  if (options.allow_depth_mm) {
    found = depth_limits(options, joint, motions);
  } else {
    const auto range = ready(joint, asked);
    found = {range->limits(motions), {}, range->bearing(), range->bearing_rule(), terms_of(asked, *range)};
    if (grid) map = computed_map(*grid, *range);
  }
  if (translation)
    found.terms.push_back(fmt::format(
        "translation held at x {:g}, y {:g}, z {:g} mm: the mobile body turns about its own origin",
        translation->x(), translation->y(), translation->z()));
  const BandOptions band = band_options(options, loaded.report.file.uncertainty);
  std::vector<LimitBand> bands;
  if (options.band_samples > 0) {
    RangeOptions again = asked;
    again.bearing.surface = found.bearing.surface;
    bands = computed_bands(joint, motions, again, band);
  }
  std::vector<std::optional<ImpingementZone>> zones;
  if (finder)
    for (const MotionLimit& limit : found.limits) zones.push_back(finder->zone(limit));

  Provenance from = provenance_of(loaded, words_of(command), options.where->frame);
  if (translation) from.frame = from.frame.of_held(*translation);
  const RomResult result{.joint = joint,
                         .limits = found.limits,
                         .bearing = found.bearing,
                         .bearing_rule = found.bearing_rule,
                         .clock = clock_of(options, joint, found.bearing),
                         .clock_plane = options.clock,
                         .terms = found.terms,
                         .held_translation_mm = translation,
                         .notes = notes,
                         .depths = found.depths,
                         .zones = zones,
                         .map = map ? &*map : nullptr,
                         .bands = bands,
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
  auto* map =
      command
          ->add_option(
              "--map", options->map,
              "Limits over two held angles, first:last:step in degrees each, such as flexion=-20:120:1 "
              "adduction=-40:30:1; the first one runs to the right")
          ->expected(2);
  command->add_option(
      "--translation", options->translation,
      "Of a free joint: what all motions keep, such as \"x=1.5 y=-0.2 z=0\" in mm; without it "
      "that of the reference pose");
  command->add_option("--vary", options->vary, "The angle that varies in the map: the third one");
  command->add_option("--past", options->past_deg,
                      "Also find the impingement zones this many degrees past each limit");
  auto* bearing = command->add_option_function<std::string>(
      "--bearing", [options](const std::string& text) { options->bearing = parse_bearing(text); },
      "How far outside the head's sphere contact is bearing contact and does not end a motion, in mm; count: "
      "any "
      "contact ends a motion. 2 mm, or less where the rim is near, if not given");
  auto* contacts = command->add_flag_callback(
      "--exclude-reference-contacts",
      [options] { options->reference_contacts = ReferenceContacts::leave_out; },
      "Leave out what is in contact in the reference pose");
  auto* depth =
      command->add_option("--allow-depth", options->allow_depth_mm,
                          "End a motion where the radial depth exceeds this many mm, for meshes that "
                          "overlap wherever they are: searched for, not exact");
  auto* accept = command->add_flag_callback(
      "--accept-reference-contact", [options] { options->reference_contact = ReferenceContact::accept; },
      "Answer although the bodies are in contact in the reference pose: motions that start in contact say "
      "so");
  auto* band = command->add_flag("--band{200}", options->band_samples,
                                 "Also compute how far each limit moves with what is uncertain: 5 to 95 % of "
                                 "this many displaced joints, 200 if not "
                                 "given (--band=1000)");
  for (CLI::Option* other : {map, bearing, contacts, accept, band}) depth->excludes(other);
  const auto for_band = [&](CLI::Option* option) { option->needs(band); };
  for_band(
      command->add_option("--seed", options->seed, "With --band: seed of the displacements, 1 if not given"));
  for_band(command->add_option(
      "--sigma-centre", options->sigma_centre_mm,
      "With --band: standard deviation of each coordinate of the centre, 0.5 mm if neither this "
      "nor the joint file says"));
  for_band(command->add_option("--sigma-axes", options->sigma_axes_deg,
                               "With --band: of the rotation about each axis, 1 degree if not said"));
  for_band(command->add_option("--sigma-surface", options->sigma_surface_mm,
                               "With --band: of each surface along its normals, 0.25 mm if not said"));
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
