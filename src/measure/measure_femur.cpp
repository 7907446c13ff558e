#include "measure/measure_femur.hpp"

#include <cmath>
#include <numbers>

#include "core/formatted.hpp"
#include "kinematics/hip_anatomy.hpp"
#include "measure/femoral_version.hpp"
#include "measure/neck_axis.hpp"
#include "measure/neck_hours.hpp"
#include "measure/trochanter.hpp"

namespace condyle::measure {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// The shaft begins below the lesser trochanter, in radii of the head below its centre, and curves beyond this length, mm.
constexpr double shaft_begins = 2.6, longest_shaft = 90;

using kinematics::ShaftLine;

std::optional<ShaftLine> shaft_below(const TriMesh& femur, const Sphere& head) {
  const Vec3 down = (kinematics::area_centroid(femur) - head.centre).normalized();
  const double begins = shaft_begins * head.radius;
  // A triangle that lies that far below has a corner that far away: no other one counts.
  TriMesh away{femur.vertices, {}};
  const auto is_away = [&](Index v) { return (femur.vertices[v] - head.centre).norm() >= begins; };
  for (const Triangle& t : femur.triangles)
    if (is_away(t[0]) || is_away(t[1]) || is_away(t[2])) away.triangles.push_back(t);
  return kinematics::shaft_line(away, head.centre, down, begins, begins + longest_shaft);
}

ShaftGeometry geometry_of(const ShaftLine& line, const Vec3& head_centre) {
  const double at = (line.point - head_centre).dot(line.direction);
  return {line.point + (line.first_mm - at) * line.direction,
          line.point + (line.last_mm - at) * line.direction, line.bound_deg};
}

void set_head(const SphericalPatch& head, FemurMeasures& out) {
  const SphereFit& fit = head.fit;
  out.head_radius = measured(fit.sphere.radius);
  out.head_rms = measured(fit.rms_residual);
  out.head_largest_residual = measured(fit.largest_residual);
  out.head_roundness = measured(fit.rms_residual / fit.sphere.radius);
  out.head_coverage = measured(head.coverage);
}

void set_around_neck(const TriMesh& femur, const std::optional<ShaftLine>& shaft, const NeckLine& line,
                     const Sphere& head, const BodyAxes& axes, FemurMeasures& out) {
  const Vec3 up = shaft ? Vec3(-shaft->direction) : axes.superior;
  const auto clock = clock_about(line.direction, up, axes.anterior);
  if (!clock) return;
  out.neck = NeckGeometry{head, line.direction, line.outline, *clock,
                          shaft ? ClockSource::shaft : ClockSource::frame};
  out.around_neck = around_neck(femur, *out.neck);
  set_alpha(out.around_neck, head.radius, out);
}

void set_shaft(const TriMesh& femur, const std::optional<ShaftLine>& shaft,
               const std::optional<NeckLine>& neck, const std::string& no_neck, const Sphere& head,
               const FoundParts& parts, FemurMeasures& out) {
  if (!shaft) {
    const std::string why =
        core::formatted("no straight shaft of %.0f mm begins %.0f mm from the head's centre",
                        kinematics::shortest_shaft_mm, shaft_begins * head.radius);
    out.neck_shaft = out.trochanter_height = not_measured(why);
    return;
  }
  out.shaft = geometry_of(*shaft, head.centre);
  out.neck_shaft = neck ? measured(std::atan2(neck->direction.cross(shaft->direction).norm(),
                                              -neck->direction.dot(shaft->direction)) /
                                   degree)
                        : not_measured(no_neck);
  const TrochanterFinding trochanter = greater_trochanter(femur, head, *shaft, parts.femur_ends);
  out.trochanter_top = trochanter.top;
  out.trochanter_height = trochanter.top ? measured(trochanter.height_mm) : not_measured(trochanter.why_none);
}

void set_version(const TriMesh& femur, const std::optional<ShaftLine>& shaft,
                 const std::optional<NeckLine>& neck, const std::string& no_neck, const Sphere& head,
                 const FoundParts& parts, const BodyAxes& axes, FemurMeasures& out) {
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
  if (!shaft) out.torsion_in_frame.note = "no shaft: seen along the frame's vertical";
}

}  // namespace

FemurMeasures measure_femur(const TriMesh& femur, const SphericalPatch& head, const FoundParts& parts,
                            const BodyAxes& axes) {
  const Sphere& sphere = head.fit.sphere;
  const NeckFinding found = find_neck(femur, sphere);
  const auto shaft = shaft_below(femur, sphere);
  FemurMeasures out = femur_not_measured(found.why_none);
  set_head(head, out);
  if (found.neck) set_around_neck(femur, shaft, *found.neck, sphere, axes, out);
  set_shaft(femur, shaft, found.neck, found.why_none, sphere, parts, out);
  set_version(femur, shaft, found.neck, found.why_none, sphere, parts, axes, out);
  return out;
}

}  // namespace condyle::measure
