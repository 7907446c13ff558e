#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "condyle/radial.hpp"
#include "method.hpp"
#include "questions.hpp"
#include "radial/exact/triangle_plane.hpp"
#include "timing.hpp"
#include "turned.hpp"

/// How fast "every vertex: inside, through which triangle, how deep" could be answered at best, whatever the
/// method, and what that leaves of the ratios to Embree.

namespace bench {
namespace {

using condyle::Index;
using condyle::Pose;
using condyle::Vec3;

const TableHead limits_head{"inside_limits",
                            "Every vertex at a pose: what no method can do without, mean µs; one thread",
                            {{"scene", "scene"},
                             {"mobile_vertices", "mobile vertices"},
                             {"inside", "inside"},
                             {"turned_us", "all vertices turned"},
                             {"given_us", "answers given, written"},
                             {"condyle_us", "Condyle"},
                             {"over_given", "over given"},
                             {"robust_us", "Embree robust"},
                             {"robust_limit", "over given"},
                             {"culled_us", "Embree culled"},
                             {"culled_limit", "over given"}}};

/// Which vertices are inside at a pose, and the triangles that they leave through: the answer but for its
/// numbers.
struct Reported {
  Pose X_FM;
  std::vector<InsideVertex> inside;
};

std::vector<Reported> all_reported(const Scene& scene, Method& ours) {
  std::vector<Reported> reported;
  for (const ScenePose& pose : scene.poses) {
    reported.push_back({pose.X_FM, {}});
    ours.find_inside(pose.X_FM, reported.back().inside);
  }
  return reported;
}

/// Planes of all triangles, as depths are taken from.
std::vector<Vec3> all_planes(const condyle::TriMesh& mesh) {
  std::vector<Vec3> planes;
  for (const auto& [i, j, k] : mesh.triangles)
    planes.push_back(condyle::radial::scaled_normal(mesh.vertices[i], mesh.vertices[j], mesh.vertices[k]));
  return planes;
}

/// The answer of a method that is given it: each vertex is read and posed, its triangle's plane read, the depth
/// computed, everything written.
void write_reported(const Reported& reported, const std::vector<Vec3>& vertices,
                    const std::vector<Vec3>& planes, std::vector<InsideVertex>& out) {
  out.resize(reported.inside.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const auto [vertex, triangle, depth] = reported.inside[i];
    const double gap =
        condyle::radial::gap_to_plane(condyle::posed(reported.X_FM, vertices[vertex]), planes[triangle]);
    out[i] = {vertex, triangle, std::isnan(gap) ? depth : std::abs(gap)};
  }
}

std::vector<Vec3> as_vectors(condyle::PointsView points) {
  std::vector<Vec3> out;
  for (std::size_t i = 0; i < points.size(); ++i) out.push_back(points[i]);
  return out;
}

}  // namespace

void ask_inside_limits(const Scene& scene, Effort effort, Report& report) {
  const auto robust_kind = method_named("embree_16_robust"), culled_kind = method_named("embree_16_culled");
  const Bodies bodies{scene.joint.fixed.mesh, scene.joint.mobile.mesh};
  const auto ours = method_named("radial")->make(bodies);
  const auto robust = robust_kind ? robust_kind->make(bodies) : nullptr;
  const auto culled = culled_kind ? culled_kind->make(bodies) : nullptr;
  const std::vector<Reported> reported = all_reported(scene, *ours);
  const std::vector<Vec3> vertices = as_vectors(bodies.mobile.vertices), planes = all_planes(bodies.fixed);
  const condyle::radial::SortedPoints sorted(bodies.mobile.vertices);
  std::vector<InsideVertex> out;
  volatile float kept = 0;
  const auto at_all_poses = [&](Method* method) {
    for (const Reported& pose : reported)
      if (method) method->find_inside(pose.X_FM, out);
  };
  // Quick work is repeated several times: its first run finds the caches as others left them.
  constexpr int times = 20;
  std::vector<std::vector<double>> samples;
  tbb::task_arena(1).execute([&] {
    samples =
        interleaved(effort == Effort::full ? 5 : 1, {
                                                        [&] {
                                                          for (int i = 0; i < times; ++i)
                                                            for (const Reported& pose : reported)
                                                              kept = greatest_turned(sorted, pose.X_FM);
                                                        },
                                                        [&] {
                                                          for (int i = 0; i < times; ++i)
                                                            for (const Reported& pose : reported)
                                                              write_reported(pose, vertices, planes, out);
                                                        },
                                                        [&] {
                                                          for (int i = 0; i < times; ++i)
                                                            at_all_poses(ours.get());
                                                        },
                                                        [&] { at_all_poses(robust.get()); },
                                                        [&] { at_all_poses(culled.get()); },
                                                    });
  });
  std::size_t inside = 0;
  for (const Reported& pose : reported) inside += pose.inside.size();
  const auto us = [&](std::size_t way, int repeats) {
    return median(samples[way]) * 1e6 / repeats / static_cast<double>(reported.size());
  };
  const double turned = us(0, times), written = us(1, times), ours_us = us(2, times);
  const double robust_us = us(3, 1), culled_us = us(4, 1);
  const auto measured = [](const auto& method, double value) { return method ? Cell(value) : Cell("-"); };
  report.table(limits_head)
      .add({scene.joint.name, static_cast<std::int64_t>(vertices.size()),
            static_cast<double>(inside) / static_cast<double>(reported.size()), turned, written, ours_us,
            ours_us / written, measured(robust, robust_us), measured(robust, robust_us / written),
            measured(culled, culled_us), measured(culled, culled_us / written)});
}

}  // namespace bench
