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

/// How many times as long as Condyle Embree is to take to find which vertices are inside, with a ray
/// for every vertex and with those culled that cannot be inside.
struct InsideGoal {
  std::string_view scene;
  double robust, culled;
};
constexpr std::array<InsideGoal, 9> inside_goals = {{{"libhip_1", 40, 20},
                                                     {"libhip_2", 60, 30},
                                                     {"libhip_3", 80, 45},
                                                     {"libhip_4", 70, 40},
                                                     {"ball_0.1mm_1", 17, 12},
                                                     {"ball_0.1mm_4", 17, 12},
                                                     {"libhip_cartilage_gap", 17, 12},
                                                     {"libhip_cartilage_nogap", 17, 12},
                                                     {"sample_8", 17, 12}}};
constexpr std::string_view robust = "embree_16_robust", culled = "embree_16_culled";

void add_inside_goal(const ExperimentResult& result, const std::string& what, std::string_view method,
                     std::string_view scene, double value, Report& report) {
  const Outcome* outcome = find(result, Question::inside, scene, method);
  if (outcome && outcome->ours_seconds > 0)
    add_goal({what, std::string(scene), Bound::at_least, value, "times faster"},
             outcome->query.mean / outcome->ours_seconds, report);
}

}  // namespace

void add_goal(const Goal& goal, double measured, Report& report) {
  const bool is_met = goal.bound == Bound::at_least ? measured >= goal.value : measured <= goal.value;
  report.table(goals_head)
      .add({goal.what, goal.scene,
            fmt::format("{} {}", goal.bound == Bound::at_least ? "at least" : "at most", text(goal.value, 4)),
            measured, goal.unit, is_met ? "yes" : "no"});
}

bool has_goal_at_all_poses(Question question, std::string_view scene, std::string_view method) {
  return question == Question::inside && (method == robust || method == culled) &&
         std::any_of(inside_goals.begin(), inside_goals.end(),
                     [&](const InsideGoal& goal) { return goal.scene == scene; });
}

void add_goals(const ExperimentResult& result, Report& report) {
  for (const InsideGoal& goal : inside_goals)
    add_inside_goal(result, "every vertex, Embree robust, 16 wide", robust, goal.scene, goal.robust, report);
  for (const InsideGoal& goal : inside_goals)
    add_inside_goal(result, "every vertex, Embree robust, sorted and culled", culled, goal.scene, goal.culled,
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
