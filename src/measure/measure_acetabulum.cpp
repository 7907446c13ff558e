#include "measure/measure_acetabulum.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/formatted.hpp"
#include "core/trigonometry.hpp"
#include "measure/centre_edge.hpp"
#include "measure/degree.hpp"
#include "measure/rim.hpp"
#include "measure/rim_chord.hpp"

namespace condyle::measure {
namespace {

void set_opening(const RimGeometry& rim, const Sphere& head, const BodyAxes& axes, AcetabulumMeasures& out) {
  const double front = rim.normal.dot(axes.anterior), up = rim.normal.dot(axes.superior),
               side = rim.normal.dot(axes.lateral);
  out.inclination = measured(core::arctangent(core::hypotenuse(front, side), -up) / degree);
  out.version = measured(core::arctangent(front, side) / degree);
  out.inclination_radiographic = measured(core::arctangent(side, -up) / degree);
  out.version_radiographic = measured(core::arctangent(front, core::hypotenuse(side, up)) / degree);
  out.rim_radius = measured(rim.radius_mm);
  out.rim_height = measured((rim.centre - head.centre).dot(rim.normal));
}

/// The mean over all hours of the share within a cone of that hour's angle; hours without wall are between their neighbours.
double coverage_of(const std::vector<RimHour>& rim) {
  const std::size_t count = rim.size();
  const auto share = [&](std::size_t i) { return (1 - core::cosine(rim[i].cover_deg * degree)) / 2; };
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    std::size_t before = 0, after = 0;
    while (!rim[(i + count - before) % count].point) ++before;
    while (!rim[(i + after) % count].point) ++after;
    const double a = share((i + count - before) % count), b = share((i + after) % count);
    sum += before == 0 ? a : a + (b - a) * static_cast<double>(before) / static_cast<double>(before + after);
  }
  return sum / static_cast<double>(count);
}

void set_chords(const SocketWall& wall, const std::vector<RimHour>& rim, const Sphere& head,
                const BodyAxes& axes, AcetabulumMeasures& out) {
  const std::array<std::pair<double, Measure*>, 4> heights{
      {{0, &out.version_0mm}, {5, &out.version_5mm}, {10, &out.version_10mm}, {15, &out.version_15mm}}};
  for (const auto& [height, measure] : heights) {
    const ChordFinding found = chord_at(rim, head, axes, height);
    *measure = found.chord ? measured(chord_version_deg(*found.chord, axes)) : not_measured(found.why_none);
    if (!found.chord) continue;
    const std::string front = edge_grain_note(wall, head, found.chord->front);
    add_note(*measure, front.empty() ? edge_grain_note(wall, head, found.chord->back) : front);
    out.chords.push_back(*found.chord);
  }
}

/// The measures of the rim's plane and of its points.
std::vector<Measure*> plane_measures(AcetabulumMeasures& out) {
  return {&out.inclination,          &out.version,      &out.inclination_radiographic,
          &out.version_radiographic, &out.version_0mm,  &out.version_5mm,
          &out.version_10mm,         &out.version_15mm, &out.coverage,
          &out.rim_radius,           &out.rim_height};
}

/// That the rim goes on where the mesh of the hip bone ends; empty if it does not.
std::string cut_rim_note(const SocketWall& wall, const std::vector<RimHour>& rim) {
  const auto missing = std::count_if(rim.begin(), rim.end(), [](const RimHour& hour) { return !hour.point; });
  if (missing == 0 || std::find(wall.ends.begin(), wall.ends.end(), 1) == wall.ends.end()) return {};
  return core::formatted(
      "the hip bone ends in the rim: it is in the mesh over %.0f of 360 degrees",
      360.0 * static_cast<double>(rim_steps - static_cast<std::size_t>(missing)) / rim_steps);
}

void set_edges(const SocketWall& wall, const Sphere& head, const BodyAxes& axes, AcetabulumMeasures& out) {
  const auto set = [&](const Vec3& direction, Measure& measure, std::optional<Vec3>& edge) {
    const auto [found, why_none] = centre_edge(wall, head, axes.superior, direction);
    measure = found ? measured(found->angle_deg) : not_measured(why_none);
    if (!found) return;
    add_note(measure, edge_grain_note(wall, head, found->edge));
    edge = found->edge;
  };
  set(axes.lateral, out.centre_edge_lateral, out.lateral_edge);
  set(axes.anterior, out.centre_edge_anterior, out.anterior_edge);
  set(-axes.anterior, out.centre_edge_posterior, out.posterior_edge);
}

}  // namespace

AcetabulumMeasures measure_acetabulum(const TriMesh& hip_bone, const Sphere& head, const BoneParts& parts,
                                      const BodyAxes& axes) {
  if (!parts.opening) return acetabulum_not_measured(parts.why_no_opening, axes);
  const SocketWall wall = socket_wall(hip_bone, head, parts.hip_bone_ends);
  RimFinding found = find_rim(wall, head, *parts.opening, axes);
  AcetabulumMeasures out = acetabulum_not_measured(found.why_none, axes);
  out.rim = std::move(found.hours);
  set_edges(wall, head, axes, out);
  for (Measure* measure : {&out.centre_edge_lateral, &out.centre_edge_anterior, &out.centre_edge_posterior})
    add_note(*measure, parts.socket_note);
  if (!found.plane) return out;
  set_opening(*found.plane, head, axes, out);
  set_chords(wall, out.rim, head, axes, out);
  out.coverage = measured(coverage_of(out.rim));
  for (Measure* measure : plane_measures(out)) {
    add_note(*measure, parts.socket_note);
    add_note(*measure, cut_rim_note(wall, out.rim));
  }
  out.plane = std::move(found.plane);
  return out;
}

}  // namespace condyle::measure
