#include <algorithm>
#include <cmath>

#include "condyle/error.hpp"
#include "condyle/radial.hpp"
#include "fuzz/fuzz_input.hpp"
#include "fuzz/one_line.hpp"
#include "fuzz/targets.hpp"
#include "support/brute_force.hpp"

namespace condyle::test {
namespace {

constexpr std::size_t most_points = 8;

/// One answer of the plain query.
std::string fault_of(const radial::RadialResults& results, std::size_t i, const TriMesh& mesh,
                     const Vec3& point) {
  const BruteWinding truth = winding_number(mesh, point);
  const PointState expected = truth.on_surface    ? PointState::on_surface
                              : truth.winding > 0 ? PointState::inside
                                                  : PointState::outside;
  if (results.state[i] != expected) return "a state that brute force does not find";
  if (!truth.on_surface && results.winding[i] != truth.winding) return "another winding number";
  const double gap = results.radial_gap_mm[i];
  if (std::isnan(gap)) return "a gap that is not a number";
  if ((expected == PointState::inside && gap > 0) || (expected == PointState::outside && gap < 0))
    return "a gap of the wrong sign";
  const Index triangle = results.triangle[i];
  if (std::isfinite(gap) && triangle >= mesh.triangles.size()) return "a gap to no triangle";
  if (!(results.ray_to_normal[i] >= Angle() && results.ray_to_normal[i] <= Angle::degrees(90.0001)))
    return "an angle that is none";
  return {};
}

/// The fast query of the points that are not outside, against the plain one.
std::string fault_of(const radial::Penetrations& found, const radial::RadialResults& results) {
  const auto not_outside = [](PointState state) { return state != PointState::outside; };
  if (found.size() !=
      static_cast<std::size_t>(std::count_if(results.state.begin(), results.state.end(), not_outside)))
    return "penetrations: another number of points";
  for (std::size_t k = 0; k < found.size(); ++k) {
    const Index i = found.point[k];
    if (found.state[k] != results.state[i] || found.winding[k] != results.winding[i] ||
        found.triangle[k] != results.triangle[i] || found.depth_mm[k] != std::abs(results.radial_gap_mm[i]))
      return "penetrations: another answer";
  }
  return {};
}

std::string fault_of(const radial::RadialTable& table, const Points& points) {
  const radial::RadialResults results = table.query(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::string fault = fault_of(results, i, table.mesh(), points[i]);
    if (!fault.empty()) return fault + ", of point " + std::to_string(i);
  }
  radial::Penetrations found;
  table.penetrations(radial::SortedPoints(points), Pose::Identity(), found);
  return fault_of(found, results);
}

}  // namespace

std::string fuzz_radial(std::string_view bytes) {
  FuzzInput input(bytes);
  radial::RadialOptions options;
  if (input.below(4) == 0) options.map = radial::DirectionMapKind::cartesian;
  if (const auto cells = input.below(24); cells > 0) options.cells_per_side = static_cast<int>(cells);
  const TriMesh mesh = input.mesh();
  const Points points = input.points(most_points);
  try {
    const radial::RadialTable table(mesh, options);
    if (table.is_closed() && winding_number(mesh, Vec3::Zero()).on_surface)
      return "a centre on the surface is taken";
    return fault_of(table, points);
  } catch (const MeshError& error) {
    return fault_of_message(error.what());
  } catch (const UsageError& error) {
    return fault_of_message(error.what());
  }
}

}  // namespace condyle::test
