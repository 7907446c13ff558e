#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <vector>

#include "condyle/core/instruction_set.hpp"
#include "condyle/radial/radial_table.hpp"
#include "condyle/radial/sorted_points.hpp"
#include "goals.hpp"
#include "questions.hpp"
#include "timing.hpp"

namespace bench {
namespace {

using condyle::Index;
using condyle::Pose;
using condyle::RadialTable;
using condyle::TriMesh;

const TableHead building_head{"radial_table",
                              "Radial table: made and updated; processor time, one thread",
                              {{"scene", "scene"},
                               {"fixed_triangles", "fixed triangles"},
                               {"build_ns_per_triangle", "build, ns per triangle"},
                               {"embree_ns_per_triangle", "Embree's build, ns per triangle"},
                               {"update_ns_per_triangle", "all vertices moved, ns per triangle"},
                               {"update_over_build", "over build"},
                               {"part_us", "1 in 100 moved, µs"},
                               {"part_over_build", "over build"},
                               {"bytes_per_triangle", "bytes per triangle, table alone"}}};

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

/// Neighbours by number: a patch of the surface, as a contact deforms it.
std::vector<Index> one_in_a_hundred(std::size_t vertices) {
  std::vector<Index> moved(std::max<std::size_t>(1, vertices / 100));
  for (std::size_t i = 0; i < moved.size(); ++i) moved[i] = static_cast<Index>(vertices / 3 + i);
  return moved;
}

condyle::Points at(condyle::PointsView points, const std::vector<Index>& chosen) {
  condyle::Points out;
  for (const Index i : chosen) out.push_back(points[i]);
  return out;
}

void ask_building(const Scene& scene, int rounds, Report& report) {
  const TriMesh& fixed = scene.joint.fixed.mesh;
  const auto embree = method_named("embree_16_robust");
  RadialTable table(fixed), part_table(fixed);
  const condyle::Points moved = deformed(fixed.vertices, 1);
  const std::vector<Index> part = one_in_a_hundred(fixed.vertices.size());
  const condyle::Points part_moved = at(moved, part), part_back = at(fixed.vertices, part);
  std::vector<std::vector<double>> samples;
  tbb::task_arena(1).execute([&] {
    samples = interleaved(rounds, {
                                      [&] { RadialTable{fixed}; },
                                      [&] {
                                        if (embree) embree->make({fixed, scene.joint.mobile.mesh});
                                      },
                                      [&] { table.update(moved); },
                                      [&] {
                                        part_table.update(part, part_moved);
                                        part_table.update(part, part_back);
                                      },
                                  });
  });
  const auto triangles = static_cast<double>(fixed.triangles.size());
  const double build = median(samples[0]), update = median(samples[2]), part_update = median(samples[3]) / 2;
  const double embree_build = median(samples[1]);
  const double bytes = static_cast<double>(RadialTable(fixed).table_size().bytes) / triangles;
  report.table(building_head)
      .add({scene.joint.name, static_cast<std::int64_t>(fixed.triangles.size()), build * 1e9 / triangles,
            embree ? Cell(embree_build * 1e9 / triangles) : Cell("-"), update * 1e9 / triangles,
            update / build, part_update * 1e6, part_update / build, bytes});
  const std::string& name = scene.joint.name;
  add_goal({"radial table, build", name, Bound::at_most, 60, "ns per triangle"}, build * 1e9 / triangles,
           report);
  if (embree)
    add_goal({"radial table, build over Embree's", name, Bound::at_most, 1, "times"}, build / embree_build,
             report);
  add_goal({"radial table, all vertices moved, over build", name, Bound::at_most, 0.5, "times"},
           update / build, report);
  add_goal({"radial table, 1 in 100 moved, over build", name, Bound::at_most, 0.05, "times"},
           part_update / build, report);
  add_goal({"radial table, memory", name, Bound::at_most, 150, "bytes per triangle"}, bytes, report);
}

void ask_instruction_sets(const Scene& scene, int rounds, Report& report) {
  const RadialTable table(scene.joint.fixed.mesh);
  const condyle::SortedPoints points(scene.joint.mobile.mesh.vertices);
  const std::vector<Pose> poses = poses_of(scene, 64);
  const std::vector<condyle::InstructionSet> sets = condyle::instruction_sets();
  condyle::Penetrations found;
  std::vector<std::function<void()>> ways;
  for (const condyle::InstructionSet& set : sets)
    ways.emplace_back([&] {
      const condyle::InstructionSetInUse in_use(set);
      for (const Pose& X_FM : poses) table.penetrations(points, X_FM, found);
    });
  std::vector<double> seconds;
  for (const auto& samples : interleaved(rounds, ways)) seconds.push_back(median(samples));
  const double best = *std::min_element(seconds.begin(), seconds.end());
  for (std::size_t i = 0; i < sets.size(); ++i)
    report.table(sets_head).add({scene.joint.name, sets[i].name,
                                 seconds[i] * 1e6 / static_cast<double>(poses.size()), seconds[i] / best});
}

}  // namespace

void ask_radial_table(const Scene& scene, Effort effort, Report& report) {
  const int rounds = effort == Effort::full ? 9 : 1;
  ask_building(scene, rounds, report);
  ask_instruction_sets(scene, rounds, report);
}

}  // namespace bench
