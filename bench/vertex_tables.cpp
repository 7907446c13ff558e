#include <tbb/global_control.h>

#include <array>
#include <vector>

#include "condyle/contact/triangle_pairs.hpp"
#include "condyle/radial/radial_table.hpp"
#include "condyle/tangential/ring_table.hpp"
#include "questions.hpp"
#include "timing.hpp"

namespace bench {
namespace {

using condyle::TriMesh;

const TableHead radial_head = {"radial_table",
                               "Radial table; processor time, one thread, mean of six poses",
                               {{"scene", "scene"},
                                {"fixed_triangles", "fixed triangles"},
                                {"mobile_vertices", "mobile vertices"},
                                {"build_ns_per_triangle", "build, ns per triangle"},
                                {"table_bytes_per_triangle", "bytes per triangle, table alone"},
                                {"states_ns_per_vertex", "states, ns per vertex"},
                                {"query_ns_per_vertex", "all answers, ns per vertex"},
                                {"pairs_ms", "pairs, ms a pose"}}};

const TableHead ring_head = {
    "ring_table",
    "Ring table about the flexion axis; processor time, one thread, mean of six poses",
    {{"scene", "scene"},
     {"fixed_triangles", "fixed triangles"},
     {"mobile_vertices", "mobile vertices"},
     {"build_ns_per_triangle", "build, ns per triangle"},
     {"bytes_per_triangle", "bytes per triangle, mesh included"},
     {"query_ns_per_vertex", "all answers, ns per vertex"},
     {"arcs_ns_per_vertex", "occupied arcs, ns per vertex"}}};

constexpr condyle::JointAngles angles(double flexion, double adduction, double internal_rotation) {
  return {condyle::Angle::degrees(flexion), condyle::Angle::degrees(adduction),
          condyle::Angle::degrees(internal_rotation)};
}

/// Neutral, free, grazing and deep ones of a usual hip.
constexpr std::array<condyle::JointAngles, 6> query_poses = {
    angles(0, 0, 0),     angles(90, 0, 0),    angles(140, 0, 0),
    angles(110, 15, 35), angles(-25, 0, -50), angles(0, -65, 0),
};

}  // namespace

void ask_vertex_tables(const condyle::Joint& joint, Effort effort, Report& report) {
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const TriMesh& fixed = joint.fixed.mesh;
  std::vector<TriMesh> posed_mobile;
  for (const condyle::JointAngles& angles : query_poses)
    posed_mobile.push_back(posed(condyle::pose_at(joint.side, angles), joint.mobile.mesh));

  const condyle::AxisFrame axis({0, 0, 0}, axis_of(condyle::JointAngle::flexion, joint.side, {}));
  const condyle::RadialTable radial(fixed);
  const condyle::RingTable ring(fixed, axis);
  std::vector<condyle::PointState> states;
  condyle::RadialHits radial_hits;
  condyle::TangentialHits ring_hits;
  const auto at_every_pose = [&](const auto& ask) {
    return [&, ask] {
      for (const TriMesh& mobile : posed_mobile) ask(mobile);
    };
  };

  const int rounds = effort == Effort::full ? 5 : 1;
  const auto samples = interleaved(
      rounds, {
                  [&] { condyle::RadialTable{fixed}; },
                  at_every_pose([&](const TriMesh& m) { radial.query_states(m.vertices.view(), states); }),
                  at_every_pose([&](const TriMesh& m) { radial.query(m.vertices.view(), radial_hits); }),
                  at_every_pose([&](const TriMesh& m) { intersecting_pairs(radial, m); }),
                  [&] { condyle::RingTable(fixed, axis); },
                  at_every_pose([&](const TriMesh& m) { ring.query(m.vertices.view(), ring_hits); }),
                  at_every_pose([&](const TriMesh& m) { ring.occupied_arcs(m.vertices.view()); }),
              });

  const auto triangles = static_cast<double>(fixed.triangles.size());
  const auto vertices = static_cast<double>(joint.mobile.mesh.vertices.size());
  const auto poses = static_cast<double>(posed_mobile.size());
  const auto per_triangle = [&](std::size_t i) { return median(samples[i]) * 1e9 / triangles; };
  const auto per_vertex = [&](std::size_t i) { return median(samples[i]) * 1e9 / (vertices * poses); };
  const auto counts = [&](const TableHead& head, std::vector<Cell> measured) {
    std::vector<Cell> row = {joint.name, static_cast<std::int64_t>(fixed.triangles.size()),
                             static_cast<std::int64_t>(joint.mobile.mesh.vertices.size())};
    row.insert(row.end(), measured.begin(), measured.end());
    report.table(head).add(std::move(row));
  };
  counts(radial_head, {per_triangle(0), static_cast<double>(radial.table_size().bytes) / triangles,
                       per_vertex(1), per_vertex(2), median(samples[3]) * 1e3 / poses});
  counts(ring_head, {per_triangle(4), ring.table_size().bytes_per_triangle, per_vertex(5), per_vertex(6)});
}

}  // namespace bench
