#include "condyle/tangential.hpp"

#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "goals.hpp"
#include "questions.hpp"
#include "timing.hpp"

namespace bench {
namespace {

using condyle::Pose;
using condyle::TriMesh;

/// A whole turn in steps of a degree.
constexpr int poses_per_turn = 360;

const TableHead ring_head{"ring_table",
                          "Ring table about the flexion axis; processor time, one thread",
                          {{"scene", "scene"},
                           {"fixed_triangles", "fixed triangles"},
                           {"mobile_vertices", "mobile vertices"},
                           {"new_axis_ns_per_triangle", "a new axis of a closed mesh, ns per triangle"},
                           {"first_ns_per_triangle", "first table, with the check, ns per triangle"},
                           {"cold_first_ns_per_triangle", "the same, caches empty"},
                           {"bytes_per_triangle", "bytes per triangle, mesh included"},
                           {"query_ns_per_vertex", "a pose, ns per vertex"},
                           {"arcs_ns_per_vertex", "all angles, ns per vertex"},
                           {"arcs_ms", "all angles, ms"},
                           {"embree_turn_ms", "Embree, 360 poses, ms"},
                           {"ratio", "ratio"},
                           {"ratio_with_building", "with building"}}};

std::vector<Pose> about_flexion_axis(int count, int stride) {
  std::vector<Pose> poses;
  for (int degree = 0; degree < count; degree += stride)
    poses.emplace_back(Eigen::AngleAxisd(condyle::Angle::degrees(degree).radians(), arc_axis().direction()));
  return poses;
}

}  // namespace

void ask_ring_table(const Scene& scene, Effort effort, Report& report) {
  const TriMesh &fixed = scene.joint.fixed.mesh, &mobile = scene.joint.mobile.mesh;
  const Bodies bodies{fixed, mobile};
  const auto embree_kind = method_named("embree_16_robust");
  const auto embree = embree_kind ? embree_kind->make(bodies) : nullptr;
  const condyle::Mesh closed(fixed);
  const condyle::tangential::RingTable ring(closed, arc_axis());
  condyle::tangential::TangentialResults hits;
  std::vector<InsideVertex> inside;
  // Every tenth degree stands for ten.
  constexpr int stride = 10;
  const std::vector<Pose> turn = about_flexion_axis(poses_per_turn, stride);

  std::vector<std::vector<double>> samples;
  std::vector<int> times;
  double cold_first = 0;
  tbb::task_arena(1).execute([&] {
    const Repeated new_axis([&] { condyle::tangential::RingTable(closed, arc_axis()); });
    const Repeated first([&] { condyle::tangential::RingTable(fixed, arc_axis()); });
    const Repeated query([&] { ring.query(mobile.vertices.view(), hits); });
    const Repeated arcs([&] { (void)ring.occupied_arcs(mobile.vertices.view()); });
    times = {new_axis.times, first.times, query.times, arcs.times};
    const auto step_embree = [&] {
      if (!embree) return;
      for (const Pose& X_FM : turn) embree->find_inside(X_FM, inside);
    };
    const auto build_embree = [&] {
      if (embree_kind) embree_kind->make(bodies);
    };
    samples = interleaved(effort == Effort::full ? 5 : 1,
                          {new_axis, first, query, arcs, step_embree, build_embree});
    cold_first = cold_seconds(effort == Effort::full ? 5 : 1,
                              [&] { condyle::tangential::RingTable(fixed, arc_axis()); });
  });
  const auto triangles = static_cast<double>(fixed.triangles.size());
  const auto vertices = static_cast<double>(mobile.vertices.size());
  const auto each = [&](std::size_t way) { return median(samples[way]) / times[way]; };
  const double new_axis = each(0), first = each(1), query = each(2), arcs = each(3);
  const double stepping = median(samples[4]) * stride, embree_build = median(samples[5]);
  const double ratio = stepping / arcs, with_building = (stepping + embree_build) / (arcs + first);
  const auto per_triangle = [&](double seconds) { return seconds * 1e9 / triangles; };
  report.table(ring_head).add({scene.joint.name, static_cast<std::int64_t>(fixed.triangles.size()),
                               static_cast<std::int64_t>(mobile.vertices.size()), per_triangle(new_axis),
                               per_triangle(first), per_triangle(cold_first),
                               ring.table_size().bytes_per_triangle, query * 1e9 / vertices,
                               arcs * 1e9 / vertices, arcs * 1e3, embree ? Cell(stepping * 1e3) : Cell("-"),
                               embree ? Cell(ratio) : Cell("-"), embree ? Cell(with_building) : Cell("-")});
  const std::string& name = scene.joint.name;
  add_goal(
      {"ring table, a new axis of a mesh known to be closed", name, Bound::at_most, 30, "ns per triangle"},
      per_triangle(new_axis), report);
  add_goal({"ring table, a mesh's first, with the check that it is closed", name, Bound::at_most, 30,
            "ns per triangle"},
           per_triangle(first), report);
  if (!embree) return;
  add_goal({"all angles of a turn, Embree at each degree", name, Bound::at_least, 500, "times cheaper"},
           ratio, report);
  add_goal({"the same with building", name, Bound::at_least, 60, "times cheaper"}, with_building, report);
}

}  // namespace bench
