#include <cmath>

#include "condyle/error.hpp"
#include "condyle/tangential.hpp"
#include "fuzz/fuzz_input.hpp"
#include "fuzz/one_line.hpp"
#include "fuzz/targets.hpp"
#include "support/brute_force.hpp"
#include "support/test_meshes.hpp"

namespace condyle::test {
namespace {

constexpr std::size_t most_ring_points = 6;
/// Ends of arcs err by this at worst, where a circle only touches the surface.
constexpr double end_error = 1e-7, near_an_end = 10 * end_error;

/// `placed` and `at` are in the axis frame, as the table places them.
std::string fault_of(const tangential::TangentialResults& results, std::size_t i, const TriMesh& placed,
                     const Vec3& at) {
  const BruteWinding truth = winding_number(placed, at);
  if (truth.on_surface != (results.state[i] == PointState::on_surface))
    return "on the surface or not is wrong";
  const double gap = results.angular_gap[i].radians(), arc = results.arc_gap_mm[i];
  if (std::isnan(gap) || std::isnan(arc)) return "a gap that is not a number";
  if (truth.on_surface) return {};
  if ((truth.winding > 0) != (results.state[i] == PointState::inside))
    return "a state that brute force does not find";
  if (results.winding[i] != truth.winding) return "another winding number";
  if ((truth.winding > 0) != (gap < 0)) return "a gap of the wrong sign";
  if (std::isfinite(gap) && std::abs(gap) > two_pi) return "a gap of more than a turn";
  if (std::isfinite(gap) && results.triangle[i] >= placed.triangles.size()) return "a gap to no triangle";
  return {};
}

std::string fault_of_arcs(const tangential::OccupiedArcs& arcs, const tangential::TangentialResults& results,
                          std::size_t i) {
  double last = -1;
  for (const tangential::OccupiedArc& arc : arcs.of(i)) {
    const double begin = arc.begin.radians(), end = arc.end.radians();
    if (!(begin >= 0 && begin < two_pi && end > begin && end <= begin + two_pi)) return "an arc that is none";
    if (begin < last - 2 * end_error) return "arcs that overlap";
    last = end;
  }
  if (results.state[i] == PointState::on_surface || std::abs(results.angular_gap[i].radians()) < near_an_end)
    return {};
  if (arcs.inside_at(i, Angle()) != (results.state[i] == PointState::inside))
    return "arcs that say otherwise than the query";
  return {};
}

std::string fault_of(const tangential::RingTable& table, const Mesh& mesh, const Points& points) {
  const tangential::TangentialResults results = table.query(points);
  const tangential::OccupiedArcs arcs = table.occupied_arcs(points);
  const TriMesh placed = in_axis_frame(table.frame(), mesh);
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::string fault = fault_of(results, i, placed, table.frame().to_axis(points[i]));
    if (fault.empty()) fault = fault_of_arcs(arcs, results, i);
    if (!fault.empty()) return fault + ", of point " + std::to_string(i);
  }
  return {};
}

}  // namespace

std::string fuzz_tangential(std::string_view bytes) {
  FuzzInput input(bytes);
  try {
    const AxisFrame axis = input.axis();
    tangential::RingTableOptions options;
    if (const auto cells = input.below(16); cells > 0)
      options.cells_per_triangle = 0.25 * static_cast<double>(cells);
    const Mesh mesh = input.mesh();
    const Points points = input.points(most_ring_points);
    return fault_of(tangential::RingTable(mesh, axis, options), mesh, points);
  } catch (const MeshError& error) {
    return fault_of_message(error.what());
  } catch (const UsageError& error) {
    return fault_of_message(error.what());
  }
}

}  // namespace condyle::test
