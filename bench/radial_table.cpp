#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <vector>

#include "condyle/radial.hpp"
#include "goals.hpp"
#include "questions.hpp"
#include "simd/instruction_set.hpp"
#include "table_floor.hpp"
#include "timing.hpp"

namespace bench {
namespace {

using condyle::Index;
using condyle::Pose;
using condyle::TriMesh;
using condyle::radial::RadialTable;

const TableHead table_building_head{
    "radial_table",
    "Radial table: made and updated; processor time, one thread",
    {{"scene", "scene"},
     {"fixed_triangles", "fixed triangles"},
     {"build_ns_per_triangle", "build, ns per triangle"},
     {"cold_build_ns_per_triangle", "caches empty"},
     {"embree_ns_per_triangle", "Embree's build, ns per triangle"},
     {"floor_ns_per_triangle", "corners read, as much written"},
     {"first_update_ns_per_triangle", "all vertices moved for the first time"},
     {"update_ns_per_triangle", "later, ns per triangle"},
     {"update_over_build", "over build"},
     {"paper_build_ns_per_triangle", "the paper's map: build"},
     {"paper_update_ns_per_triangle", "later update"},
     {"part_us", "1 in 100 moved, µs"},
     {"part_over_build", "over build"},
     {"cold_part_us", "caches empty, µs"},
     {"bytes_per_triangle", "bytes per triangle, table alone"},
     {"bytes_after_updates", "after updates"}}};

const TableHead sets_head{"instruction_sets",
                          "Every vertex at a pose on each instruction set of this processor; one thread",
                          {{"scene", "scene"},
                           {"set", "instruction set"},
                           {"us_per_pose", "µs per pose"},
                           {"over_best", "over the best"}}};

std::vector<Pose> poses_of(const Scene& scene, std::size_t most) {
  std::vector<Pose> poses;
  for (const ScenePose& pose : scene.poses)
    if (poses.size() < most) poses.push_back(pose.X_FM);
  return poses;
}

/// One vertex in a hundred, neighbours by number: a patch of the surface, as a contact deforms it. Where they
/// are and where they go.
struct Patch {
  std::vector<Index> vertices;
  condyle::Points here, there;

