// condyle-bench: how fast Condyle answers, beside other libraries asked the same in the same run.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/io/whole_file.hpp"
#include "machine.hpp"
#include "questions.hpp"
#include "scenes.hpp"
#include "timing.hpp"

namespace bench {
namespace {

struct Question {
  std::string_view name;
  void (*ask)(const condyle::Joint&, Effort, Report&);
  std::vector<std::string_view> scenes, quick_scenes;
};

const std::array<Question, 3> questions = {{
    {"first_contact", ask_first_contact, {"sample_1", "sample_2", "sample_3", "sample_4"}, {"sample_1"}},
    {"motion_map", ask_motion_map, {"hip_vhf_right", "sample_3"}, {"sample_1"}},
    {"vertex_tables",
     ask_vertex_tables,
     {"hip_libhip_m1_left", "sample_1", "sample_2", "sample_3", "sample_4"},
     {"sample_1"}},
}};

struct Options {
  std::string filter, json;
  Effort effort = Effort::full;
};

bool is_asked(const Question& question, std::string_view scene, const Options& options) {
  const auto& scenes = options.effort == Effort::full ? question.scenes : question.quick_scenes;
  return std::find(scenes.begin(), scenes.end(), scene) != scenes.end() &&
         fmt::format("{}/{}", question.name, scene).find(options.filter) != std::string::npos;
}

/// "full" for everything, which alone is fit to be published.
std::string description(const Options& options) {
  const std::string effort = options.effort == Effort::full ? "full" : "quick";
  return options.filter.empty() ? effort : fmt::format("{}, of {}", effort, options.filter);
}

/// Asks each scene everything that is to be asked of it, so that it is made once.
void run(const Options& options, Report& report) {
  for (const std::string_view scene : scene_names()) {
    std::optional<condyle::Joint> joint;
    for (const Question& question : questions) {
      if (!is_asked(question, scene, options)) continue;
      const std::string name = fmt::format("{}/{}", question.name, scene);
      if (!joint) joint = make_scene(scene);
      if (!joint) {
        report.skipped.push_back(name + ": its meshes are not there");
        continue;
      }
      const Stopwatch watch;
      question.ask(*joint, options.effort, report);
      fmt::print(stderr, "{}: {:.1f} s\n", name, watch.wall_seconds());
    }
  }
}

int print(const Report& report, const Options& options) {
  for (const auto& [name, words] : report.machine) fmt::print("{:<10} {}\n", name, words);
  for (const Table& table : report.tables) fmt::print("\n{}", terminal_text(table));
  for (const std::string& what : report.skipped) fmt::print("\nskipped: {}\n", what);
  for (const std::string& what : report.disagreements) fmt::print("\nDISAGREES: {}\n", what);
  if (!options.json.empty()) condyle::write_whole_file(options.json, to_json(report).dump(1) + "\n");
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
  app.add_option("--filter", options.filter, "Only measurements with this in their name, question/scene");
  app.add_flag_callback(
      "--quick", [&] { options.effort = bench::Effort::quick; }, "Small scenes, once: answers, hardly times");
  app.add_option("--json", options.json, "Write the tables to this file too");
  CLI11_PARSE(app, argc, argv);
  try {
    bench::Report report;
    report.machine = bench::describe_machine();
    report.machine.emplace_back("run", description(options));
    const double load_before = bench::load_average();
    bench::run(options, report);
    report.machine.emplace_back("load", fmt::format("{:.1f} before, {:.1f} after (this program included)",
                                                    load_before, bench::load_average()));
    return bench::print(report, options);
  } catch (const std::exception& error) {
    fmt::print(stderr, "condyle-bench: {}\n", error.what());
    return 2;
  }
}
