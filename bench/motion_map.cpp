#include "condyle/motion_map.hpp"

#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "condyle/contact.hpp"
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

/// A rule of others for a grid of six coordinates, by its published description only: a pose is impossible if 20 of 10,000 sampled vertices
/// are inside the other bone.
constexpr std::size_t sampled_vertices = 10'000, most_inside = 20;

const TableHead sampled_head = {"motion_map_sampled",
                                "Map that translates: x -2:2 mm, flexion 0:90; the exact intervals, and a "
                                "rule at samples of the varied coordinate",
                                {{"scene", "scene"},
                                 {"vary", "varied"},
                                 {"points", "points"},
                                 {"processor_ms_per_point", "processor ms per point"},
                                 {"samples", "samples"},
                                 {"sampled_ms_per_point", "rule, ms per point"},
                                 {"false_free", "contact called possible"},
                                 {"false_contact", "free called impossible"},
                                 {"missed", "free or contact intervals between two samples"}}};

void ask_translations(const Scene& scene, Effort effort, Report& report) {
  using condyle::motion::MapCoordinate;
  condyle::Joint joint = scene.joint;
  joint.kind = condyle::JointKind::free;
  const condyle::motion::RangeOfMotion range(
      joint, {.bearing = {.rule = condyle::motion::BearingRule::count},
              .overlap = {.reference_contact = condyle::motion::ReferenceContact::accept}});
  const condyle::contact::JointContact contact(joint);
  const std::size_t stride = std::max<std::size_t>(1, joint.mobile.mesh.vertices().size() / sampled_vertices);
  for (const MapCoordinate vary :
       {MapCoordinate(JointAngle::internal_rotation), MapCoordinate::translation(1)}) {
    const condyle::motion::MapGrid grid{
        .row = {MapCoordinate::translation(0), -2, 2, effort == Effort::full ? 0.5 : 2},
        .column = {JointAngle::flexion, 0, 90, effort == Effort::full ? 10.0 : 45.0},
        .vary = vary};
    const Stopwatch exact;
    const condyle::motion::MotionMap map = motion_map(grid, range);
    const double exact_s = exact.processor_seconds();
    // Every 5 degrees, or every mm.
    const double half = vary.is_angle() ? 180 : 50, step = vary.is_angle() ? 5 : 1;
    std::int64_t samples = 0, false_free = 0, false_contact = 0, missed = 0;
    condyle::radial::Penetrations inside;
    const Stopwatch rule;
    for (std::size_t i = 0; i < grid.size(); ++i) {
      const condyle::motion::MapPoint point = map.point(i);
      for (double value = -half; value <= half; value += step, ++samples) {
        condyle::JointCoordinates at = grid.start_of(i);
        if (vary.is_angle())
          at.angles = condyle::motion::turned_by(at.angles, vary.angle(), condyle::Angle::degrees(value));
        else
          at.translation_mm[vary.axis()] = value;
        contact.mobile_in_fixed(pose_at(joint.coordinates(), at, joint.translation_frame), inside);
        std::size_t found = 0;
        for (const condyle::Index vertex : inside.point) found += vertex % stride == 0 ? 1 : 0;
        bool is_free = false;
        for (const auto& free : point.intervals)
          is_free |= free.low.value <= value && value <= free.high.value;
        false_free += !is_free && found < most_inside ? 1 : 0;
        false_contact += is_free && found >= most_inside ? 1 : 0;
      }
      std::vector<double> ends{-half};
      for (const auto& free : point.intervals) ends.insert(ends.end(), {free.low.value, free.high.value});
      ends.push_back(half);
      for (std::size_t k = 0; k + 1 < ends.size(); ++k)
        missed += ends[k] < ends[k + 1] &&
                  std::ceil((ends[k] + half) / step) > std::floor((ends[k + 1] + half) / step);
    }
    const auto points = static_cast<double>(grid.size());
    report.table(sampled_head)
        .add({joint.name, std::string(name_of(vary, joint.anatomy)), static_cast<std::int64_t>(grid.size()),
              exact_s * 1e3 / points, samples, rule.processor_seconds() * 1e3 / points, false_free,
              false_contact, missed});
  }
}

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
  ask_translations(scene, effort, report);
}

}  // namespace bench
