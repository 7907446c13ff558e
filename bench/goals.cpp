#include "goals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace bench {
namespace {

const TableHead goals_head{"goals",
                           "Goals and what this run measured; one thread unless said",
                           {{"what", "what"},
                            {"scene", "scene"},
                            {"goal", "goal"},
                            {"measured", "measured"},
                            {"unit", ""},
                            {"is_met", "met"}}};

const Outcome* find(const ExperimentResult& result, Question question, std::string_view scene,
                    std::string_view method) {
  const auto at = std::find_if(result.outcomes.begin(), result.outcomes.end(), [&](const Outcome& o) {
    return o.question == question && !o.is_deformed && o.scene == scene && o.method == method;
  });
  return at == result.outcomes.end() ? nullptr : &*at;
}

/// Times that a peer takes what Condyle takes.
struct RatioGoal {
  std::string_view scene;
  double value;
};

void add_ratios(const ExperimentResult& result, const std::string& what, std::string_view method,
                std::initializer_list<RatioGoal> goals, Report& report) {
  for (const RatioGoal& goal : goals) {
    const Outcome* outcome = find(result, Question::inside, goal.scene, method);
    if (outcome && outcome->ours_seconds > 0)
      add_goal({what, std::string(goal.scene), Bound::at_least, goal.value, "times faster"},
               outcome->query.mean / outcome->ours_seconds, report);
  }
}

}  // namespace

void add_goal(const Goal& goal, double measured, Report& report) {
  const bool is_met = goal.bound == Bound::at_least ? measured >= goal.value : measured <= goal.value;
  report.table(goals_head)
      .add({goal.what, goal.scene,
            fmt::format("{} {}", goal.bound == Bound::at_least ? "at least" : "at most", text(goal.value, 4)),
            measured, goal.unit, is_met ? "yes" : "no"});
}

void add_goals(const ExperimentResult& result, Report& report) {
  add_ratios(result, "every vertex, Embree robust, 16 wide", "embree_16_robust",
             {{"libhip_1", 40},
              {"libhip_2", 60},
              {"libhip_3", 80},
              {"libhip_4", 70},
              {"ball_0.1mm_1", 17},
              {"ball_0.1mm_4", 17},
              {"libhip_cartilage_gap", 17},
              {"libhip_cartilage_nogap", 17},
              {"sample_8", 17}},
             report);
  add_ratios(result, "every vertex, Embree robust, sorted and culled", "embree_16_culled",
             {{"libhip_1", 20},
              {"libhip_2", 30},
              {"libhip_3", 45},
              {"libhip_4", 40},
              {"ball_0.1mm_1", 12},
              {"ball_0.1mm_4", 12},
              {"libhip_cartilage_gap", 12},
              {"libhip_cartilage_nogap", 12},
              {"sample_8", 12}},
             report);
  for (const std::string_view scene : {"libhip_1", "libhip_2", "libhip_3", "libhip_4", "sample_4"}) {
    if (const Outcome* o = find(result, Question::touch, scene, "fcl_obbrss")) {
      if (o->free_ratio > 0)
        add_goal({"do they touch, free poses, FCL OBBRSS", std::string(scene), Bound::at_least, 10,
                  "times faster"},
                 o->free_ratio, report);
      if (o->touching_ratio > 0)
        add_goal({"do they touch, touching poses, FCL OBBRSS", std::string(scene), Bound::at_least, 2,
                  "times faster"},
                 o->touching_ratio, report);
    }
    if (const Outcome* o = find(result, Question::pairs, scene, "fcl_obbrss"))
      if (o->ours_seconds > 0)
        add_goal({"all pairs, FCL OBBRSS", std::string(scene), Bound::at_least, 3, "times faster"},
                 o->query.mean / o->ours_seconds, report);
  }
  for (const std::string_view scene : {"libhip_3", "libhip_4"})
    if (const Outcome* o = find(result, Question::inside, scene, "radial"))
      if (o->thread_speed_up)
        add_goal({"every vertex, pose list, all threads over one", std::string(scene), Bound::at_least, 1.8,
                  "times"},
                 *o->thread_speed_up, report);
}

}  // namespace bench
