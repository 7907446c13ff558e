#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <functional>
#include <list>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "answer/check_gains.hpp"
#include "choice.hpp"
#include "commands.hpp"
#include "condyle/error.hpp"
#include "condyle/io/label_file.hpp"
#include "condyle/range_of_motion.hpp"
#include "figures.hpp"
#include "interrupt.hpp"
#include "io/file/failure.hpp"
#include "io/file/output_file.hpp"
#include "io/file/output_folder.hpp"
#include "io/file/temporary_folder.hpp"
#include "io/image/hips_of_labels.hpp"
#include "io/image/unread_image.hpp"
#include "io/joint/settings_lines.hpp"
#include "io/report/answer_report.hpp"
#include "io/result/both_sides.hpp"
#include "io/result/crate.hpp"
#include "io/result/quoted_limit.hpp"
#include "io/result/rom_files.hpp"
#include "joint_command.hpp"
#include "label_options.hpp"
#include "model_options.hpp"
#include "proposed_files.hpp"
#include "range_options.hpp"
#include "resection_options.hpp"
#include "whole_number.hpp"

namespace condyle::cli {
namespace {

namespace fs = std::filesystem;

struct HipArguments {
  std::string pelvis, out;
  ResectionArguments cut;
  std::optional<std::string> crate_date;
  std::vector<std::string> femora;
  std::string fixed_label, mobile_label;
  LabelOptions labels;
  std::optional<Side> side;
  std::optional<LengthUnit> units;
  std::optional<io::PolygonRule> polygons;
  io::TextForm form = io::TextForm::brief;
  RangeArguments range;
  Person person;
  io::ReportLabels words;

  /// Where the joint file of a side lies; how its meshes are named from there is the same for both sides.
  fs::path joint_file(Side side_of_body) const {
    return fs::path(out) / std::string(name_of(side_of_body)) / "hip.toml";
  }
};

/// What was proposed for one femur, by labels with the surfaces of its bones.
struct Proposed {
  io::JointProposal joint;
  std::optional<io::LabelJoint> of_labels = {};
  std::string femur;  ///< as notes call it
};

/// A hip that was answered.
struct AnsweredHip {
  io::LoadedJoint loaded;
  std::vector<JointNote> notes;
  io::Provenance from;
  io::ReportAnswer answer = {};
  std::string planned = {};  ///< a line for people; empty without a plan

