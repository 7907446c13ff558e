#include "condyle/motion_map.hpp"

#include <tbb/task_arena.h>

#include "goals.hpp"
#include "questions.hpp"
#include "timing.hpp"

namespace bench {
namespace {

using condyle::JointAngle;

const TableHead map_head = {
    "motion_map",
    "Map: flexion -20:120, adduction -40:30, free intervals of internal rotation; all threads",
    {{"scene", "scene"},
     {"step_deg", "step, °"},
     {"points", "points"},
     {"free_points", "free at start"},
     {"threads", "threads"},
     {"wall_s", "s on the wall"},
     {"processor_s", "s on processors"},
     {"points_per_s", "points per s"},
     {"processor_ms_per_point", "processor ms per point"}}};

const TableHead work_head = {"motion_map_work",
                             "Map: what the searches looked at, mean of a point",
                             {{"scene", "scene"},
                              {"node_pairs", "pairs of regions"},
                              {"leaf_pairs", "pairs of leaves"},
                              {"events", "events solved"},
                              {"exact_decisions", "exact decisions"},
                              {"triangle_tests", "triangle tests at the start"}}};

}  // namespace

void ask_motion_map(const Scene& scene, Effort effort, Report& report) {
  const condyle::Joint& joint = scene.joint;
  const double step = effort == Effort::full ? 1 : 10;
  const condyle::motion::RangeOfMotion range(
      joint, {.bearing = {.rule = condyle::motion::BearingRule::count},
              .overlap = {.reference_contact = condyle::motion::ReferenceContact::accept}});
  const condyle::motion::MapGrid grid{.row = {JointAngle::adduction, -40, 30, step},
                                      .column = {JointAngle::flexion, -20, 120, step},
                                      .vary = JointAngle::internal_rotation};
  const Stopwatch watch;
  const condyle::motion::MotionMap map = motion_map(grid, range);
  const double wall = watch.wall_seconds(), processor = watch.processor_seconds();

  std::int64_t free = 0;
  for (const auto& point : map.points) free += point.from_start.free_at_start() ? 1 : 0;
  const auto points = static_cast<double>(map.points.size());
  report.table(map_head).add({joint.name, step, static_cast<std::int64_t>(map.points.size()), free,
                              std::int64_t{tbb::this_task_arena::max_concurrency()}, wall, processor,
                              points / wall, processor * 1e3 / points});
  const auto mean = [&](std::int64_t sum) { return static_cast<double>(sum) / points; };
  if (effort == Effort::full) {
    add_goal({"1° map, 71 x 141 points, all threads", joint.name, Bound::at_most, 15, "s on the wall"}, wall,
             report);
    add_goal({"the same, processors kept busy", joint.name, Bound::at_least, 1.8, "of 2 threads"},
             processor / wall, report);
  }
  const condyle::motion::SearchWork work = map.work();
  report.table(work_head).add({joint.name, mean(work.node_pairs), mean(work.leaf_pairs), mean(work.events),
                               mean(work.exact_decisions), mean(work.triangle_tests)});
}

}  // namespace bench