  Patch(condyle::PointsView all_here, condyle::PointsView all_there, std::size_t first) {
    const std::size_t count = std::max<std::size_t>(1, all_here.size() / 100);
    for (std::size_t i = first; i < first + count; ++i) {
      vertices.push_back(static_cast<Index>(i));
      here.push_back(all_here[i]), there.push_back(all_there[i]);
    }
  }
};

/// Several, spread over the surface: the same one again and again would be known by heart.
constexpr std::size_t patch_count = 8;

std::vector<Patch> patches(condyle::PointsView here, condyle::PointsView there) {
  std::vector<Patch> out;
  for (std::size_t i = 0; i < patch_count; ++i) out.emplace_back(here, there, i * here.size() / patch_count);
  return out;
}

void move_there_and_back(RadialTable& table, const Patch& patch) {
  table.update(patch.vertices, patch.there);
  table.update(patch.vertices, patch.here);
}

constexpr condyle::radial::RadialOptions papers{.map = condyle::radial::DirectionMapKind::cartesian,
                                                .cells_per_side = {}};

/// With all that penetrations() reads.
RadialTable prepared(const TriMesh& mesh, condyle::radial::RadialOptions options = {}) {
  RadialTable table(mesh, options);
  table.prepare_penetrations();
  return table;
}

void update(RadialTable& table, const condyle::Points& vertices) {
  table.update(vertices);
  table.prepare_penetrations();
}

/// Frames of the deforming variant that are gone through again and again.
constexpr int frames = 4;

double bytes_per_triangle(const RadialTable& table) {
  return static_cast<double>(table.table_size().bytes) / static_cast<double>(table.mesh().triangles.size());
}

void ask_building(const Scene& scene, int rounds, Report& report) {
  const TriMesh& fixed = scene.joint.fixed.mesh;
  const auto embree = method_named("embree_16_robust");
  RadialTable table = prepared(fixed), part_table = prepared(fixed), paper = prepared(fixed, papers);
  const double bytes = bytes_per_triangle(table);
  const std::size_t table_bytes = table.table_size().bytes;
  volatile double kept = 0;
  std::vector<condyle::Points> moved;
  for (int frame = 1; frame <= frames; ++frame) moved.push_back(deformed(fixed.vertices, frame));
  const std::vector<Patch> parts = patches(fixed.vertices, moved[0]);
  std::vector<std::vector<double>> samples;
  std::vector<int> times;
  double cold_build = 0, cold_part = 0;
  tbb::task_arena(1).execute([&] {
    // After one round a table has learnt how far vertices move.
    for (const condyle::Points& vertices : moved) update(table, vertices);
    const Repeated build([&] { prepared(fixed); });
    const Repeated part_update([&] {
      for (const Patch& patch : parts) move_there_and_back(part_table, patch);
    });
    const Repeated floor([&] { kept = write_table_floor(fixed, table_bytes); });
    times = {build.times, part_update.times, floor.times};
    samples = interleaved(rounds, {
                                      build,
                                      part_update,
                                      floor,
                                      [&] {
                                        for (const condyle::Points& vertices : moved) update(table, vertices);
                                      },
                                      [&] {
                                        if (embree) embree->make({fixed, scene.joint.mobile.mesh});
                                      },
                                      [&] {
                                        RadialTable first = prepared(fixed);
                                        update(first, moved[0]);
                                      },
                                      [&] { prepared(fixed); },
                                      [&] { prepared(fixed, papers); },
                                      [&] {
                                        for (const condyle::Points& vertices : moved) update(paper, vertices);
                                      },
                                  });
    cold_build = cold_seconds(rounds, [&] { prepared(fixed); });
    cold_part = cold_seconds(rounds, [&] { move_there_and_back(part_table, parts[patch_count / 2]); }) / 2;
  });
  const auto each = [&](std::size_t way) { return median(samples[way]) / times[way]; };
  const auto per_triangle = [&](double seconds) {
    return seconds * 1e9 / static_cast<double>(fixed.triangles.size());
  };
  const double build = each(0), part_update = each(1) / (2 * patch_count), floor = each(2);
  const double update = median(samples[3]) / frames, embree_build = median(samples[4]);
  const double first_update = median(samples[5]) - median(samples[6]);
  report.table(table_building_head)
      .add({scene.joint.name, static_cast<std::int64_t>(fixed.triangles.size()), per_triangle(build),
            per_triangle(cold_build), embree ? Cell(per_triangle(embree_build)) : Cell("-"),
            per_triangle(floor), per_triangle(first_update), per_triangle(update), update / build,
            per_triangle(median(samples[7])), per_triangle(median(samples[8]) / frames), part_update * 1e6,
            part_update / build, cold_part * 1e6, bytes,
            std::max(bytes_per_triangle(table), bytes_per_triangle(part_table))});
  const std::string& name = scene.joint.name;
  add_goal({"radial table, build", name, Bound::at_most, 60, "ns per triangle"}, per_triangle(build), report);
  if (embree)
    add_goal({"radial table, build over Embree's", name, Bound::at_most, 1, "times"}, build / embree_build,
             report);
  add_goal({"radial table, all vertices moved again, over build", name, Bound::at_most, 0.5, "times"},
           update / build, report);
  add_goal({"radial table, 1 in 100 moved, over build", name, Bound::at_most, 0.05, "times"},
           part_update / build, report);
  add_goal({"radial table, memory", name, Bound::at_most, 150, "bytes per triangle"}, bytes, report);
}

void ask_instruction_sets(const Scene& scene, int rounds, Report& report) {
  const RadialTable table(scene.joint.fixed.mesh);
  const condyle::radial::SortedPoints points(scene.joint.mobile.mesh.vertices());
  const std::vector<Pose> poses = poses_of(scene, 64);
  const std::vector<condyle::simd::InstructionSet> sets = condyle::simd::instruction_sets();
  condyle::radial::Penetrations found;
  std::vector<std::function<void()>> ways;
  for (const condyle::simd::InstructionSet& set : sets)
    ways.emplace_back([&] {
      const condyle::simd::InstructionSetInUse in_use(set);
      for (const Pose& X_FM : poses) table.penetrations(points, X_FM, found);
    });
  std::vector<double> seconds;
  for (const auto& samples : interleaved(rounds, ways)) seconds.push_back(median(samples));
  const double best = *std::min_element(seconds.begin(), seconds.end());
  for (std::size_t i = 0; i < sets.size(); ++i)
    report.table(sets_head).add({scene.joint.name, sets[i].name,
                                 seconds[i] * 1e6 / static_cast<double>(poses.size()), seconds[i] / best});
  const auto goal = [&](std::string_view set, double most) {
    const auto at = std::find_if(sets.begin(), sets.end(), [&](const auto& s) { return s.name == set; });
    if (at != sets.end())
      add_goal({fmt::format("every vertex, {} over the best instruction set", set), scene.joint.name,
                Bound::at_most, most, "times"},
               seconds[static_cast<std::size_t>(at - sets.begin())] / best, report);
  };
  goal("AVX2", 2);
  // The slowest of the older ones: no vectors at all.
  goal("SCALAR", 16);  // as many floats as the widest vectors hold
}

}  // namespace

void ask_radial_table(const Scene& scene, Effort effort, Report& report) {
  const int rounds = effort == Effort::full ? 9 : 1;
  ask_building(scene, rounds, report);
  ask_instruction_sets(scene, rounds, report);
}

}  // namespace bench
