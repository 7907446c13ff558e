#include "measure/measure_femur.hpp"

#include <cmath>
#include <numbers>

#include "core/formatted.hpp"
#include "core/trigonometry.hpp"
#include "kinematics/hip_anatomy.hpp"
#include "measure/degree.hpp"
#include "measure/femoral_version.hpp"
#include "measure/neck_axis.hpp"
#include "measure/neck_hours.hpp"
#include "measure/shaft_axis.hpp"
#include "measure/solid_angle.hpp"
#include "measure/surface_grain.hpp"
#include "measure/trochanter.hpp"

namespace condyle::measure {
namespace {

ShaftGeometry geometry_of(const ShaftAxis& line, const Vec3& head_centre) {
  const double at = (line.point - head_centre).dot(line.direction);
  return {line.point + (line.first_mm - at) * line.direction,
          line.point + (line.last_mm - at) * line.direction, line.bound_deg};
}

/// Share of all directions in which the head's part lies: a third of a triangle for each of its corners. A rough surface has more area
/// than its sphere, and no more directions.
double coverage_of(const TriMesh& femur, const SphereFit& head) {
  std::vector<char> is_head(femur.vertices.size());
  for (const Index v : head.vertices) is_head[v] = 1;
  double sum = 0;
  for (std::size_t t = 0; t < femur.triangles.size(); ++t) {
    const auto [i, j, k] = femur.triangles[t];
    if (const int corners = is_head[i] + is_head[j] + is_head[k]; corners > 0)
      sum += corners * solid_angle(femur, t, head.sphere.centre) / 3;
  }
  return sum / (4 * std::numbers::pi);
}

void set_head(const TriMesh& femur, const SphericalPatch& head, FemurMeasures& out) {
  const SphereFit& fit = head.fit;
  out.head = fit.sphere;
  out.head_radius = measured(fit.sphere.radius);
  out.head_rms = measured(fit.rms_residual);
  out.head_largest_residual = measured(fit.largest_residual);
  out.head_roundness = measured(fit.rms_residual / fit.sphere.radius);
  out.head_coverage = measured(coverage_of(femur, fit));
}

void set_around_neck(const TriMesh& femur, const std::optional<ShaftAxis>& shaft, const NeckLine& line,
                     const SphericalPatch& head, const BoneParts& parts, const BodyAxes& axes,
                     FemurMeasures& out) {
  const Sphere& sphere = head.fit.sphere;
  const Vec3 up = shaft ? Vec3(-shaft->direction) : axes.superior;
  const auto clock = clock_about(line.direction, up, axes.anterior);
  if (!clock) {
    const std::string why = std::string("the neck is parallel to the ") +
                            (shaft ? "shaft" : "frame's superior") + ": it has no 12 o'clock";
    for (Measure* measure : clock_measures(out)) *measure = not_measured(why);
    return;
  }
  out.neck = NeckGeometry{sphere, line.direction, line.outline, *clock,
                          shaft ? ClockSource::shaft : ClockSource::frame};
  out.around_neck = around_neck(femur, *out.neck, parts.femur_ends);
  set_alpha(out.around_neck, sphere.radius, out);
  const std::string grain =
      alpha_grain_note(grain_of(femur, head.fit.vertices, sphere.centre), sphere.radius);
  for (Measure* measure : alpha_measures(out)) add_note(*measure, grain);
  if (!shaft)
    for (Measure* measure : clock_measures(out))
      add_note(*measure, "no shaft: 12 o'clock is the frame's superior");
}

void set_shaft(const TriMesh& femur, const ShaftFinding& found, const std::optional<NeckLine>& neck,
               const std::string& no_neck, const Sphere& head, const BoneParts& parts, FemurMeasures& out) {
  const auto& shaft = found.shaft;
  if (!shaft) {
    out.neck_shaft = out.trochanter_height = not_measured(found.why_none);
    return;
  }
  out.shaft = geometry_of(*shaft, head.centre);
  out.neck_shaft = neck ? measured(core::arctangent(neck->direction.cross(shaft->direction).norm(),
                                                    -neck->direction.dot(shaft->direction)) /
                                   degree)
                        : not_measured(no_neck);
  const TrochanterFinding trochanter = greater_trochanter(femur, head, *shaft, parts.femur_ends);
  out.trochanter_top = trochanter.top;
  out.trochanter_height = trochanter.top ? measured(trochanter.height_mm) : not_measured(trochanter.why_none);
}

void set_version(const TriMesh& femur, const std::optional<ShaftAxis>& shaft,
                 const std::optional<NeckLine>& neck, const std::string& no_neck, const Sphere& head,
                 const BoneParts& parts, const BodyAxes& axes, FemurMeasures& out) {
  if (parts.why_no_condyles.empty()) out.condyles = condyle_geometry(femur, head, axes);
  if (!neck) {
    out.version = out.torsion_in_frame = not_measured(no_neck);
    return;
  }
  out.version = out.condyles ? measured(femoral_version_deg(*out.condyles, head, neck->direction))
                : parts.why_no_condyles.empty() ? not_measured("no line touches both condyles from behind")
                                                : not_measured(parts.why_no_condyles);
  out.torsion_in_frame =
      measured(torsion_deg(neck->direction, shaft ? shaft->direction : Vec3(-axes.superior), axes));
  if (!shaft) add_note(out.torsion_in_frame, "no shaft: seen along the frame's vertical");
}

}  // namespace

FemurMeasures measure_femur(const TriMesh& femur, const SphericalPatch& head, const BoneParts& parts,
                            const BodyAxes& axes) {
  const Sphere& sphere = head.fit.sphere;
  const NeckFinding found = find_neck(femur, sphere, parts.femur_ends);
  const ShaftFinding shaft = find_shaft(femur, sphere, parts.femur_ends);
  FemurMeasures out = femur_not_measured(found.why_none);
  set_head(femur, head, out);
  if (found.neck) set_around_neck(femur, shaft.shaft, *found.neck, head, parts, axes, out);
  set_shaft(femur, shaft, found.neck, found.why_none, sphere, parts, out);
  set_version(femur, shaft.shaft, found.neck, found.why_none, sphere, parts, axes, out);
  return out;
}

}  // namespace condyle::measure
