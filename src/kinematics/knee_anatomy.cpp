#include "kinematics/knee_anatomy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "condyle/error.hpp"
#include "core/formatted.hpp"
#include "core/trigonometry.hpp"
#include "kinematics/corners.hpp"
#include "kinematics/facing_part.hpp"
#include "kinematics/hip_anatomy.hpp"
#include "kinematics/joint_cylinder.hpp"
#include "kinematics/surface_points.hpp"

namespace condyle::kinematics {
namespace {

using core::formatted;

/// The shaft begins beyond the flare of the condyles; in radii of their cylinder.
constexpr double tibial_shaft_begins = 2.5;
/// Epicondyles and trochlea lie within this distance of the axis, radii.
constexpr double near_axis = 2.6;

/// Front: in the two femora measured the shaft runs 1.2 radii in front of the axis (needs half a radius), and the condyles
/// stand clear of what is between them by 0.6 radii more behind than in front (needs 0.3).
constexpr double least_shaft_ahead = 0.5, least_notch = 0.3;
/// Region between the condyles: this share of their length, in its middle.
constexpr double middle_share = 0.1;

/// A femur this long, in radii, may have its head; which is so large, and so complete.
constexpr double whole_femur_reach = 10, smallest_hip_head = 0.85, largest_hip_head = 1.8,
                 least_hip_head_coverage = 0.35;
/// The head is found around the far end within this distance, radii, and stands so far to the medial side of the shaft.
constexpr double hip_head_reach = 4.5, least_hip_head_offset = 0.8;

/// Side of a femur without a head: its shaft leans outwards against the condyles' axis (81 degrees to the joint line on the
/// lateral side, Paley 2002), and the lateral side of the trochlea stands farther forwards. Both are needed. Of the two
/// femora measured one has 4.1 degrees and 0.18 radii, the other, with a head, 5.0 and 0.04.
constexpr double least_lean_deg = 3, least_ridge = 0.1;

/// A femoral head is half of a sphere or more, of so many radii of a cylinder through it; condyles are less.
constexpr double least_stray_head_coverage = 0.5, smallest_stray_head = 0.8, largest_stray_head = 1.25;

/// Bounds of where the mobile body's centroid lies below the condyles: hyperextension and a sloping plateau, and the deepest squat.
constexpr double most_in_front_deg = 30, most_behind_deg = 165;

constexpr double degrees_per_radian = 180 / std::numbers::pi;

struct Epicondyle {
  Vec3 at;
  double height;
};

Epicondyles find_epicondyles(const TriMesh& femur, const Cylinder& axis) {
  constexpr double none = std::numeric_limits<double>::infinity();
  Epicondyle first{Vec3::Zero(), none}, last{Vec3::Zero(), -none};
  for_each_corner(femur, [&](const Vec3& p) {
    const Vec3 q = p - axis.point;
    const double height = q.dot(axis.direction);
    if ((q - height * axis.direction).norm() > near_axis * axis.radius) return;
    if (height < first.height) first = {p, height};
    if (height > last.height) last = {p, height};
  });
  const double cosine = (last.at - first.at).normalized().dot(axis.direction);
  return {first.at, last.at, core::arccosine(std::clamp(cosine, -1.0, 1.0)) * degrees_per_radian};
}

/// How far the surface near the axis reaches towards `ahead`, in the two parts of a femur on either side of the notch and
/// between them; -inf where there is nothing.
struct ReachOfBone {
  double first, between, last;
};

ReachOfBone reach_of(const TriMesh& femur, const Condyles& condyles, const Vec3& ahead, const Vec3& up) {
  constexpr double none = -std::numeric_limits<double>::infinity();
  const Cylinder& axis = condyles.fit.cylinder;
  ReachOfBone reach{none, none, none};
  for_each_corner(femur, [&](const Vec3& p) {
    const Vec3 q = p - axis.point;
    const double share = q.dot(axis.direction) / condyles.length_mm;
    if (std::abs(share) > 0.6 || std::abs(q.dot(up)) > 2 * axis.radius) return;
    double& part = std::abs(share) <= middle_share ? reach.between : share < 0 ? reach.first : reach.last;
    part = std::max(part, q.dot(ahead));
  });
  return reach;
}

/// By how much both condyles stand clear of what is between them, radii; empty if nothing is.
std::optional<double> clear_of_notch(const ReachOfBone& reach, double radius) {
  if (!std::isfinite(reach.between)) return std::nullopt;
  return (std::min(reach.first, reach.last) - reach.between) / radius;
}

/// The spherical head at the far end of a femur.
std::optional<SphericalPatch> find_head(const TriMesh& femur, const Cylinder& axis, const ShaftLine& shaft) {
  if (shaft.reach_mm < whole_femur_reach * axis.radius) return std::nullopt;
  const Vec3 end = axis.point + shaft.reach_mm * shaft.direction;
  try {
    SphericalPatch head =
        find_sphere_on(femur, {.smallest_radius = std::max(10.0, smallest_hip_head * axis.radius),
                               .largest_radius = largest_hip_head * axis.radius,
                               .within = Sphere{end, hip_head_reach * axis.radius}});
    if (head.coverage < least_hip_head_coverage) return std::nullopt;
    return head;
  } catch (const MeshError&) {
    return std::nullopt;
  }
}

/// A femoral head and a trochanter may share a cylinder too: where bones lie in unrelated frames, any part of a femur may be what
/// faces the other body. Empty if these are condyles.
std::string why_no_condyles_here(const TriMesh& femur, const Condyles& found) {
  const Cylinder& axis = found.fit.cylinder;
  const double reach = found.length_mm / 2 + largest_stray_head * axis.radius;
  try {
    const SphericalPatch sphere = find_sphere_on(femur, {.smallest_radius = smallest_stray_head * axis.radius,
                                                         .largest_radius = largest_stray_head * axis.radius,
                                                         .within = Sphere{axis.point, reach}});
    if (sphere.coverage < least_stray_head_coverage) return {};
    return formatted(
        "the part facing the other body is a head, %.0f %% of a sphere of radius %.1f mm, and no condyles: "
        "do both meshes lie in one frame?",
        100 * sphere.coverage, sphere.fit.sphere.radius);
  } catch (const MeshError&) {
    return {};
  }
}

/// Front from two pieces of evidence that must agree.
void find_axes(const TriMesh& femur, KneeAnatomy& knee) {
  const Cylinder& axis = knee.condyles->fit.cylinder;
  const ShaftLine& shaft = *knee.shaft;
  const Vec3 up_shaft = square_to(axis.direction, shaft.direction);
  // Front or back: the line at the level of the axis decides, and the sense of the axis does not.
  const Vec3 sagittal = axis.direction.cross(up_shaft);
  const Vec3 to_shaft = shaft.point - axis.point;
  const Vec3 at_axis = to_shaft - to_shaft.dot(up_shaft) / shaft.direction.dot(up_shaft) * shaft.direction;
  const double offset = at_axis.dot(sagittal) / axis.radius;
  const Vec3 ahead = offset < 0 ? Vec3(-sagittal) : sagittal;
  const auto behind = clear_of_notch(reach_of(femur, *knee.condyles, -ahead, up_shaft), axis.radius);
  const auto in_front = clear_of_notch(reach_of(femur, *knee.condyles, ahead, up_shaft), axis.radius);
  knee.evidence.push_back(
      formatted("front: the shaft runs %.2f radii of the condyles in front of their axis (needs %.1f)",
                std::abs(offset), least_shaft_ahead));
  if (!behind || !in_front) {
    knee.why_no_axes = "nothing joins the condyles, so that front and back look alike";
    return;
  }
  knee.evidence.push_back(
      formatted("front: the condyles stand clear of what is between them by %.2f radii more behind than in "
                "front (needs %.1f)",
                *behind - *in_front, least_notch));
  if (std::abs(offset) < least_shaft_ahead || *behind - *in_front < least_notch) {
    knee.why_no_axes = "shaft and condyles do not agree on front and back";
    return;
  }
  const Vec3 z = axis.direction.dot(ahead.cross(up_shaft)) < 0 ? Vec3(-axis.direction) : axis.direction;
  const Vec3 up = knee.head ? square_to(axis.direction, knee.head->fit.sphere.centre - axis.point) : up_shaft;
  knee.axes = ShownAxes{up.cross(z), up};
}

void find_side(const TriMesh& femur, KneeAnatomy& knee) {
  const Cylinder& axis = knee.condyles->fit.cylinder;
  const ShaftLine& shaft = *knee.shaft;
  const Vec3 right = knee.axes->right();
  const auto side_of = [](double to_right) { return to_right > 0 ? Side::right : Side::left; };
  const auto word = [&](double to_right) { return to_right > 0 ? "right" : "left"; };

  const double lean = core::arctangent(shaft.direction.dot(right), shaft.direction.dot(knee.axes->superior)) *
                      degrees_per_radian;
  knee.evidence.push_back(
      formatted("side: upwards the shaft leans %.1f degrees to the %s against the condyles' axis, as of a %s "
                "knee (needs %.0f)",
                std::abs(lean), word(lean), word(lean), least_lean_deg));
  const ReachOfBone front = reach_of(femur, *knee.condyles, knee.axes->anterior, knee.axes->superior);
  const double ridge =
      (axis.direction.dot(right) > 0 ? front.last - front.first : front.first - front.last) / axis.radius;
  knee.evidence.push_back(
      formatted("side: the trochlea's %s side stands %.2f radii of the condyles farther forwards, as of a %s "
                "knee (needs %.1f)",
                word(ridge), std::abs(ridge), word(ridge), least_ridge));
  const bool leans = std::abs(lean) >= least_lean_deg, has_ridge = std::abs(ridge) >= least_ridge;
  if (knee.head) {
    const Vec3 to_head = knee.head->fit.sphere.centre - shaft.point;
    const double offset =
        -(to_head - to_head.dot(shaft.direction) * shaft.direction).dot(right) / axis.radius;
    knee.evidence.push_back(
        formatted("side: the femur's head lies %.1f radii of the condyles to the %s of the shaft, as of a %s "
                  "knee (needs %.1f, and decides)",
                  std::abs(offset), word(-offset), word(offset), least_hip_head_offset));
    const bool contradicted = (leans && lean * offset < 0) || (has_ridge && ridge * offset < 0);
    if (std::abs(offset) >= least_hip_head_offset && !contradicted)
      knee.side = side_of(offset);
    else
      knee.why_no_side = contradicted ? "head, shaft and trochlea contradict each other"
                                      : "the femur's head does not lie clearly to one side of the shaft";
    return;
  }
  if (leans && has_ridge && lean * ridge > 0)
    knee.side = side_of(lean);
  else
    knee.why_no_side =
        leans && has_ridge
            ? "shaft and trochlea contradict each other"
            : "without the femur's head it needs a shaft that leans and a trochlea with one higher side";
}

/// A tibia hangs below the condyles or, bent, behind them; a patella lies in front.
void check_tibia(const TriMesh& tibia, KneeAnatomy& knee) {
  const Vec3 down = area_centroid(tibia) - knee.condyles->fit.cylinder.point;
  const double behind =
      core::arctangent(-down.dot(knee.axes->anterior), -down.dot(knee.axes->superior)) * degrees_per_radian;
  knee.evidence.push_back(formatted(
      "the mobile body lies %.0f degrees %s straight down from the condyles (needs %.0f in front at most)",
      std::abs(behind), behind < 0 ? "in front of" : "behind", most_in_front_deg));
  if (behind >= -most_in_front_deg && behind <= most_behind_deg) return;
  knee.axes.reset();
  knee.why_no_axes = "the mobile body does not lie below or behind the condyles, as a tibia does";
}

using FindCondyles = Condyles (*)(const TriMesh& femur, const Vec3& facing, const Vec3& towards_shaft);

/// Condyles, shaft, head and axes.
void examine_femur(const TriMesh& femur, const std::optional<FacingPart>& facing, FindCondyles find,
                   KneeAnatomy& knee) {
  if (!facing) {
    knee.why_no_condyles = "a bone has no surface";
    return;
  }
  if (facing->apart_mm > farthest_apart_mm) {
    knee.why_no_condyles = formatted("the bones are %.0f mm apart", facing->apart_mm);
    return;
  }
  const Vec3 centroid = area_centroid(femur);
  try {
    knee.condyles = find(femur, facing->centre, (centroid - facing->centre).normalized());
  } catch (const MeshError& error) {
    knee.why_no_condyles = error.what();
    return;
  }
  const Cylinder& axis = knee.condyles->fit.cylinder;
  knee.epicondyles = find_epicondyles(femur, axis);
  knee.shaft = shaft_line(femur, axis.point, (centroid - axis.point).normalized(),
                          tibial_shaft_begins * axis.radius, std::numeric_limits<double>::infinity());
  if (!knee.shaft) {
    knee.why_no_axes = "the femur does not go on far enough beyond its condyles to show where up is";
    return;
  }
  knee.head = find_head(femur, axis, *knee.shaft);
  find_axes(femur, knee);
}

/// Without what was taken from a head for condyles.
KneeAnatomy without_head_for_condyles(const TriMesh& femur, KneeAnatomy knee) {
  if (!knee.condyles) return knee;
  std::string why = why_no_condyles_here(femur, *knee.condyles);
  if (why.empty()) return knee;
  KneeAnatomy none;
  none.why_no_condyles = std::move(why);
  return none;
}

KneeAnatomy with_side(const TriMesh& femur, KneeAnatomy knee) {
  if (!knee.condyles) knee.why_no_axes = "no condyles were found";
  if (knee.axes)
    find_side(femur, knee);
  else
    knee.why_no_side = "the axes are not known";
  return knee;
}

}  // namespace

KneeAnatomy knee_anatomy(const TriMesh& femur, const TriMesh& tibia) {
  KneeAnatomy knee;
  examine_femur(femur, facing_part(femur, tibia), find_condyles, knee);
  knee = without_head_for_condyles(femur, std::move(knee));
  if (knee.axes) check_tibia(tibia, knee);
  return with_side(femur, std::move(knee));
}

KneeAnatomy knee_anatomy_roughly(const TriMesh& femur, const TriMesh& mobile, const Pose& X_FM) {
  KneeAnatomy knee;
  examine_femur(femur, facing_part_roughly(femur, mobile, X_FM), find_condyles_roughly, knee);
  // With a notch behind and a shaft in front of it they are condyles.
  if (!knee.axes) knee = without_head_for_condyles(femur, std::move(knee));
  return with_side(femur, std::move(knee));
}

}  // namespace condyle::kinematics
