// condyle-bench: how fast Condyle answers, beside other libraries asked the same in the same run.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Validators.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "baseline.hpp"
#include "commands.hpp"
#include "experiment_tables.hpp"
#include "goals.hpp"
#include "io/file/whole_file.hpp"
#include "machine.hpp"
#include "questions.hpp"
#include "scenes.hpp"
#include "timing.hpp"

namespace bench {
namespace {

/// Questions beside the experiment, at these scenes.
struct JointQuestion {
  std::string_view name;
  void (*ask)(const Scene&, Effort, Report&);
  std::vector<std::string_view> scenes, quick_scenes;
};

const std::array<JointQuestion, 11> joint_questions = {{
    {"beside_others", ask_beside_others, {"hip_vhf_right"}, {"sample_1"}},
    {"threads", ask_threads, {"hip_vhf_right"}, {"sample_1"}},
    {"first_contact", ask_first_contact, {"sample_1", "sample_2", "sample_3", "sample_4"}, {"sample_1"}},
    {"motion_map", ask_motion_map, {"hip_vhf_right", "sample_3"}, {"sample_1"}},
    {"limit_bands", ask_limit_bands, {"hip_vhf_right"}, {"sample_1"}},
    {"radial_table",
     ask_radial_table,
     {"libhip_1", "libhip_2", "libhip_3", "libhip_4", "ball_0.1mm_4"},
     {"sample_1"}},
    {"inside_limits",
     ask_inside_limits,
     {"libhip_1", "libhip_2", "libhip_3", "libhip_4", "ball_0.1mm_1", "ball_0.1mm_4", "libhip_cartilage_gap",
      "libhip_cartilage_nogap", "sample_8"},
     {"sample_1"}},
    {"ring_table", ask_ring_table, {"libhip_1", "libhip_2", "libhip_3", "libhip_4"}, {"sample_1"}},
    {"direction_maps", ask_direction_maps, {"sample_1", "sample_3", "sample_8"}, {"sample_1"}},
    {"tetrahedra",
     ask_tetrahedra,
     {"sample_1", "sample_2", "sample_3", "sample_4", "sample_5", "sample_6", "sample_7", "sample_8"},
     {"sample_1"}},
    {"deforming", ask_deforming, {"hip_vhf_right", "libhip_cartilage_nogap"}, {"sample_1"}},
}};

/// Questions to a joint in its recorded motion.
struct MotionQuestion {
  std::string_view name;  ///< question/joint
  bool (*ask)(Effort, Report&);
};

constexpr std::array<MotionQuestion, 3> motion_questions = {{
    {"knee_pressure/knee_lenhart2015_right", ask_knee_pressure},
    {"hip_balance/hip_libhip_m1_left", ask_hip_balance},
    {"walking_bones/hip_vhf_right", ask_walking_bones},
}};

/// Small ones of every group.
constexpr std::array<std::string_view, 3> quick_scenes = {"sample_1", "libhip_cartilage_nogap",
                                                          "ball_0.1mm_1"};

struct Options {
  std::string filter, json, csv, baseline, runs, compare;
  bool is_summary = false;
  Effort effort = Effort::full;
};

bool contains(std::span<const std::string_view> names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool is_asked(const JointQuestion& question, std::string_view scene, const Options& options) {
  if (options.is_summary && question.name != "beside_others" && question.name != "threads") return false;
  return contains(options.effort == Effort::full ? question.scenes : question.quick_scenes, scene) &&
         fmt::format("{}/{}", question.name, scene).find(options.filter) != std::string::npos;
}

/// Whether any method would be asked anything there.
bool has_experiment(std::string_view scene, const Options& options) {
  if (options.is_summary) return false;
  if (options.effort == Effort::quick && !contains(quick_scenes, scene)) return false;
  const ExperimentFilter filter{options.filter};
  for (const MethodGroup& group : method_groups())
    for (const MethodKind& kind : group.kinds)
      for (const Question question : {Question::touch, Question::pairs, Question::inside})
        if (filter.takes(question, scene, kind.name)) return true;
  return false;
}

/// "full" for everything, or "summary" for all of that: these alone are fit to be published.
std::string description(const Options& options) {
  const std::string effort = options.effort == Effort::quick ? "quick"
                             : options.is_summary            ? "summary"
                                                             : "full";
  return options.filter.empty() ? effort : fmt::format("{}, of {}", effort, options.filter);
}

/// A scene is made once, when the first one asks for it.
class LazyScene {
 public:
  explicit LazyScene(std::string_view name) : name_(name) {}
  /// Null where its meshes are not there.
  const Scene* get() {
    if (!is_made_) scene_ = make_scene(name_);
    is_made_ = true;
    return scene_ ? &*scene_ : nullptr;
  }

 private:
  std::string_view name_;
  std::optional<Scene> scene_;
  bool is_made_ = false;
};

/// Results of a run: the experiment, and ratios of whole commands.
struct Measured {
  ExperimentResult experiment;
  Ratios of_commands;

  /// The experiment's own come first: it asks at more poses than others.
  Ratios ratios(const Report& report) const {
    Ratios all = ratios_of(experiment);
    all.insert(of_commands.begin(), of_commands.end());
    all.insert(report.ratios.begin(), report.ratios.end());
    return all;
  }
};

void write_files(const Report& report, const Measured& measured, const Options& options) {
  if (!options.json.empty()) condyle::io::write_whole_file(options.json, to_json(report).dump(1) + "\n");
  if (!options.baseline.empty())
    condyle::io::write_whole_file(options.baseline, baseline_text(measured.ratios(report)));
  if (options.csv.empty()) return;
  for (const Table& table : report.tables)
    if (table.head.is_long) condyle::io::write_whole_file(options.csv, csv_text(table));
}

/// The tables of the experiment, and what it could not do.
void finish(const ExperimentResult& experiment, Report& report) {
  add_goals(experiment, report);
  add_tables(experiment, report);
  for (const MethodGroup& group : method_groups())
    if (!group.is_built)
      report.skipped.push_back(group.package + " is not installed: its methods are left out");
  report.skipped.insert(report.skipped.end(), experiment.skipped.begin(), experiment.skipped.end());
  report.disagreements.insert(report.disagreements.end(), experiment.disagreements.begin(),
                              experiment.disagreements.end());
}

/// Results so far are kept if a run is broken off: under the names of its files, marked as partial.
void write_unfinished(Report report, const Measured& measured, const Options& options) {
  report.machine.emplace_back("unfinished", "broken off before its end");
  finish(measured.experiment, report);
  write_files(report, measured, options);
}

Measured run(const Options& options, Report& report) {
  Measured measured;
  ExperimentResult& experiment = measured.experiment;
  const Budget budget = options.effort == Effort::full ? Budget{} : Budget::quick();
  for (const SceneName& name : scene_names()) {
    LazyScene scene(name.name);
    const auto timed = [&](std::string_view what, const auto& ask) {
      if (!scene.get()) {
        report.skipped.push_back(fmt::format("{}/{}: its meshes are not there", what, name.name));
        return;
      }
      const Stopwatch watch;
      ask(*scene.get());
      fmt::print(stderr, "{}/{}: {:.1f} s\n", what, name.name, watch.wall_seconds());
    };
    for (const JointQuestion& question : joint_questions)
      if (is_asked(question, name.name, options))
        timed(question.name, [&](const Scene& s) { question.ask(s, options.effort, report); });
    if (has_experiment(name.name, options))
      timed("experiment", [&](const Scene& s) {
        run_experiment(name, s, ExperimentFilter{options.filter}, budget, experiment);
      });
    write_unfinished(report, measured, options);
  }
  for (const MotionQuestion& question : motion_questions) {
    if (options.is_summary) break;
    if (question.name.find(options.filter) == std::string_view::npos) continue;
    const Stopwatch watch;
    if (question.ask(options.effort, report))
      fmt::print(stderr, "{}: {:.1f} s\n", question.name, watch.wall_seconds());
    else
      report.skipped.push_back(fmt::format("{}: its meshes or its motion are not there", question.name));
    write_unfinished(report, measured, options);
  }
  for (const std::string& joint : command_joints(options.effort)) {
    if (options.is_summary) break;
    if (fmt::format("command/{}", joint).find(options.filter) == std::string::npos) continue;
    const Stopwatch watch;
    measured.of_commands.merge(ask_commands(joint, options.effort, report));
    fmt::print(stderr, "command/{}: {:.1f} s\n", joint, watch.wall_seconds());
    write_unfinished(report, measured, options);
  }
  finish(experiment, report);
  return measured;
}

/// How many ratios got worse.
std::size_t print_comparison(const Measured& measured, const Report& report, const Options& options) {
  if (options.compare.empty()) return 0;
  const std::vector<std::string> worse = worse_than(read_baseline(options.compare), measured.ratios(report));
  for (const std::string& line : worse) fmt::print("\nWORSE: {}\n", line);
  if (worse.empty()) fmt::print("\nNo ratio is worse than in {}\n", options.compare);
  return worse.size();
}

int print(const Report& report) {
  for (const auto& [name, words] : report.machine) fmt::print("{:<10} {}\n", name, words);
  for (const Table& table : report.tables)
    if (!table.head.is_long) fmt::print("\n{}", terminal_text(table));
  for (const std::string& what : report.skipped) fmt::print("\nskipped: {}\n", what);
  for (const std::string& what : report.disagreements) fmt::print("\nDISAGREES: {}\n", what);
  if (report.tables.empty()) {
    fmt::print(stderr, "condyle-bench: nothing was measured; --filter matches nothing that is there\n");
    return 2;
  }
  return report.disagreements.empty() ? 0 : 1;
}

}  // namespace
}  // namespace bench

int main(int argc, char** argv) {
  CLI::App app("How fast Condyle answers, beside other libraries asked the same in the same run");
  bench::Options options;
  app.add_option("--filter", options.filter,
                 "Only measurements with all these words, parted by commas, in question/scene/method");
  app.add_flag_callback(
      "--quick", [&] { options.effort = bench::Effort::quick; }, "Small scenes, once: answers, hardly times");
  app.add_flag("--summary", options.is_summary,
               "Only six questions to Condyle and to the others, with what each answers wrongly, and the use "
               "of threads: minutes");
  app.add_option("--json", options.json, "Write all tables to this file too");
  app.add_option(
      "--csv", options.csv,
      "Write every outcome of the experiment to this file, a line each; bench/draw_experiment.py draws it");
  app.add_option("--save-baseline", options.baseline, "Write the ratios of this run, for --compare");
  app.add_option(
      "--add-run", options.runs,
      "Add the main ratios of this run to this file of stored runs, from which a page shows them over time");
  app.add_option("--compare", options.compare,
                 "Say which ratios are worse than in this baseline; then exit 1")
      ->check(CLI::ExistingFile);
  app.footer(
      "Examples:\n"
      "  condyle-bench --quick\n"
      "  condyle-bench --summary --json summary.json\n"
      "  condyle-bench --filter inside,sample_4\n"
      "  condyle-bench --filter embree --csv embree.csv\n"
      "  condyle-bench --compare bench/baseline.json");
  CLI11_PARSE(app, argc, argv);
  try {
    if (!options.runs.empty() && (options.effort == bench::Effort::quick || !options.filter.empty()))
      throw std::runtime_error(
          "--add-run stores whole runs and those of --summary, not of --quick or --filter");
    bench::Report report;
    report.machine = bench::describe_machine();
    report.machine.emplace_back("run", description(options));
    const double load_before = bench::load_average();
    const bench::Measured measured = bench::run(options, report);
    report.machine.emplace_back("load", fmt::format("{:.1f} before, {:.1f} after (this program included)",
                                                    load_before, bench::load_average()));
    bench::write_files(report, measured, options);
    if (!options.runs.empty()) bench::add_run(options.runs, report, measured.ratios(report));
    const int printed = bench::print(report);
    return bench::print_comparison(measured, report, options) > 0 ? 1 : printed;
  } catch (const std::exception& error) {
    fmt::print(stderr, "condyle-bench: {}\n", error.what());
    return 2;
  }
}
