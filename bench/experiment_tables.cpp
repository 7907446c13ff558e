#include "experiment_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <map>

#include "growth.hpp"

namespace bench {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::string shown(double value, int digits = 3) {
  return text(Cell(value), digits);
}

std::string title_of(std::string_view group) {
  std::string words(group);
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

std::vector<SceneName> scenes_of(std::string_view group) {
  std::vector<SceneName> scenes;
  for (const SceneName& scene : scene_names())
    if (scene.group == group) scenes.push_back(scene);
  return scenes;
}

std::vector<std::string_view> groups() {
  std::vector<std::string_view> all;
  for (const SceneName& scene : scene_names())
    if (all.empty() || all.back() != scene.group) all.push_back(scene.group);
  return all;
}

std::vector<MethodKind> kinds() {
  std::vector<MethodKind> all;
  for (MethodGroup& group : method_groups())
    for (MethodKind& kind : group.kinds) all.push_back(std::move(kind));
  return all;
}

using Takes = std::function<bool(const Outcome&)>;

/// The outcomes of one method at some scenes, in their order; null where there is none.
std::vector<const Outcome*> at_scenes(const ExperimentResult& result, const std::vector<SceneName>& scenes,
                                      const MethodKind& kind, const Takes& takes) {
  std::vector<const Outcome*> found;
  for (const SceneName& scene : scenes) {
    const auto at = std::find_if(result.outcomes.begin(), result.outcomes.end(), [&](const Outcome& o) {
      return o.scene == scene.name && o.method == kind.name && takes(o);
    });
    found.push_back(at == result.outcomes.end() ? nullptr : &*at);
  }
  return found;
}

bool is_one_family(const std::vector<SceneName>& scenes) {
  return std::all_of(scenes.begin(), scenes.end(),
                     [&](const SceneName& scene) { return scene.family == scenes.front().family; });
}

/// A row per method, a column per scene; where the scenes are one shape, one more for how the cost grows with
/// the number of triangles of the fixed body.
void add_by_scene(const ExperimentResult& result, std::string_view group, const std::string& name,
                  const std::string& title, const Takes& takes,
                  const std::function<std::string(const Outcome&)>& cell,
                  const std::function<double(const Outcome&)>& cost, Report& report) {
  const std::vector<SceneName> scenes = scenes_of(group);
  const bool grows = is_one_family(scenes) && scenes.size() > 2;
  TableHead head{name, title, {{"method", "method"}}};
  for (const SceneName& scene : scenes)
    head.columns.push_back({std::string(scene.name), std::string(scene.name)});
  if (grows) head.columns.push_back({"exponent", "exponent"});
  for (const MethodKind& kind : kinds()) {
    const auto outcomes = at_scenes(result, scenes, kind, takes);
    if (std::all_of(outcomes.begin(), outcomes.end(), [](const Outcome* o) { return o == nullptr; }))
      continue;
    std::vector<Cell> row = {kind.title};
    std::vector<SizeAndCost> measured;
    for (const Outcome* outcome : outcomes) {
      row.emplace_back(outcome ? cell(*outcome) : "-");
      if (outcome) measured.push_back({static_cast<double>(outcome->fixed_triangles), cost(*outcome)});
    }
    const auto exponent = fitted_exponent(measured);
    if (grows) row.emplace_back(exponent ? fmt::format("{:.2f}", *exponent) : "-");
    report.table(head).add(std::move(row));
  }
}

std::string ms_and_ratio(const Outcome& outcome) {
  const std::string ms = shown(outcome.query.mean * 1e3);
  return outcome.ours_seconds > 0
             ? fmt::format("{} ({})", ms, shown(outcome.query.mean / outcome.ours_seconds, 2))
             : ms;
}

void add_costs(const ExperimentResult& result, std::string_view group, Report& report) {
  const std::map<Question, std::string> asked = {{Question::touch, "Do they touch"},
                                                 {Question::pairs, "All pairs of triangles"},
                                                 {Question::inside, "Every vertex: inside, where, how deep"}};
  for (const auto& [question, words] : asked)
    add_by_scene(
        result, group, fmt::format("{}_{}", name_of(question), group),
        fmt::format("{}: {}; ms per pose (times Condyle's)", words, title_of(group)),
        [question = question](const Outcome& o) { return o.question == question && !o.is_deformed; },
        ms_and_ratio, [](const Outcome& o) { return o.query.mean; }, report);
  for (const auto& [question, words] : asked)
    add_by_scene(
        result, group, fmt::format("deformed_{}_{}", name_of(question), group),
        fmt::format("{}, after the fixed body deformed: {}; ms of the first step; then, of a motion followed "
                    "before, ms to "
                    "follow it + ms per pose",
                    words, title_of(group)),
        [question = question](const Outcome& o) { return o.question == question && o.is_deformed; },
        [](const Outcome& o) {
          return fmt::format("{}; {} + {}", shown(*o.first_step_seconds * 1e3),
                             shown(*o.update_seconds * 1e3), shown(o.query.mean * 1e3));
        },
        [](const Outcome& o) { return *o.update_seconds + o.query.mean; }, report);
}

void add_ready(const ExperimentResult& result, std::string_view group, Report& report) {
  const auto any = [](const Outcome& o) { return !o.is_deformed; };
  add_by_scene(
      result, group, fmt::format("ready_{}", group),
      fmt::format("Made ready, both bodies: {}; ms", title_of(group)), any,
      [](const Outcome& o) { return shown(o.build_seconds * 1e3); },
      [](const Outcome& o) { return o.build_seconds; }, report);
  add_by_scene(
      result, group, fmt::format("memory_{}", group),
      fmt::format("Memory of what was built, bytes per fixed triangle: {}", title_of(group)),
      [](const Outcome& o) { return !o.is_deformed && o.bytes > 0; },
      [](const Outcome& o) {
        return fmt::format("{:.0f}", static_cast<double>(o.bytes) / static_cast<double>(o.fixed_triangles));
      },
      [](const Outcome& o) { return static_cast<double>(o.bytes); }, report);
}

/// Everything a method answered in a group, deformed or not.
struct Agreement {
  std::int64_t poses = 0;
  InsideAccuracy inside;
  TouchAccuracy touch;
  PairAccuracy pairs;
  bool has_inside = false, has_touch = false, has_pairs = false;

  void add(const Outcome& o) {
    poses += static_cast<std::int64_t>(o.poses);
    if (o.inside) has_inside = true, inside += *o.inside;
    if (o.touch) has_touch = true, touch += *o.touch;
    if (o.pairs) has_pairs = true, pairs += *o.pairs;
  }
};

void add_accuracy(const ExperimentResult& result, std::string_view group, Report& report) {
  const TableHead head{
      fmt::format("accuracy_{}", group),
      fmt::format("Held against the exact answers: {}, all scenes, deformed too", title_of(group)),
      {{"method", "method"},
       {"poses", "poses asked"},
       {"touch_missed", "contacts missed"},
       {"touch_invented", "invented"},
       {"pairs_missed", "pairs missed"},
       {"pairs_invented", "invented"},
       {"inside", "vertices inside"},
       {"false_outside", "called outside"},
       {"false_inside", "falsely called inside"},
       {"depth_error_mean_mm", "depth off by, mean, mm"},
       {"depth_error_max_mm", "largest, mm"}}};
  const std::vector<SceneName> scenes = scenes_of(group);
  for (const MethodKind& kind : kinds()) {
    Agreement sum;
    for (const Outcome& outcome : result.outcomes) {
      const bool here = std::any_of(scenes.begin(), scenes.end(),
                                    [&](const SceneName& scene) { return scene.name == outcome.scene; });
      if (here && outcome.method == kind.name) sum.add(outcome);
    }
    if (sum.poses == 0) continue;
    const auto of = [](std::int64_t wrong, std::int64_t all) { return fmt::format("{} of {}", wrong, all); };
    const auto count = [](bool is_there, std::int64_t n) { return is_there ? fmt::format("{}", n) : "-"; };
    const bool has_depth = sum.inside.depths > 0;
    report.table(head).add(
        {kind.title, sum.poses, sum.has_touch ? of(sum.touch.missed, sum.touch.touching) : "-",
         count(sum.has_touch, sum.touch.invented),
         sum.has_pairs ? of(sum.pairs.missed, sum.pairs.pairs) : "-",
         count(sum.has_pairs, sum.pairs.invented), count(sum.has_inside, sum.inside.inside),
         count(sum.has_inside, sum.inside.false_outside), count(sum.has_inside, sum.inside.false_inside),
         has_depth ? shown(sum.inside.mean_depth_error_mm(), 2) : "-",
         has_depth ? shown(sum.inside.depth_error_max_mm, 2) : "-"});
  }
}

/// Condyle's own fastest query for the vertices inside.
constexpr std::string_view our_method = "radial";

const TableHead spread_head{"inside_spread",
                            "Every vertex, Condyle in vectors: over the poses, and with empty caches",
                            {{"scene", "scene"},
                             {"mean_us", "mean, µs"},
                             {"p50_us", "median pose, µs"},
                             {"p95_us", "95th of 100, µs"},
                             {"cold_us", "caches empty, µs"},
                             {"thread_speed_up", "all threads over one"}}};

/// Work of the fastest query, and the spread of its cost over poses.
void add_our_details(const ExperimentResult& result, Report& report) {
  for (const Outcome& o : result.outcomes) {
    if (o.method != our_method || o.question != Question::inside || o.is_deformed) continue;
    report.table(spread_head)
        .add({o.scene, o.query.mean * 1e6, o.query.p50 * 1e6, o.query.p95 * 1e6, o.cold_seconds * 1e6,
              o.thread_speed_up ? Cell(*o.thread_speed_up) : Cell("-")});
    TableHead head{
        "inside_work", "Every vertex, Condyle in vectors: looked at per pose", {{"scene", "scene"}}};
    std::vector<Cell> row = {o.scene};
    head.columns.push_back({"vertices", "vertices"});
    row.emplace_back(static_cast<std::int64_t>(o.mobile_vertices));
    for (const auto& [name, count] : o.work) {
      head.columns.push_back({name, name});
      row.emplace_back(count);
    }
    const auto poses = static_cast<double>(std::max<std::size_t>(o.poses, 1));
    head.columns.push_back({"inside", "inside"});
    row.emplace_back(o.inside ? static_cast<double>(o.inside->inside) / poses : 0.0);
    report.table(head).add(std::move(row));
  }
}

const TableHead long_head{"experiment",
                          "All outcomes",
                          {{"scene", "scene"},
                           {"scene_family", "family of scenes"},
                           {"question", "question"},
                           {"deformed", "deformed"},
                           {"method", "method"},
                           {"method_title", "in words"},
                           {"method_family", "family of methods"},
                           {"fixed_triangles", "fixed triangles"},
                           {"mobile_vertices", "mobile vertices"},
                           {"poses", "poses"},
                           {"build_ms", "build, ms"},
                           {"first_step_ms", "first step, ms"},
                           {"update_ms", "update, ms"},
                           {"query_ms", "query, ms"},
                           {"query_p50_ms", "p50, ms"},
                           {"query_p95_ms", "p95, ms"},
                           {"query_spread", "spread of rounds"},
                           {"query_cold_ms", "cold, ms"},
                           {"condyle_ms", "Condyle, ms"},
                           {"ratio", "ratio"},
                           {"thread_speed_up", "all threads over one"},
                           {"bytes", "bytes"},
                           {"vertices_inside", "inside"},
                           {"false_inside", "false inside"},
                           {"false_outside", "false outside"},
                           {"depth_error_mean_mm", "mean depth error, mm"},
                           {"depth_error_max_mm", "largest depth error, mm"},
                           {"touching", "touching"},
                           {"touch_missed", "missed"},
                           {"touch_invented", "invented"},
                           {"pairs", "pairs"},
                           {"pairs_missed", "missed"},
                           {"pairs_invented", "invented"},
                           {"work_per_pose", "work per pose"}},
                          true};

std::string work_text(const Work& work) {
  std::string words;
  for (const auto& [name, count] : work)
    words += fmt::format("{}{}: {}", words.empty() ? "" : "; ", name, count);
  return words;
}

std::string family_of(std::string_view scene) {
  const auto scenes = scene_names();
  const auto at =
      std::find_if(scenes.begin(), scenes.end(), [&](const SceneName& name) { return name.name == scene; });
  return at == scenes.end() ? "" : std::string(at->family);
}

void add_long(const ExperimentResult& result, Report& report) {
  const std::vector<MethodKind> all_kinds = kinds();
  for (const Outcome& o : result.outcomes) {
    const InsideAccuracy inside = o.inside.value_or(InsideAccuracy{});
    const TouchAccuracy touch = o.touch.value_or(TouchAccuracy{});
    const PairAccuracy pairs = o.pairs.value_or(PairAccuracy{});
    const auto count = [](auto n) { return static_cast<std::int64_t>(n); };
    const auto kind = std::find_if(all_kinds.begin(), all_kinds.end(),
                                   [&](const MethodKind& one) { return one.name == o.method; });
    report.table(long_head).add({o.scene,
                                 family_of(o.scene),
                                 std::string(name_of(o.question)),
                                 o.is_deformed ? "yes" : "no",
                                 o.method,
                                 kind == all_kinds.end() ? o.method : kind->title,
                                 kind == all_kinds.end() ? "" : kind->family,
                                 count(o.fixed_triangles),
                                 count(o.mobile_vertices),
                                 count(o.poses),
                                 o.build_seconds * 1e3,
                                 o.first_step_seconds.value_or(nan) * 1e3,
                                 o.update_seconds.value_or(nan) * 1e3,
                                 o.query.mean * 1e3,
                                 o.query.p50 * 1e3,
                                 o.query.p95 * 1e3,
                                 o.query.spread,
                                 o.cold_seconds > 0 ? o.cold_seconds * 1e3 : nan,
                                 o.ours_seconds > 0 ? o.ours_seconds * 1e3 : nan,
                                 o.ours_seconds > 0 ? o.query.mean / o.ours_seconds : nan,
                                 o.thread_speed_up.value_or(nan),
                                 count(o.bytes),
                                 inside.inside,
                                 inside.false_inside,
                                 inside.false_outside,
                                 inside.depths > 0 ? inside.mean_depth_error_mm() : nan,
                                 inside.depths > 0 ? inside.depth_error_max_mm : nan,
                                 touch.touching,
                                 touch.missed,
                                 touch.invented,
                                 pairs.pairs,
                                 pairs.missed,
                                 pairs.invented,
                                 work_text(o.work)});
  }
}

}  // namespace

void add_tables(const ExperimentResult& result, Report& report) {
  add_long(result, report);
  add_our_details(result, report);
  for (const std::string_view group : groups()) {
    add_costs(result, group, report);
    add_accuracy(result, group, report);
    add_ready(result, group, report);
  }
}

}  // namespace bench
