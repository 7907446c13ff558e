#include "kinematics/elbow_anatomy.hpp"

#include <cmath>
#include <limits>

#include "kinematics/hip_anatomy.hpp"

namespace condyle::kinematics {
namespace {

/// Trochlea and capitellum are some 45 mm wide.
constexpr double trochlea_reach_mm = 30, smallest_trochlea = 5, largest_trochlea = 14;
/// The shaft begins beyond the epicondyles and the fossae; in radii of the trochlea.
constexpr double humeral_shaft_begins = 4.5;
/// The axis lies across the shaft, to within 30 degrees.
constexpr double most_along_humeral_shaft = 0.5;

}  // namespace

ElbowAnatomy elbow_anatomy(const TriMesh& humerus, const TriMesh& ulna) {
  ElbowAnatomy elbow;
  elbow.trochlea = joint_cylinder(humerus, ulna, trochlea_reach_mm, smallest_trochlea, largest_trochlea);
  if (!elbow.trochlea.fit) {
    elbow.why_no_superior = "no trochlea was found";
    return elbow;
  }
  const Cylinder axis = elbow.trochlea.fit->cylinder;
  elbow.centre = middle_of(humerus, *elbow.trochlea.fit);
  if (!lies_across(*elbow.trochlea.fit, elbow.centre, humerus)) {
    elbow.trochlea = {{}, "the cylinder of the fixed body points along it, and a trochlea lies across"};
    elbow.why_no_superior = "no trochlea was found";
    return elbow;
  }
  elbow.shaft = shaft_line(humerus, elbow.centre, (area_centroid(humerus) - elbow.centre).normalized(),
                           humeral_shaft_begins * axis.radius, std::numeric_limits<double>::infinity());
  if (!elbow.shaft) {
    elbow.why_no_superior = "the humerus does not go on far enough above the trochlea to show where up is";
    return elbow;
  }
  if (std::abs(elbow.shaft->direction.dot(axis.direction)) > most_along_humeral_shaft) {
    elbow.why_no_superior = "the cylinder does not lie across the humerus' shaft";
    return elbow;
  }
  elbow.superior = square_to(axis.direction, elbow.shaft->direction);
  const Vec3 sagittal = axis.direction.cross(*elbow.superior), to_shaft = elbow.shaft->point - elbow.centre;
  const Vec3 at_axis = to_shaft - to_shaft.dot(*elbow.superior) /
                                      elbow.shaft->direction.dot(*elbow.superior) * elbow.shaft->direction;
  const double off = -at_axis.dot(sagittal);
  elbow.from_shaft_line = off < 0 ? Vec3(-sagittal) : sagittal;
  elbow.off_shaft_line_mm = std::abs(off);
  return elbow;
}

}  // namespace condyle::kinematics
