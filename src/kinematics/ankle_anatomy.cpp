#include "kinematics/ankle_anatomy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/formatted.hpp"
#include "kinematics/corners.hpp"
#include "kinematics/hip_anatomy.hpp"

namespace condyle::kinematics {
namespace {

/// The dome is some 30 mm long and wide; beyond 30 mm from its middle are the neck and the lower joints.
constexpr double dome_reach_mm = 30, smallest_dome = 10, largest_dome = 35;
/// The tibia's shaft begins above the flare of its lower end; from the dome's axis, in radii of it.
constexpr double shaft_begins = 2;
/// The talus reaches in front of its dome's axis by so much more than behind it, radii.
constexpr double least_head = 0.5;
/// A talus reaches less far than a tibia, but for one cut close to the joint; parts of its reach.
constexpr double largest_talus = 1.3;
/// The axis lies across the shaft, to within 30 degrees.
constexpr double most_along_shaft = 0.5;

double farthest_from(const TriMesh& bone, const Vec3& point) {
  double farthest = 0;
  for_each_corner(bone, [&](const Vec3& p) { farthest = std::max(farthest, (p - point).norm()); });
  return farthest;
}

double reach_towards(const TriMesh& bone, const Vec3& from, const Vec3& direction) {
  double reach = 0;
  for_each_corner(bone, [&](const Vec3& p) { reach = std::max(reach, (p - from).dot(direction)); });
  return reach;
}

/// Evidence against a tibia on a talus; empty if there is none.
std::string why_no_ankle(const TriMesh& tibia, const TriMesh& talus, const AnkleAnatomy& ankle) {
  if (!lies_across(*ankle.dome.fit, ankle.centre, tibia))
    return "the cylinder of the mobile body points to the fixed one, and a dome lies across";
  const double of_talus = farthest_from(talus, ankle.centre), of_tibia = farthest_from(tibia, ankle.centre);
  if (of_talus > largest_talus * of_tibia)
    return core::formatted(
        "the mobile body reaches %.0f mm from the joint and the fixed one %.0f: it is no talus", of_talus,
        of_tibia);
  return {};
}

void find_axes(const TriMesh& talus, AnkleAnatomy& ankle) {
  const Cylinder& dome = ankle.dome.fit->cylinder;
  if (std::abs(ankle.shaft->direction.dot(dome.direction)) > most_along_shaft) {
    ankle.why_no_axes = "the cylinder does not lie across the tibia's shaft";
    return;
  }
  const Vec3 up = square_to(dome.direction, ankle.shaft->direction);
  Vec3 ahead = dome.direction.cross(up);
  const double one = reach_towards(talus, ankle.centre, ahead),
               other = reach_towards(talus, ankle.centre, -ahead);
  if (other > one) ahead = -ahead;
  const double more = std::abs(one - other) / dome.radius;
  ankle.evidence.push_back(
      core::formatted("front: the talus reaches %.2f radii of its dome farther to one side of the axis, as "
                      "its head does in front (needs %.1f)",
                      more, least_head));
  if (more < least_head)
    ankle.why_no_axes = "the talus reaches as far to the front as to the back of its dome";
  else
    ankle.axes = ShownAxes{ahead, up};
}

}  // namespace

AnkleAnatomy ankle_anatomy(const TriMesh& tibia, const TriMesh& talus) {
  AnkleAnatomy ankle;
  ankle.dome = joint_cylinder(talus, tibia, dome_reach_mm, smallest_dome, largest_dome);
  if (!ankle.dome.fit) {
    ankle.why_no_axes = "no dome was found";
    return ankle;
  }
  ankle.centre = middle_of(talus, *ankle.dome.fit);
  if (const std::string why = why_no_ankle(tibia, talus, ankle); !why.empty()) {
    ankle.dome = {{}, why};
    ankle.why_no_axes = "no dome was found";
    return ankle;
  }
  ankle.shaft =
      shaft_line(tibia, ankle.centre, (area_centroid(tibia) - ankle.centre).normalized(),
                 shaft_begins * ankle.dome.fit->cylinder.radius, std::numeric_limits<double>::infinity());
  if (ankle.shaft)
    find_axes(talus, ankle);
  else
    ankle.why_no_axes = "the tibia does not go on far enough above the dome to show where up is";
  return ankle;
}

}  // namespace condyle::kinematics