  std::optional<io::RomResult> limits() {
    if (!answer.range.answer) return std::nullopt;
    return io::rom_result_of(*answer.range.answer, notes, &from);
  }
};

/// Proposes the joint of one femur.
using Propose = std::function<Proposed()>;

/// Both bones of each hip in one label map, or the pelvis in one and the femora in maps of their own.
std::vector<Propose> joints_of_labels(const HipArguments& options) {
  using Map = std::shared_ptr<const io::LabelMap>;
  const auto read = [&](const std::string& file) {
    return std::make_shared<const io::LabelMap>(io::read_labels(file, options.labels.file));
  };
  const Map map = read(options.pelvis);
  const auto joint = [&options, map](const io::LabelHip& hip, const std::string& femur, const Map& of_femur) {
    const auto bone = [&](const std::string& label) {
      return io::LabelBoneRequest{label, options.labels.task, options.labels.surface};
    };
    io::LabelJointRequest request{.labels = options.pelvis,
                                  .file = options.labels.file,
                                  .fixed = bone(hip.fixed),
                                  .mobile = bone(hip.mobile),
                                  .joint_file = options.joint_file(Side::left)};
    if (hip.side_by_piece || options.side) request.side = hip.side;
    if (hip.side_by_piece) request.side_by = "of the femur's place among both";
    if (of_femur) request.mobile_labels = femur;
    auto found = with_progress(
        [&](const Control& control) { return io::propose_joint(*map, of_femur.get(), request, control); });
    return Proposed{found.proposal, found, found.mobile.name};
  };
  std::vector<Propose> joints;
  const auto add = [&](const io::LabelHip& hip, const std::string& femur = {}, const Map& of_femur = {}) {
    joints.emplace_back([=] { return joint(hip, femur, of_femur); });
  };
  for (const std::string& femur : options.femora) {
    const Map of_femur = read(femur);
    const bool both = options.femora.size() == 1 && !options.side &&
                      io::is_of_both_sides(*of_femur, options.mobile_label, options.labels.task);
    for (const auto& side : both ? std::vector<std::optional<Side>>{Side::left, Side::right}
                                 : std::vector<std::optional<Side>>{options.side})
      add({options.fixed_label, options.mobile_label, side, both}, femur, of_femur);
  }
  if (!joints.empty()) return joints;
  const io::LabelHips found = io::hips_in(
      *map, options.pelvis, {options.fixed_label, options.mobile_label, options.labels.task, options.side});
  for (const std::string& bone : found.left_out) note("not answered: " + bone);
  for (const io::LabelHip& hip : found.hips) add(hip);
  return joints;
}

std::vector<Propose> joints_of_meshes(const HipArguments& options) {
  if (options.femora.empty()) throw UsageError("FEMUR: the mesh of one femur is needed, or of both");
  std::vector<Propose> joints;
  const auto add = [&](io::ProposalRequest request, const std::string& femur) {
    joints.emplace_back([=] { return Proposed{io::propose_joint(request), std::nullopt, femur}; });
  };
  for (const std::string& femur : options.femora) {
    io::ProposalRequest request{.fixed = options.pelvis,
                                .mobile = femur,
                                .joint_file = options.joint_file(Side::left),
                                .side = options.side,
                                .units = options.units,
                                .anatomy = Anatomy::hip,
                                .polygons = options.polygons.value_or(io::PolygonRule::refuse),
                                .person = options.person};
    const std::vector<std::size_t> both = io::femora_in(request);
    if (both.empty()) add(request, femur);
    for (const std::size_t piece : both) {
      request.mobile_piece = piece;
      request.side.reset();  // each is of its own
      add(request, femur);
    }
  }
  return joints;
}

/// Writes a joint file and, of labels, its meshes; returns the side of the hip. Nothing is written of an incomplete proposal.
Side write_joint(const HipArguments& options, Proposed& proposed) {
  if (!proposed.joint.side || !proposed.joint.to_fill_in.empty())
    throw MeshError(fmt::format("{}: no joint file could be proposed: {}", proposed.femur,
                                fmt::join(proposed.joint.to_fill_in, "; ")));
  const Side side = *proposed.joint.side;
  const fs::path file = options.joint_file(side);
  if (fs::exists(file))
    throw UsageError(
        fmt::format("{}: is of the {} side, as another femur is: answer each by itself, with --side",
                    proposed.femur, name_of(side)));
  if (proposed.of_labels) {
    io::LabelJoint& joint = *proposed.of_labels;
    joint.proposal.toml += io::person_text(options.person);
    for (fs::path* mesh : {&joint.fixed_mesh, &joint.mobile_mesh})
      *mesh = file.parent_path() / mesh->filename();
    write_proposal(joint, file);
  } else {
    io::OutputFolder folder(file.parent_path());
    io::write_output_file(folder.file("hip.toml"), proposed.joint.toml);
    say_written(folder.commit());
    if (!proposed.joint.units_note.empty())
      note(fmt::format("{}: {}", name_of(side), proposed.joint.units_note));
  }
  return side;
}

/// "46.5 deg", and where no bone ends the motion that.
std::string turned_words(const motion::MotionLimit& limit) {
  if (limit.end.reason == motion::LimitReason::end_of_range) return io::beyond_range(limit, nullptr) + " deg";
  const bool is_cut = limit.end.contact && limit.end.kind() == motion::ContactKind::cut;
  return fmt::format("{:.1f} deg{}", limit.end.turned.degrees(), is_cut ? ", the cut of the image" : "");
}

/// Returns what was planned and what it reaches, in a line.
std::string write_plan(const fs::path& folder, AnsweredHip& hip, const io::ReportRequest& request,
                       const io::ReportWords& words, std::string_view whose) {
  const io::ReportAnswer answer =
      with_progress([&](const Control& control) { return io::answer_report(hip.loaded, request, control); });
  note_all(answer.plan->notes, whose);
  const io::ResectionResult result{hip.loaded.joint, *answer.plan, hip.notes, &hip.from,
                                   &hip.loaded.report.file};
  say_written(io::write_resection(folder / "plan", result));
  io::write_report(folder / "planned.html", hip.loaded, request, answer, words);
  say_written({folder / "planned.html"});
  std::string reached;
  for (std::size_t i = 0; i < answer.plan->promises.size(); ++i) {
    const plan::ReachOutcome& outcome = answer.plan->resection.targets[i];
    reached +=
        fmt::format("  {}{} {}, now {}: {}\n", whose, outcome.target.motion.name, turned_words(outcome.after),
                    turned_words(outcome.before), answer.plan->promises[i].text);
  }
  return fmt::format("  {}planned: {}\n{}", whose, answer.plan->resection.joint.planned, reached);
}

/// Limits with bands, shape, page and plan of one hip, beside its joint file.
void answer_hip(const HipArguments& options, Side side, const CLI::App& command,
                std::list<AnsweredHip>& answered) {
  const fs::path folder = options.joint_file(side).parent_path();
  const std::string whose = std::string(name_of(side)) + ": ";
  io::LoadedJoint loaded = io::read_joint(options.joint_file(side));
  io::Provenance from = io::provenance_of(loaded, words_of(command));
  AnsweredHip hip{std::move(loaded), {}, std::move(from)};
  hip.notes = noted(hip.loaded, Strictness::notes, whose);
  io::ReportRequest request{.range = range_request_of(options.range, hip.loaded, Case(hip.loaded).motions()),
                            .with_measures = true};
  std::optional<ResectionRequest> plan;
  if (!options.cut.targets.empty()) {
    plan.emplace().resection.targets = reach_targets(request.range.motions, options.cut.targets);
    plan->bands = request.range.bands;
    plan->confidence = confidence_of(options.cut, plan->bands);
    plan->curve_points = 0;  // each costs a cut: condyle resect has them
    check_gains(hip.loaded, request.range, *plan);
  }
  hip.answer =
      with_progress([&](const Control& control) { return io::answer_report(hip.loaded, request, control); });
  answered.push_back(std::move(hip));
  AnsweredHip& kept = answered.back();
  const io::ReportWords words{.labels = options.words, .notes = kept.notes, .from = &kept.from};
  if (const auto limits = kept.limits()) {
    note_all(kept.answer.range.answer->notes, whose);
    say_written(io::write_rom(folder / "limits", *limits));
  }
  say_written(io::write_measures(folder / "measures",
                                 {kept.loaded.joint, *kept.answer.measures, kept.notes, &kept.from}));
  io::write_report(folder / "hip.html", kept.loaded, request, kept.answer, words);
  say_written({folder / "hip.html"});
  if (!kept.answer.range.answer)  // throws the error that the page has as a sentence
    (void)with_progress(
        [&](const Control& control) { return answer_range(kept.loaded, request.range, control); });
  request.plan = std::move(plan);
  if (request.plan) kept.planned = write_plan(folder, kept, request, words, whose);
}

/// For each hip its surfaces, limits with bands and shape, and as much again for a plan with its cuts: about what each takes.
std::vector<std::vector<double>> pieces_of_work(const HipArguments& options, bool of_labels,
                                                std::size_t hips) {
  std::vector<std::vector<double>> pieces;
  for (std::size_t i = 0; i < hips; ++i) {
    if (of_labels) pieces.push_back({1, 1});
    pieces.push_back({2, 10});
    if (!options.cut.targets.empty()) pieces.push_back({10, 2, 3, 2, 10});
  }
  return pieces;
}

/// Refuses wrong bones before the work.
void check_bones(const HipArguments& options, bool are_labels) {
  if (!are_labels) (void)io::mesh_format_of(options.pelvis);
  for (const std::string& femur : options.femora)
    if (std::error_code ignored; femur.find('=') != femur.npos && !fs::exists(femur, ignored))
      throw UsageError("FEMUR: there is no file " + femur +
                       ": several targets of --plan stand in quotes, \"fadir=30 flexion=115\"");
}

void check_out(const HipArguments& options) {
  std::error_code ignored;
  if (!fs::is_directory(options.out, ignored) || !fs::is_empty(options.out, ignored))
    refuse_existing(options.out, "and is no empty folder");
}

void draw(const HipArguments& options) {
  std::vector<std::string> words{options.out.starts_with('-') ? "./" + options.out : options.out};
  const auto add = [&](const char* option, const std::optional<std::string>& text) {
    if (text) words.push_back(fmt::format("{}={}", option, *text));
  };
  add("--case", options.words.case_name);
  add("--date", options.words.date);
  add("--note", options.words.note);
  const std::string why = draw_figures(words);
  if (why.empty()) return;
  std::string line = "python3 -m condyle.plot";
  for (std::string word : words) {
    for (std::size_t at = 0; (at = word.find('\'', at)) != word.npos; at += 4) word.replace(at, 1, "'\\''");
    line += " '" + word + "'";
  }
  note(fmt::format("no figures and no sheet: {}; to draw them: {}", why, line));
}

/// All files of the folder, which was empty, and what was read from elsewhere for them.
void write_crate(const HipArguments& options, const io::InputRecorder& read, const io::Provenance& from) {
  const fs::path folder = options.out;
  io::CrateRun run{*options.crate_date, "condyle hip", io::command_text(from.command), {}};
  // A joint file names meshes from its own folder, so each is read under two names.
  std::set<fs::path> listed;
  for (io::Input& input : read.inputs())
    if (fs::relative(input.path, folder).string().starts_with("..") &&
        listed.insert(fs::weakly_canonical(input.path)).second)
      run.inputs.push_back(std::move(input));
  io::write_output_file(folder / io::crate_name, io::crate_document(run, folder, io::files_below(folder)));
  say_written({folder / io::crate_name});
}

void print_limits(const HipArguments& options, std::list<AnsweredHip>& hips) {
  AnsweredHip *left = nullptr, *right = nullptr;
  std::string plans;
  for (AnsweredHip& hip : hips) {
    if (hip.answer.range.answer) (hip.loaded.joint.side == Side::left ? left : right) = &hip;
    plans += hip.planned;
  }
  if (left && right) {
    const io::RomResult of_left = *left->limits(), of_right = *right->limits();
    const fs::path table = fs::path(options.out) / "both.csv";
    io::write_output_file(table, io::both_sides_csv(of_left, of_right));
    say_written({table});
    print(io::both_sides_text(of_left, of_right) + plans);
  } else if (left || right) {
    print(io::rom_text(*(left ? left : right)->limits(), options.form) + plans);
  }
}

/// The error that is being handled, as one of the same kind that begins with `whose`.
std::exception_ptr current_error_of(std::string_view whose) {
  const auto named = [&](const std::exception& error) { return std::string(whose) + error.what(); };
  try {
    throw;
  } catch (const motion::ReferenceContactError& error) {
    return std::make_exception_ptr(motion::ReferenceContactError(named(error)));
  } catch (const MeshError& error) {
    return std::make_exception_ptr(MeshError(named(error)));
  } catch (const FileError& error) {
    return std::make_exception_ptr(FileError(named(error)));
  } catch (const UsageError& error) {
    return std::make_exception_ptr(UsageError(named(error)));
  }
}

void hip_command(const HipArguments& options, const CLI::App& command) {
  if (options.crate_date) io::check_crate_date(*options.crate_date);
  using Digests = io::InputRecorder::Digests;
  const io::InputRecorder read(options.crate_date ? Digests::taken : Digests::left_out);
  check_out(options);
  io::refuse_unread_image(options.pelvis);
  const bool of_labels = io::label_format_of(options.pelvis).has_value();
  check_bones(options, of_labels);
  if (!of_labels) refuse_label_options(command, options.pelvis);
  if (!of_labels && !(options.fixed_label + options.mobile_label).empty())
    throw UsageError("--fixed, --mobile: are for label maps, and " + options.pelvis + " is none");
  if (options.side && options.femora.size() > 1)
    throw UsageError("--side: is for one femur: of two each is of its own side");
  if (of_labels && options.units) throw UsageError("--units: surfaces of label maps are in mm");
  if (of_labels && options.polygons) throw UsageError("--polygons: surfaces of label maps have none");
  say_as(options.form);
  if (!options.cut.targets.empty())
    (void)reach_targets(motion::hip_motions(), options.cut.targets);  // throws before the work
  // Another run that begins before this one ends finds no empty folder: it would read this one's joint.
  const io::TemporaryFolder held(options.out);
  if (!held.is_alone()) check_out(options);
  std::list<AnsweredHip> answered;
  std::exception_ptr refused;  // one hip without an answer does not keep the other from having one
  const std::vector<Propose> joints = of_labels ? joints_of_labels(options) : joints_of_meshes(options);
  const WholeProgress progress("hip", pieces_of_work(options, of_labels, joints.size()));
  for (const Propose& propose : joints) {
    std::string whose;
    fs::path folder;
    const std::size_t answered_before = answered.size();
    try {
      Proposed proposed = propose();
      if (options.side && proposed.joint.side.value_or(*options.side) != *options.side) continue;
      const Side side = write_joint(options, proposed);
      whose = std::string(name_of(side)) + ": ";
      folder = options.joint_file(side).parent_path();
      answer_hip(options, side, command, answered);
    } catch (const Interrupted&) {
      throw;
    } catch (const std::exception& error) {
      // An unfit mesh has a page that says so; of a disk that is full, or of a plan that is refused, nothing stays.
      std::error_code ignored;
      if (!folder.empty() && !dynamic_cast<const MeshError*>(&error)) {
        fs::remove_all(folder, ignored);
        while (answered.size() > answered_before) answered.pop_back();
      }
      if (refused) note(whose + io::failure_of_current_exception().message);
      if (!refused) refused = current_error_of(whose);
    }
  }
  print_limits(options, answered);
  const auto has_limits = [](const AnsweredHip& hip) { return hip.answer.range.answer.has_value(); };
  if (std::any_of(answered.begin(), answered.end(), has_limits)) draw(options);
  if (refused) std::rethrow_exception(refused);
  if (options.crate_date) write_crate(options, read, answered.front().from);
}

}  // namespace

void add_hip(CLI::App& app) {
  auto* command = app.add_subcommand(
      "hip", "Answer for a patient: joint files, limits, shape, figures, a sheet and a page of each hip");
  command->footer(
      "Example: condyle sample hip --voxel 2 --out bones\n"
      "         condyle hip bones/labels.nii.gz --task total --out patient\n"
      "         condyle hip bones/hip_bone.ply bones/femur.ply --side right --samples 40 --plan "
      "\"fadir=+10\" --out "
      "planned\n"
      "Each femur has the half of the pelvis beside it. What was assumed stands in hip.toml. "
      "Figures and sheets need Python with matplotlib.");
  auto options = std::make_shared<HipArguments>();
  options->range.band.samples = BandRequest{}.samples;
  command
      ->add_option(
          "PELVIS", options->pelvis,
          "The mesh of the pelvis or hip bone; or a label map, of both bones unless FEMUR is one too")
      ->required();
  command->add_option("FEMUR", options->femora, "The mesh of a femur, or of each; or label maps of them")
      ->expected(0, 2);
  add_value(*command, "--out", options->out, "FOLDER",
            "Write a folder for each side into this one, which is new or empty")
      ->required();
  add_value(*command, "--plan", options->cut.targets, "MOTION=DEG ...",
            "Plan the bone that must go for these motions to reach this far, as condyle resect --reach");
  add_confidence(*command, options->cut)->needs("--plan");
  add_side(*command, options->side,
           "Only this hip. Default: by the labels' names, else inferred from the bones");
  add_choice(*command, "--units", options->units,
             {{"mm", LengthUnit::millimetres},
              {"cm", LengthUnit::centimetres},
              {"in", LengthUnit::inches},
              {"m", LengthUnit::metres}},
             "The unit of the meshes. Default: inferred from their size");
  add_polygons(*command, options->polygons, "refuse");
  add_value(*command, "--fixed", options->fixed_label, "LABEL",
            "The label of the pelvis or hip bone: its number, or its name. Default: by its name");
  add_value(*command, "--mobile", options->mobile_label, "LABEL", "The label of the femur, or of both");
  add_label_surface(*command, options->labels);
  add_label_file(*command, options->labels);
  add_value(*command, "--samples", options->range.band.samples, "N (200)",
            "Varied joints of each band, from 5 to 95 % of them; 0 for limits without bands")
      ->check(whole_number(0));
  add_accept(*command, options->range);
  add_value(*command, "--case", options->words.case_name, "TEXT",
            "Begin the headings with this: a number or a pseudonym");
  add_person(*command, options->person);
  add_value(*command, "--note", options->words.note, "TEXT", "Put this under the results");
  add_value(*command, "--date", options->words.date, "TEXT", "Put this date into the headings");
  add_crate(*command, options->crate_date);
  add_verbose(*command, options->form);
  std::vector<std::string> of_labels{"--fixed", "--mobile"};
  for (const std::string& name : label_surface_names()) of_labels.push_back(name);
  group_help(*command, {{"Most used", {"--out", "--plan", "--side", "--task"}},
                        {"Question",
                         {"--confidence", "--age", "--sex", "--species", "--units", "--polygons", "--samples",
                          "--accept-reference-contact"}},
                        {"Label maps", of_labels},
                        {"Images", label_file_names()},
                        {"Output", {"--case", "--note", "--date", "--crate", "--verbose", "--help"}}});
  command->callback([options, command] { hip_command(*options, *command); });
}

}  // namespace condyle::cli
