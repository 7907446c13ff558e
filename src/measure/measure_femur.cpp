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
  return kinematics::shaft_line(femur, head.centre, down, begins, begins + longest_shaft);
}

ShaftGeometry geometry_of(const ShaftLine& line, const Vec3& head_centre) {
  const double at = (line.point - head_centre).dot(line.direction);
  return {line.point + (line.first_mm - at) * line.direction,
          line.point + (line.last_mm - at) * line.direction, line.bound_deg};
}

void tell_head(const SphericalPatch& head, FemurMeasures& out) {
  const SphereFit& fit = head.fit;
  out.head_radius = told(fit.sphere.radius);
  out.head_rms = told(fit.rms_residual);
  out.head_largest_residual = told(fit.largest_residual);
  out.head_roundness = told(fit.rms_residual / fit.sphere.radius);
  out.head_coverage = told(head.coverage);
}

void tell_around_neck(const TriMesh& femur, const std::optional<ShaftLine>& shaft, const NeckLine& line,
                      const Sphere& head, const BodyAxes& axes, FemurMeasures& out) {
  const Vec3 up = shaft ? Vec3(-shaft->direction) : axes.superior;
  const auto clock = clock_about(line.direction, up, axes.anterior);
  if (!clock) return;
  out.neck = NeckGeometry{head, line.direction, line.outline, *clock,
                          shaft ? ClockSource::shaft : ClockSource::frame};
  out.around_neck = around_neck(femur, *out.neck);
  tell_alpha(out.around_neck, head.radius, out);
}

void tell_shaft(const TriMesh& femur, const std::optional<ShaftLine>& shaft,
                const std::optional<NeckLine>& neck, const std::string& no_neck, const Sphere& head,
                const FoundParts& parts, FemurMeasures& out) {
  if (!shaft) {
    const std::string why =
        core::formatted("no straight shaft of %.0f mm begins %.0f mm from the head's centre",
                        kinematics::shortest_shaft_mm, shaft_begins * head.radius);
    out.neck_shaft = out.trochanter_height = not_told(why);
    return;
  }
  out.shaft = geometry_of(*shaft, head.centre);
  out.neck_shaft = neck ? told(std::atan2(neck->direction.cross(shaft->direction).norm(),
                                          -neck->direction.dot(shaft->direction)) /
                               degree)
                        : not_told(no_neck);
  const TrochanterFinding trochanter = greater_trochanter(femur, head, *shaft, parts.femur_ends);
  out.trochanter_top = trochanter.top;
  out.trochanter_height = trochanter.top ? told(trochanter.height_mm) : not_told(trochanter.why_none);
}

void tell_version(const TriMesh& femur, const std::optional<ShaftLine>& shaft,
                  const std::optional<NeckLine>& neck, const std::string& no_neck, const Sphere& head,
                  const FoundParts& parts, const BodyAxes& axes, FemurMeasures& out) {
  if (parts.why_no_condyles.empty()) out.condyles = condyle_geometry(femur, head, axes);
  if (!neck) {
    out.version = out.torsion_in_frame = not_told(no_neck);
    return;
  }
  out.version = out.condyles ? told(femoral_version_deg(*out.condyles, head, neck->direction))
                : parts.why_no_condyles.empty() ? not_told("no line touches both condyles from behind")
                                                : not_told(parts.why_no_condyles);
  out.torsion_in_frame =
      told(torsion_deg(neck->direction, shaft ? shaft->direction : Vec3(-axes.superior), axes));
  if (!shaft) out.torsion_in_frame.note = "no shaft: seen along the frame's vertical";
}

}  // namespace

FemurMeasures measure_femur(const TriMesh& femur, const SphericalPatch& head, const FoundParts& parts,
                            const BodyAxes& axes) {
  const Sphere& sphere = head.fit.sphere;
  const NeckFinding found = find_neck(femur, sphere);
  const auto shaft = shaft_below(femur, sphere);
  FemurMeasures out = femur_not_told(found.why_none);
  tell_head(head, out);
  if (found.neck) tell_around_neck(femur, shaft, *found.neck, sphere, axes, out);
  tell_shaft(femur, shaft, found.neck, found.why_none, sphere, parts, out);
  tell_version(femur, shaft, found.neck, found.why_none, sphere, parts, axes, out);
  return out;
}

}  // namespace condyle::measure
